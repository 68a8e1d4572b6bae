// The step rule holds for what is measured of a move, not only for its command.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "agent/base/random.hpp"
#include "agent/gaze/step_rule.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/sim/joints.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::cycle::moves_test {
namespace {

// A joint that has come to rest is this near to where it rests.
constexpr double rest_rad = 1e-6;

/// Joints that miss their commands by up to 20 mrad and have a play of one degree.
struct BadJoints {
  explicit BadJoints(std::uint64_t seed) : joints(behaviour(), speed_rad_s, seed, 0) {}

  static sim::JointBehaviour behaviour() {
    sim::JointBehaviour out;
    out.settling_error_rad = 0.02;
    out.backlash_rad = 0.017;
    return out;
  }

  /// What is measured when they have come to rest.
  geometry::HeadAngles sent_to(geometry::HeadAngles target) {
    joints.command({now_us, target, 1.0});
    constexpr std::int64_t long_enough_us = 500'000;
    joints.advance_to(now_us += long_enough_us);
    return joints.measure().measured;
  }

  static constexpr geometry::HeadAngles speed_rad_s{8.0, 7.0};
  sim::SimJoints joints;
  std::int64_t now_us = 0;
};

TEST(Moves, OfJointsThatMissTheirCommandsMeasureTheLeastStepOnBothAxes) {
  const geometry::RobotProfile robot = *geometry::robot_profile("nao-v6");
  const geometry::HeadLimits limits(HeadMotionSettings{}.margin_rad);
  const double margin_rad = robot.move_margin_rad();
  constexpr int moves = test::trials(100'000, 2'000);
  base::Random random(19);
  BadJoints dut(1);
  int judged = 0, on_again = 0;
  for (int i = 0; i < moves; ++i) {
    const geometry::HeadAngles from = limits.clamp(dut.joints.measure().measured);
    const geometry::Pixel pixel(random.uniform(0.0, 639.0), random.uniform(0.0, 479.0));
    const geometry::HeadAngles ruled = gaze::next_look(robot.rig.camera, limits, from, pixel);
    geometry::HeadAngles commanded = gaze::with_margin(limits, from, ruled, margin_rad);
    geometry::HeadAngles measured = dut.sent_to(commanded);
    for (int times = 0; times < 3; ++times) {
      const auto on = gaze::turn_on(limits, from, commanded, measured, margin_rad);
      if (!on) break;
      ++on_again;
      commanded = *on;
      measured = dut.sent_to(commanded);
    }
    // Where the limits leave no room for a margin, the rule's command is all there is.
    const geometry::HeadAngles room = commanded - ruled;
    const double least_room_rad = std::min(std::abs(room.yaw_rad), std::abs(room.pitch_rad));
    if (least_room_rad < margin_rad - rest_rad) continue;
    ++judged;
    const geometry::HeadAngles change = measured - from;
    ASSERT_GE(std::abs(change.yaw_rad), gaze::minimum_step_rad) << i;
    ASSERT_GE(std::abs(change.pitch_rad), gaze::minimum_step_rad) << i;
  }
  EXPECT_GT(judged, moves * 7 / 10);
  std::printf("%d moves, %d with room for the margin; %d turned on\n", moves, judged, on_again);
}

HeadSetup with_margin(double margin_rad) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = 4;
  setup.cycle.motion.move_margin_rad = margin_rad;
  return setup;
}

const std::string bad_joints =
    "repeat = true\n[joints]\nsettling_error_rad = 0.02\n"
    "encoder_step_rad = 0.00153\nencoder_noise_rad = 0.0005\n" +
    std::string(report_test_1);

/// The least change of an axis from one look to the next.
double least_change_rad(const Fixation& fixation) {
  double least = INFINITY;
  for (std::size_t k = 1; k < fixation.look_count; ++k) {
    const geometry::HeadAngles change = fixation.looks[k].measured - fixation.looks[k - 1].measured;
    least = std::min({least, std::abs(change.yaw_rad), std::abs(change.pitch_rad)});
  }
  return least;
}

TEST(Moves, OfAWholeCycleKeepTheRuleAsMeasured) {
  for (const double margin_rad : {0.0, geometry::robot_profile("nao-v6")->move_margin_rad()}) {
    SimulatedHead dut(bad_joints, with_margin(margin_rad));
    double least_rad = INFINITY;
    for (int i = 0; i < test::trials(6, 2); ++i) {
      const auto fixation = dut.run(60.0);
      ASSERT_TRUE(fixation);
      least_rad = std::min(least_rad, least_change_rad(*fixation));
      dut.robot->next_test();
    }
    if (margin_rad > 0.0) {
      EXPECT_GE(least_rad, gaze::minimum_step_rad);
    } else {
      EXPECT_LT(least_rad, gaze::minimum_step_rad) << "these joints never fall short";
    }
  }
}

TEST(Moves, ThatFellShortGoOnUntilTheyHaveTheirStep) {
  // Joints that stop 30 mrad before their goal, and a margin that does not hold that.
  HeadSetup setup = with_margin(0.01);
  setup.cycle.locate.looks = 2;
  SimulatedHead dut(report_test_1, setup);
  dut.obeys = false;
  geometry::HeadAngles from{};
  dut.commanded = [&](const geometry::HeadCommand& command) {
    const geometry::HeadAngles way = command.target - from;
    constexpr double short_by_rad = 0.03;
    geometry::HeadCommand obeyed = command;
    obeyed.target =
        command.target - geometry::HeadAngles{std::copysign(short_by_rad, way.yaw_rad),
                                              std::copysign(short_by_rad, way.pitch_rad)};
    dut.robot->command(obeyed);
  };
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  const geometry::HeadAngles change = fixation->looks[1].measured - fixation->looks[0].measured;
  EXPECT_GE(std::abs(change.yaw_rad), gaze::minimum_step_rad);
  EXPECT_GE(std::abs(change.pitch_rad), gaze::minimum_step_rad);
  EXPECT_EQ(dut.commands, 2);
}

}  // namespace
}  // namespace gazed::cycle::moves_test
