// When a target has been looked at enough.
#include <Eigen/Core>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "agent/gaze/step_rule.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::looks_as_needed_test {
namespace {

using ::testing::HasSubstr;

/// So many looks, whatever they tell.
HeadSetup looking(int looks) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = looks;
  return setup;
}

/// As many looks as the point needs.
HeadSetup looking_as_needed(int looks_min, int looks_most, double relative_sigma_goal) {
  HeadSetup setup = looking(looks_most);
  setup.cycle.locate.looks_min = looks_min;
  setup.cycle.locate.relative_sigma_goal = relative_sigma_goal;
  return setup;
}

double relative_sigma(const Fixation& fixation) {
  return fixation.estimate.inverse_range_sigma_per_m / fixation.estimate.inverse_range_per_m;
}

TEST(LooksAsNeeded, EndWhenThePointIsKnownWellEnough) {
  SimulatedHead two(report_test_1, looking(2));
  const auto known_by_two = two.run();
  ASSERT_TRUE(known_by_two);
  // What two looks do not reach and three do.
  const double goal = 0.9 * relative_sigma(*known_by_two);
  SimulatedHead dut(report_test_1, looking_as_needed(2, 8, goal));
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located);
  EXPECT_EQ(fixation->views, 3);
  EXPECT_LE(relative_sigma(*fixation), goal);
}

TEST(LooksAsNeeded, TwoDoNotShowThatAnObjectMovesSoAThirdIsTheLeast) {
  HeadSetup setup = looking_as_needed(LocateSettings{}.looks_min, 8, 1.0);
  SimulatedHead third(report_test_1, setup);
  const auto fixation = third.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->views, 3);
  setup.cycle.locate.looks = 2;  // but where two are asked for
  SimulatedHead two(report_test_1, setup);
  const auto with_two = two.run();
  ASSERT_TRUE(with_two);
  EXPECT_EQ(with_two->views, 2);
}

// A second and a third look at an object that has moved meanwhile, and none that could tell.
// The faster the object drifts away, the more its looks differ: first they do not show, then they
// are doubted, then they contradict each other. At which speed depends on where the looks are.
TEST(LooksAsNeeded, FewThatDifferDoNotMakeAPointSure) {
  int doubted = 0;
  bool differ = false;
  for (const char* speed_m_s : {"0.002", "0.0025", "0.003", "0.0035", "0.004", "0.0045"}) {
    const std::string drifting =
        std::string("[camera]\npixel_noise = 2.0\n[[report_test]]\nnumber = 1\n") +
        "velocity_m_s = [0.0, 0.0, " + speed_m_s + "]\n";
    SimulatedHead dut(drifting, looking_as_needed(3, 3, 0.0));
    const auto fixation = dut.run();
    ASSERT_TRUE(fixation);
    const bool located = fixation->status == Status::located;
    EXPECT_FALSE(differ && located) << speed_m_s;
    differ = differ || !located;
    if (fixation->status != Status::uncertain) continue;
    EXPECT_THAT(fixation->reason, HasSubstr("do not show that the object stands still"));
    ++doubted;
  }
  EXPECT_GE(doubted, 1);
}

// An object that jumps after the third look, and no look that could tell who is right.
TEST(LooksAsNeeded, ThreeAgainstOneDoNotMakeAPointSure) {
  const std::string_view jumping = R"(
[camera]
pixel_noise = 2.0
[[report_test]]
number = 1
velocity_m_s = [0.0, 0.0, 0.1]
moving_s = [1.0, 1.1]
)";
  SimulatedHead dut(jumping, looking(4));
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::uncertain);
  EXPECT_EQ(fixation->views, 3);
  EXPECT_THAT(fixation->reason, HasSubstr("3 looks against 1, chi-square"));
}

// The first later look sees the object, the others do not.
TEST(LooksAsNeeded, TwoDoNotMakeAPointSureWhereMoreWereWanted) {
  for (const int looks_min : {3, 2}) {
    SimulatedHead dut(report_test_1, looking_as_needed(looks_min, 6, 0.0));
    base::Image blank(640, 480, base::PixelFormat::rgb24);
    dut.seen = [&](const geometry::Frame& frame) {
      return dut.commands >= 2 ? geometry::Frame{blank.view(), frame.utime_us} : frame;
    };
    const auto fixation = dut.run(60.0);
    ASSERT_TRUE(fixation);
    EXPECT_EQ(fixation->views, 2);
    EXPECT_EQ(fixation->status, looks_min == 3 ? Status::uncertain : Status::located);
  }
}

TEST(LooksAsNeeded, EndWhenAnotherWouldHardlyTellMore) {
  SimulatedHead dut(report_test_1, looking_as_needed(3, 16, 0.0));
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located);
  EXPECT_GE(fixation->views, 3);
  ASSERT_LT(fixation->views, 16);
  // And it would not have.
  SimulatedHead longer(report_test_1, looking(fixation->views + 1));
  const auto with_another = longer.run(60.0);
  ASSERT_TRUE(with_another);
  EXPECT_GT(relative_sigma(*with_another), 0.88 * relative_sigma(*fixation));
}

TEST(LooksAsNeeded, ByTheReportsMethodAreTwoAndItsAnswerIsTold) {
  HeadSetup setup = looking(8);
  setup.cycle.locate.method = LocateMethod::report;
  setup.cycle.motion.move_margin_rad = 0.05;
  SimulatedHead dut(report_test_1, setup);
  std::optional<geometry::HeadAngles> first;
  dut.commanded = [&](const geometry::HeadCommand& command) { first = command.target; };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation && first);
  EXPECT_EQ(fixation->views, 2);
  EXPECT_EQ(dut.commands, 1);
  // The rule's own move, without a margin.
  EXPECT_EQ(*first,
            gaze::next_look(setup.rig.camera, geometry::HeadLimits(setup.cycle.motion.margin_rad),
                            fixation->head_1, fixation->pixel_1));
  EXPECT_EQ(fixation->method, LocateMethod::report);
  ASSERT_TRUE(fixation->report_position_m.allFinite());
  const Eigen::Vector3d camera_1_m =
      geometry::cam_from_torso(setup.rig.head, fixation->head_1).inverse().translation;
  EXPECT_NEAR(std::abs(fixation->report_range_m), (fixation->report_position_m - camera_1_m).norm(),
              1e-12);
}

TEST(LooksAsNeeded, OutOfRangeAreRefusedWithTheValue) {
  for (const int looks : {1, 17}) {
    for (const HeadSetup& setup :
         {looking_as_needed(3, looks, 0.03), looking_as_needed(looks, 6, 0.03)}) {
      try {
        static_cast<void>(setup.made());
        FAIL() << looks;
      } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::to_string(looks)));
      }
    }
  }
}

}  // namespace
}  // namespace gazed::cycle::looks_as_needed_test
