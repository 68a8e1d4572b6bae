// Clocks that are set while a fixation lasts.
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "agent/cycle/cycle.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::clocks_test {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t hour_us = 3'600'000'000;
// Of one fixation: a second of looking and 3 s in which the head may settle, with time to spare.
constexpr double longest_s = 6.0;

/// A robot whose clocks can be set.
class ClocksThatAreSet : public ::testing::Test {
 protected:
  explicit ClocksThatAreSet(const HeadSetup& setup = calibrated_nao_v6())
      : dut{report_test_1, setup} {
    dut.measured = [this](geometry::HeadState state) {
      state.utime_us += head_us;
      return state;
    };
    dut.draws_all = true;  // times are changed below
    dut.seen = [this](geometry::Frame frame) {
      frame.utime_us += frames_us;
      return frame;
    };
    dut.obeys = false;  // a joint waits for the time of its command, which is another clock's
    dut.commanded = [this](geometry::HeadCommand command) {
      sent.push_back(command.target);
      command.utime_us -= head_us;
      if (obeys) dut.robot->command(command);
    };
  }

  void set_both(std::int64_t by_us) {
    head_us += by_us;
    frames_us += by_us;
  }
  /// Until the head is on its way to the second look.
  void run_into_a_fixation() {
    while (dut.commands == 0) ASSERT_FALSE(dut.run(0.1));
  }

  SimulatedHead dut;
  std::vector<geometry::HeadAngles> sent;
  std::int64_t head_us = 2 * hour_us, frames_us = 2 * hour_us;
  bool obeys = true;
};

TEST_F(ClocksThatAreSet, BackIsFollowedAtOnce) {
  run_into_a_fixation();
  set_both(-hour_us);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_LT(fixation->utime_us, 2 * hour_us);
  EXPECT_EQ(dut.cycle.frame_counts().refused, 0);
}

TEST_F(ClocksThatAreSet, BackIsWhyAFixationEnds) {
  run_into_a_fixation();
  set_both(-hour_us);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
  // By the hour, less the time from one head state to the next.
  EXPECT_THAT(fixation->reason, HasSubstr("the clock of the head states was set back by 3600.0 s"));
  EXPECT_GE(fixation->duration_s, 0.0);
  EXPECT_LT(fixation->duration_s, longest_s);
  EXPECT_EQ(dut.run()->status, Status::located);
}

class ClocksThatAreSetAmidManyLooks : public ClocksThatAreSet {
 protected:
  ClocksThatAreSetAmidManyLooks() : ClocksThatAreSet(many_looks()) {}

  static HeadSetup many_looks() {
    HeadSetup setup = calibrated_nao_v6();
    setup.cycle.locate.looks = setup.cycle.locate.looks_min = 6;
    return setup;
  }
};

// Planned looks have the target at the ends of the frame, and may be where another one would see
// nothing: a fixation begun there once found no object, and the head stayed there for ever.
TEST_F(ClocksThatAreSetAmidManyLooks, BackSendsTheHeadBackToItsFirstLook) {
  int looks = 0;
  dut.looked = [&looks](const UsedSaliency&) { ++looks; };
  while (looks < 3) ASSERT_FALSE(dut.run(0.02));
  const std::vector<geometry::HeadAngles> before = sent;
  set_both(-hour_us);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_THAT(fixation->reason, HasSubstr("the clock of the head states was set back"));
  ASSERT_EQ(sent.size(), before.size() + 1);
  EXPECT_EQ(geometry::greatest_difference(sent.back(), before.front()), 0.0);
  const auto next = dut.run();
  ASSERT_TRUE(next);
  EXPECT_EQ(next->status, Status::located) << next->reason;
  constexpr double arrived_rad = 0.02;
  EXPECT_LT(geometry::greatest_difference(next->head_1, before.front()), arrived_rad);
}

TEST_F(ClocksThatAreSet, AheadEndsNoFixation) {
  run_into_a_fixation();
  set_both(hour_us);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located) << fixation->reason;
  EXPECT_GE(fixation->duration_s, 0.0);
  EXPECT_LT(fixation->duration_s, longest_s);
}

TEST_F(ClocksThatAreSet, BackKeepsNoFaultFromBeingReported) {
  obeys = false;
  ASSERT_EQ(dut.run()->status, Status::head_fault);
  set_both(-hour_us);
  constexpr double reported_again_s = 10.0, next_failure_s = 5.0;
  const auto fixation = dut.run(reported_again_s + next_failure_s);
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
}

TEST_F(ClocksThatAreSet, OfTheFramesAloneDoNotCountTheFixation) {
  run_into_a_fixation();
  frames_us -= hour_us;
  ASSERT_FALSE(dut.run(0.2));
  ASSERT_EQ(dut.cycle.frame_counts().refused, 0);
  const auto fixation = dut.cycle.on_silence({2.0, 0.0, "no device", "", 2.0}).fixation;
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::camera_fault);
  EXPECT_GE(fixation->duration_s, 0.0);
  EXPECT_LT(fixation->duration_s, longest_s);
}

}  // namespace
}  // namespace gazed::cycle::clocks_test
