#include "agent/lab/head_trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <vector>

namespace gazed::lab::head_trace_test {
namespace {

constexpr geometry::HeadAngles here{0.1, -0.2};
constexpr geometry::HeadAngles there{-0.15, 0.05};

io::RecordedFrame frame_at(std::int64_t utime_us, geometry::HeadAngles head) {
  return {.utime_us = utime_us, .file = "a.png", .head = head, .line = 2};
}

bool still(const geometry::HeadState& state) {
  return state.velocity_rad_s.yaw_rad == 0.0 && state.velocity_rad_s.pitch_rad == 0.0;
}

class HeadBetweenFrames : public ::testing::TestWithParam<std::int64_t> {
 protected:
  const std::int64_t start_us_ = 1'700'000'000'000'000;
  const std::int64_t end_us_ = start_us_ + GetParam();
  const std::vector<geometry::HeadState> states_ =
      head_states_between(frame_at(start_us_, here), frame_at(end_us_, there));
};

TEST_P(HeadBetweenFrames, AscendsToAStateOnTheSecondFrame) {
  EXPECT_GT(states_.front().utime_us, start_us_);
  EXPECT_EQ(states_.back().utime_us, end_us_);
  EXPECT_TRUE(
      std::ranges::is_sorted(states_, std::ranges::less_equal{}, &geometry::HeadState::utime_us));
}

TEST_P(HeadBetweenFrames, RestsBeforeTurnsAndRestsAgain) {
  const auto turning = std::ranges::find_if_not(states_, still);
  const auto arrived = std::find_if(turning, states_.end(), still);
  ASSERT_GE(turning - states_.begin(), 2);
  ASSERT_GE(arrived - turning, 1);
  ASSERT_GE(states_.end() - arrived, 3);  // two still samples before the frame, one on it
  for (auto state = states_.begin(); state != turning; ++state) EXPECT_EQ(state->measured, here);
  for (auto state = arrived; state != states_.end(); ++state) EXPECT_EQ(state->measured, there);
}

TEST_P(HeadBetweenFrames, VelocityIsThatOfTheMotion) {
  for (std::size_t i = 1; i < states_.size(); ++i) {
    if (still(states_[i]) || still(states_[i - 1])) continue;
    const double seconds =
        static_cast<double>(states_[i].utime_us - states_[i - 1].utime_us) * 1e-6;
    const geometry::HeadAngles way = states_[i].measured - states_[i - 1].measured;
    EXPECT_NEAR(way.yaw_rad / seconds, states_[i].velocity_rad_s.yaw_rad, 1e-6);
    EXPECT_NEAR(way.pitch_rad / seconds, states_[i].velocity_rad_s.pitch_rad, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Intervals, HeadBetweenFrames,
                         ::testing::Values(io::least_frame_interval_us, 1'001, 5'003, 33'333,
                                           100'000, 500'000, 1'000'000, 60'000'000));

TEST(HeadTrace, StandsStillBetweenFramesOfOnePose) {
  for (const geometry::HeadState& state :
       head_states_between(frame_at(0, here), frame_at(400'000, here))) {
    EXPECT_EQ(state.measured, here);
    EXPECT_TRUE(still(state));
  }
}

TEST(HeadTrace, RestsBeforeTheFirstFrameAndAfterTheLast) {
  const auto before = head_states_before(frame_at(1'000'000, here));
  EXPECT_EQ(before.front().utime_us, 800'000);
  EXPECT_EQ(before.back().utime_us, 1'000'000);
  const auto after = head_states_after(frame_at(1'000'000, here));
  EXPECT_EQ(after.front().utime_us, 1'010'000);
  EXPECT_EQ(after.back().utime_us, 1'200'000);
  EXPECT_EQ(after.back().measured, here);
}

TEST(HeadTrace, NothingStandsBeforeTimeZero) {
  const auto states = head_states_before(frame_at(25'000, here));
  EXPECT_EQ(states.front().utime_us, 5'000);
  EXPECT_EQ(head_states_before(frame_at(0, here)).size(), 1U);
}

}  // namespace
}  // namespace gazed::lab::head_trace_test
