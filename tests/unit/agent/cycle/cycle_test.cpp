#include "agent/cycle/cycle.hpp"

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::cycle_test {
namespace {

using ::testing::HasSubstr;

// Registration and pixel noise alone, measured at 0.6 %; 2 % is what must hold with perfect joints.
constexpr double relative_range_tolerance = 0.02;

TEST(Cycle, LocatesTheReportsObjectWithPerfectJoints) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located) << fixation->reason;
  EXPECT_EQ(fixation->number, 1);
  EXPECT_EQ(fixation->views, 2);
  const auto true_range_m = dut.robot->true_range_m(fixation->head_1, fixation->pixel_1);
  ASSERT_TRUE(true_range_m);
  EXPECT_NEAR(fixation->estimate.range_m / *true_range_m, 1.0, relative_range_tolerance);
}

TEST(Cycle, GoesThroughTheReportsSteps) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  std::vector<CycleState> states{dut.cycle.state()};
  dut.measured = [&](const geometry::HeadState& state) {
    if (dut.cycle.state() != states.back()) states.push_back(dut.cycle.state());
    return state;
  };
  ASSERT_TRUE(dut.run());
  EXPECT_THAT(states,
              testing::ElementsAre(CycleState::waiting, CycleState::looking, CycleState::turning,
                                   CycleState::settling, CycleState::relooking));
  EXPECT_EQ(dut.cycle.state(), CycleState::looking);
  EXPECT_EQ(dut.commands, 1);
}

TEST(Cycle, ServesAHeadBetweenTheStepsOfAView) {
  HeadSetup setup = calibrated_nao_v6();
  const Cycle* cycle = nullptr;
  std::vector<CycleState> states;
  setup.head.serve = [&] { states.push_back(cycle->state()); };
  SimulatedHead dut(report_test_1, setup);
  cycle = &dut.cycle;
  ASSERT_TRUE(dut.run());
  EXPECT_THAT(states, testing::Contains(CycleState::looking).Times(testing::Ge(2)));
  // After the saliency, after the target is found, after the background is followed.
  EXPECT_THAT(states, testing::Contains(CycleState::locating).Times(3));
}

TEST(Cycle, BothAxesMoveByTheMinimumStep) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  constexpr double settling_rad =
      0.002;  // the simulated joints' lag when their velocity is under the limit
  EXPECT_GT(std::abs(fixation->head_2.yaw_rad - fixation->head_1.yaw_rad), 0.1 - settling_rad);
  EXPECT_GT(std::abs(fixation->head_2.pitch_rad - fixation->head_1.pitch_rad), 0.1 - settling_rad);
}

TEST(Cycle, UsesTheMeasuredAnglesNotTheCommandedOnes) {
  constexpr double offset_rad = 0.013;
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  dut.measured = [](geometry::HeadState state) {
    state.measured.yaw_rad += offset_rad;
    return state;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_NEAR(fixation->head_1.yaw_rad, offset_rad, 1e-9);
  // A constant yaw offset turns the whole world with the robot: the range does not change.
  EXPECT_NEAR(fixation->estimate.range_m / *dut.robot->true_range_m({}, fixation->pixel_1), 1.0,
              relative_range_tolerance);
}

TEST(Cycle, NoSalientObjectIsPublishedOnceASecond) {
  SimulatedHead dut(bare_wall, calibrated_nao_v6());
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::no_salient_object);
  EXPECT_THAT(fixation->reason, HasSubstr("distinctness"));
  EXPECT_EQ(dut.commands, 0);
  EXPECT_TRUE(std::isnan(fixation->estimate.range_m));
  EXPECT_TRUE(std::isnan(fixation->pixel_2.x()));
  EXPECT_FALSE(dut.run(0.9));
  EXPECT_TRUE(dut.run(0.5));
}

// Two walls of other colours: where they meet stands out and could be anywhere along itself.
TEST(Cycle, AnEdgeThatStandsOutIsNoTargetAndTheReasonSaysWhy) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.saliency.profile =
      saliency::SaliencyProfile::robust;  // surround finds closed things only
  setup.cycle.saliency.distinctness_min = 0.0;
  SimulatedHead dut(
      "[camera]\npixel_noise = 2.0\n[room]\nbackground = [200, 200, 200]\n"
      "[[plane]]\ncentre_m = [1.0, 5.0, 0.2]\nsize_m = [10.0, 20.0]\n"
      "texture = { colour = [40, 40, 160] }\n",
      setup);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::no_salient_object);
  EXPECT_THAT(fixation->reason, HasSubstr("in one direction only"));
}

// As long as nothing stands out, and no frame longer.
TEST(Cycle, LookingForAnObjectLastsASecond) {
  constexpr double looking_s = 1.0;
  SimulatedHead dut(bare_wall, calibrated_nao_v6());
  std::vector<std::int64_t> frames_us;
  dut.seen = [&](const geometry::Frame& frame) {
    frames_us.push_back(frame.utime_us);
    return frame;
  };
  for (int i = 0; i < 2; ++i) {
    const auto fixation = dut.run();
    ASSERT_TRUE(fixation);
    ASSERT_GE(frames_us.size(), 2U);
    EXPECT_EQ(fixation->utime_us, frames_us.back());
    const double frame_s = 1e-6 * static_cast<double>(frames_us.back() - *(frames_us.end() - 2));
    EXPECT_GE(fixation->duration_s, looking_s);
    EXPECT_LT(fixation->duration_s, looking_s + frame_s);
  }
}

