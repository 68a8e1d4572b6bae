#include "agent/cycle/frame_counts.hpp"

#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "agent/cycle/cycle.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::frame_counts_test {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t begin_us = 1'700'000'000'000'000;

TEST(FrameCounts, OnlyWhatHappenedIsTold) {
  EXPECT_EQ(in_words({}), "of 0 frames");
  EXPECT_EQ(in_words({.looked_at = 20, .moving = 100}),
            "of 120 frames 100 came while the head moved, 20 were looked at");
}

TEST(FrameCounts, TimesThatDoNotMeetAreTold) {
  FrameCounts counts{.no_angles = 2};
  counts.saw_frame(begin_us);
  counts.saw_frame(begin_us + 1'000'000);
  counts.saw_head_state(begin_us + 3'601'000'000);
  EXPECT_THAT(in_words(counts),
              HasSubstr("the frames' times lie 3600.0 s before the head states': their clocks"));
  counts.saw_head_state(begin_us + 3'700'000'000);
  counts.first_state_us = begin_us - 10'000'000;
  counts.last_state_us = begin_us - 5'000'000;
  EXPECT_THAT(in_words(counts), HasSubstr("lie 5.0 s after the head states'"));
  counts.last_state_us = begin_us + 500'000;
  EXPECT_EQ(in_words(counts), "of 2 frames 2 had no head states from before and after them");
}

TEST(FrameCounts, OneClockThatIsSetIsNotTwoThatDiffer) {
  FrameCounts counts{.no_angles = 2};
  for (const std::int64_t hours : {1, 0}) {
    counts.saw_head_state(begin_us + hours * 3'600'000'000);
    counts.saw_frame(begin_us + hours * 3'600'000'000 + 10'000);
  }
  EXPECT_EQ(in_words(counts), "of 2 frames 2 had no head states from before and after them");
}

/// What became of ten frames, 33 ms apart, among states 10 ms apart.
FrameCounts of_ten_frames(double velocity_rad_s, std::int64_t states_later_us) {
  const HeadSetup setup = calibrated_nao_v6();
  Cycle dut(setup.rig, setup.cycle);
  base::Image image(setup.rig.camera.width_px, setup.rig.camera.height_px, base::PixelFormat::grey);
  for (int i = 0; i < 33; ++i) {
    const std::int64_t now_us = begin_us + 10'000 * i;
    geometry::HeadState state;
    state.utime_us = now_us + states_later_us;
    state.measured = {1e-6 * velocity_rad_s * 10'000 * i, 0.0};
    state.velocity_rad_s = {velocity_rad_s, 0.0};
    static_cast<void>(dut.on_head_state(state));
    if (i % 3 == 2 && i < 30) static_cast<void>(dut.on_frame({image.view(), now_us - 5'000}));
  }
  return dut.frame_counts();
}

TEST(FrameCounts, EachFrameCountsOnce) {
  const FrameCounts still = of_ten_frames(0.0, 0), moving = of_ten_frames(1.0, 0);
  EXPECT_EQ(still.all(), 10);
  EXPECT_GT(still.looked_at, 0);
  EXPECT_EQ(still.moving, 0);
  EXPECT_EQ(moving.all(), 10);
  EXPECT_GT(moving.moving, 0);
  EXPECT_EQ(moving.looked_at, 0);
}

TEST(FrameCounts, StatesOfAnotherTimeLeaveNoFrameItsAngles) {
  for (const std::int64_t hour_us : {3'600'000'000, -3'600'000'000}) {
    const FrameCounts counts = of_ten_frames(0.0, hour_us);
    EXPECT_EQ(counts.all(), 10);
    EXPECT_EQ(counts.no_angles, 10) << in_words(counts);
    EXPECT_THAT(in_words(counts), HasSubstr("their clocks differ"));
  }
}

}  // namespace
}  // namespace gazed::cycle::frame_counts_test
