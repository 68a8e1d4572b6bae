// How many looks at one target, and where from.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "agent/cycle/cycle.hpp"
#include "agent/gaze/step_rule.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::looks_test {
namespace {

using ::testing::HasSubstr;

// Encoders that measure what is, and the joints stop within a tenth of this of their command.
constexpr double rest_tolerance_rad = 0.02;

HeadSetup looking(int looks, gaze::Plan plan) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = looks;
  setup.cycle.locate.plan = plan;
  return setup;
}

struct Watched {
  explicit Watched(std::string_view scene, const HeadSetup& setup) : dut(scene, setup) {
    dut.seen = [this](const geometry::Frame& frame) {
      if (dut.cycle.state() == CycleState::relooking) rests.push_back(dut.robot->truth().angles);
      return frame;
    };
  }
  SimulatedHead dut;
  std::vector<geometry::HeadAngles>
      rests;  // true angles of the later looks, some of them more than once
};

TEST(Looks, EightAreTakenAndFused) {
  Watched two(report_test_1, looking(2, gaze::Plan::parallax));
  Watched eight(report_test_1, looking(8, gaze::Plan::parallax));
  const auto with_two = two.dut.run(), with_eight = eight.dut.run();
  ASSERT_TRUE(with_two && with_eight);
  EXPECT_EQ(with_eight->status, Status::located);
  EXPECT_EQ(with_eight->views, 8);
  // What is left after eight is the calibration's share: 1.7 % of lever arm and focal length.
  EXPECT_LT(with_eight->estimate.inverse_range_sigma_per_m,
            0.5 * with_two->estimate.inverse_range_sigma_per_m);
  const double true_m = *eight.dut.robot->true_range_m({}, with_eight->pixel_1);
  EXPECT_NEAR(with_eight->estimate.range_m, true_m, 3.0 * with_eight->estimate.range_sigma_m);
}

TEST(Looks, TheFirstMoveIsTheStepRulesWhateverThePlan) {
  const HeadSetup setup = looking(4, gaze::Plan::parallax);
  SimulatedHead dut(report_test_1, setup);
  std::optional<geometry::HeadAngles> first;
  dut.commanded = [&](const geometry::HeadCommand& command) {
    if (!first) first = command.target;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation && first);
  EXPECT_EQ(*first,
            gaze::next_look(setup.rig.camera, geometry::HeadLimits(setup.cycle.motion.margin_rad),
                            fixation->head_1, fixation->pixel_1));
}

TEST(Looks, EveryMoveIsAStepOnBothAxes) {
  for (const gaze::Plan plan : {gaze::Plan::report, gaze::Plan::parallax}) {
    Watched watched(report_test_1, looking(6, plan));
    ASSERT_TRUE(watched.dut.run());
    geometry::HeadAngles before{};
    int steps = 0;
    for (const geometry::HeadAngles rest : watched.rests) {
      if (geometry::greatest_difference(rest, before) < rest_tolerance_rad) continue;
      EXPECT_GE(std::abs(rest.yaw_rad - before.yaw_rad),
                gaze::minimum_step_rad - rest_tolerance_rad);
      EXPECT_GE(std::abs(rest.pitch_rad - before.pitch_rad),
                gaze::minimum_step_rad - rest_tolerance_rad);
      before = rest;
      ++steps;
    }
    EXPECT_EQ(steps, 5);
  }
}

// Else the next fixation would begin with the object at the end of the frame, or with another one
// out of it.
TEST(Looks, AfterPlannedOnesTheHeadGoesBackToTheRulesLook) {
  for (const int looks : {2, 6}) {
    SimulatedHead dut(report_test_1, looking(looks, gaze::Plan::parallax));
    std::vector<geometry::HeadAngles> targets;
    dut.commanded = [&](const geometry::HeadCommand& command) {
      targets.push_back(command.target);
    };
    ASSERT_TRUE(dut.run());
    ASSERT_FALSE(targets.empty());
    EXPECT_EQ(targets.back(), targets.front()) << looks;
    EXPECT_EQ(targets.size() > 1, looks > 2);
  }
}

TEST(Looks, PlannedOnesSwingWiderThanTheRules) {
  const auto reach = [](gaze::Plan plan) {
    Watched watched(report_test_1, looking(6, plan));
    EXPECT_TRUE(watched.dut.run());
    double widest = 0.0;
    for (const geometry::HeadAngles rest : watched.rests)
      widest = std::max(widest, std::abs(rest.yaw_rad));
    return widest;
  };
  EXPECT_GT(reach(gaze::Plan::parallax), 2.0 * reach(gaze::Plan::report));
}