TEST(Cycle, AnObjectThatVanishesIsLost) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  SimulatedHead bare(bare_wall, calibrated_nao_v6());
  bool gone = false;
  dut.commanded = [&](const geometry::HeadCommand&) { gone = true; };
  dut.seen = [&](const geometry::Frame& frame) {
    return gone ? geometry::Frame{bare.robot->next_frame()->image, frame.utime_us} : frame;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::target_lost) << fixation->reason;
  EXPECT_FALSE(fixation->reason.empty());
  EXPECT_EQ(fixation->views, 2);
}

TEST(Cycle, ACameraInTheJointAxesHasNoBaseline) {
  HeadSetup setup = calibrated_nao_v6();
  setup.rig.head.mount_offset_m.setZero();
  SimulatedHead dut(
      std::string("[robot]\nmount_offset_m = [0.0, 0.0, 0.0]\n") + std::string(report_test_1),
      setup);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::degenerate) << fixation->reason;
}

TEST(Cycle, RaysThatDivergeMeetBehindTheCamera) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  // The head says it turned further than it did, along the line of the turn: the parallax changes
  // its sign, the epipolar line hardly moves.
  dut.measured = [](geometry::HeadState state) {
    state.measured.yaw_rad *= 1.5;
    state.measured.pitch_rad *= 1.5;
    return state;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::behind_camera) << fixation->reason;
}

TEST(Cycle, CoarseJointsThatAreOwnedUpToComeOutUncertain) {
  HeadSetup setup = calibrated_nao_v6();
  setup.rig.uncertainty.encoder_sigma_rad = 0.02;
  SimulatedHead dut(report_test_1, setup);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::uncertain) << fixation->reason;
  EXPECT_FALSE(std::isnan(fixation->estimate.inverse_range_per_m));
  EXPECT_FALSE(std::isnan(fixation->estimate.inverse_range_sigma_per_m));
}

TEST(Cycle, ARecordedHeadsOwnMoveIsTheTurn) {
  HeadSetup setup = calibrated_nao_v6();
  setup.head.obeys = false;
  SimulatedHead dut(report_test_1, setup);
  dut.obeys = false;
  // Not where the step rule would have sent it.
  dut.commanded = [&](const geometry::HeadCommand&) { dut.robot->command({0, {-0.2, 0.1}, 0.3}); };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located) << fixation->reason;
  constexpr double rest_tolerance_rad = 0.01;
  EXPECT_NEAR(fixation->head_2.yaw_rad, -0.2, rest_tolerance_rad);
}

TEST(Cycle, ARecordedHeadsMoveIsATurnFromAFiftiethOfARadianOn) {
  HeadSetup setup = calibrated_nao_v6();
  setup.head.obeys = false;
  for (const double move_rad : {0.015, 0.025}) {
    SimulatedHead dut(report_test_1, setup);
    dut.obeys = false;
    dut.commanded = [&](const geometry::HeadCommand&) {
      dut.robot->command({0, {-move_rad, 0.0}, 0.3});
    };
    EXPECT_EQ(dut.run(3.0).has_value(), move_rad > 0.02) << move_rad;
  }
}

TEST(Cycle, RefusesFramesOfAnotherSizeWithBothSizes) {
  Cycle dut = calibrated_nao_v6().made();
  const base::Image small(320, 240, base::PixelFormat::rgb24);
  EXPECT_FALSE(dut.on_frame({small.view(), 1'000'000}).consumed);
  EXPECT_THAT(dut.refused_frame(), HasSubstr("320x240"));
  EXPECT_THAT(dut.refused_frame(), HasSubstr("640x480"));
  const auto fault = dut.on_silence({2.0, 0.0, "", ""}).fixation;
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->reason, HasSubstr("320x240"));
}

TEST(Cycle, RefusesTimesThatGoBackwardsOrCannotBe) {
  Cycle dut = calibrated_nao_v6().made();
  const base::Image image(640, 480, base::PixelFormat::rgb24);
  EXPECT_TRUE(dut.on_frame({image.view(), 2'000'000}).consumed);
  for (const std::int64_t utime_us :
       {std::int64_t{1'999'999}, std::int64_t{2'000'000}, INT64_MIN, INT64_MAX}) {
    EXPECT_FALSE(dut.on_frame({image.view(), utime_us}).consumed) << utime_us;
  }
  EXPECT_FALSE(dut.on_head_state({INT64_MAX, {}, {}}).consumed);
}

TEST(Cycle, AFrameWaitsForItsHeadAngles) {
  SimulatedHead source(report_test_1, calibrated_nao_v6());
  Cycle dut = calibrated_nao_v6().made();
  // Head states come 50 ms late.
  std::vector<geometry::HeadState> late;
  bool aimed = false;
  for (int i = 0; i < 200 && !aimed; ++i) {
    if (*source.robot->next_state_utime_us() <= *source.robot->next_frame_utime_us()) {
      late.push_back(*source.robot->next_state());
      if (late.size() < 5) continue;
      aimed = dut.on_head_state(late.front()).command.has_value();
      late.erase(late.begin());
    } else {
      EXPECT_FALSE(dut.on_frame(*source.robot->next_frame()).command);
    }
  }
  EXPECT_TRUE(aimed);
}

}  // namespace
}  // namespace gazed::cycle::cycle_test