TEST(Looks, ATargetThatIsGoneEndsAfterTwoMisses) {
  SimulatedHead dut(report_test_1, looking(8, gaze::Plan::report));
  std::vector<std::int64_t> looks_us;
  dut.looked = [&](const UsedSaliency& used) { looks_us.push_back(used.utime_us); };
  base::Image blank(640, 480, base::PixelFormat::rgb24);
  dut.seen = [&](const geometry::Frame& frame) {
    return dut.commands >= 3 ? geometry::Frame{blank.view(), frame.utime_us} : frame;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located);
  EXPECT_EQ(fixation->views, 3);
  EXPECT_EQ(fixation->utime_us, looks_us.at(2));  // of the last look that saw it
  EXPECT_LE(dut.commands, 5);
}

TEST(Looks, ATargetThatIsNeverSeenAgainIsLost) {
  SimulatedHead dut(report_test_1, looking(8, gaze::Plan::report));
  base::Image blank(640, 480, base::PixelFormat::rgb24);
  dut.seen = [&](const geometry::Frame& frame) {
    return dut.commands >= 1 ? geometry::Frame{blank.view(), frame.utime_us} : frame;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::target_lost);
  EXPECT_EQ(dut.commands, 3);  // two looks, and back
  EXPECT_TRUE(std::isnan(fixation->pixel_2.x()));
}

TEST(Looks, OneMissIsGotOver) {
  for (const gaze::Plan plan : {gaze::Plan::report, gaze::Plan::parallax}) {
    SimulatedHead dut(report_test_1, looking(6, plan));
    base::Image blank(640, 480, base::PixelFormat::rgb24);
    dut.seen = [&](const geometry::Frame& frame) {
      return dut.commands == 1 ? geometry::Frame{blank.view(), frame.utime_us} : frame;
    };
    const auto fixation = dut.run();
    ASSERT_TRUE(fixation);
    EXPECT_EQ(fixation->status, Status::located) << fixation->reason;
    EXPECT_EQ(fixation->views, 5);
  }
}

TEST(Looks, AHeadThatJamsLaterStillTellsWhatItSaw) {
  HeadSetup setup = looking(8, gaze::Plan::parallax);
  // It jams on a detour, with little of the object left in the frame: enough for this profile.
  setup.cycle.saliency.profile = saliency::SaliencyProfile::robust;
  SimulatedHead dut(report_test_1, setup);
  dut.commanded = [&](const geometry::HeadCommand&) {
    dut.obeys = dut.robot->now_us() < 2'500'000;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located);
  EXPECT_GE(fixation->views, 2);
  EXPECT_LT(fixation->views, 8);
  EXPECT_THAT(fixation->reason, HasSubstr("has not settled"));
  EXPECT_TRUE(fixation->pixel_2.allFinite());
  // From the start of the next fixation on it is a fault, and reported once.
  const auto fault = dut.run();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, Status::head_fault);
  EXPECT_FALSE(dut.run(9.0));
}

TEST(Looks, AreApproachedFromOneSide) {
  const HeadSetup setup = looking(8, gaze::Plan::parallax);
  SimulatedHead dut(report_test_1, setup);
  std::vector<geometry::HeadCommand> commands;
  dut.commanded = [&](const geometry::HeadCommand& command) { commands.push_back(command); };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  ASSERT_GT(commands.size(), 8U);  // some looks take two
  commands.pop_back();             // the way back
  const geometry::HeadAngles side = commands.front().target - fixation->head_1;
  int detours = 0;
  for (std::size_t i = 1; i < commands.size(); ++i) {
    const geometry::HeadAngles move = commands[i].target - commands[i - 1].target;
    // A detour's second part is short, and on each axis it goes with the first move or not at all.
    if (geometry::greatest_difference(commands[i].target, commands[i - 1].target) >
        gaze::minimum_step_rad)
      continue;
    ++detours;
    EXPECT_GE(move.yaw_rad * side.yaw_rad, 0.0);
    EXPECT_GE(move.pitch_rad * side.pitch_rad, 0.0);
  }
  EXPECT_EQ(detours, static_cast<int>(commands.size()) - 7);
}

TEST(Looks, ABadlyMeasuringHeadThatDoesNotMoveHasNotArrived) {
  HeadSetup setup = looking(2, gaze::Plan::report);
  setup.rig.uncertainty.encoder_sigma_rad = 0.1;
  SimulatedHead dut(report_test_1, setup);
  dut.obeys = false;
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
}

}  // namespace
}  // namespace gazed::cycle::looks_test
