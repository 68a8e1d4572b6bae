#include "agent/daemon/clock_comparison.hpp"

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <string>

#include "agent/base/text.hpp"

namespace gazed::daemon::clock_comparison_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double begin_s = 1000.0;  // of the clock that only goes forward

/// What the head's history keeps at 50 states a second.
constexpr double kept_s = 5.1;

/// What is said after `seconds` of 15 frames and 50 head states a second, the frames 0.06 s old.
/// `frame_us` and `head_us` tell the stamps from the true time.
template <class FrameStamp, class HeadStamp>
ClockComparison after(double seconds, FrameStamp frame_us, HeadStamp head_us,
                      double angles_kept_s = kept_s) {
  constexpr double utime_s = 1.7e9;
  ClockComparison clocks;
  int frames = 0;
  for (int i = 0; i < 50.0 * seconds; ++i) {
    const double t = i / 50.0;
    clocks.saw_head_state(head_us(1e6 * (utime_s + t)), begin_s + t);
    if (t * 15.0 >= frames) {
      clocks.saw_frame(frame_us(1e6 * (utime_s + t - 0.06)), begin_s + t + 0.001, angles_kept_s);
      ++frames;
    }
  }
  return clocks;
}

std::int64_t as_it_is(double true_us) {
  return static_cast<std::int64_t>(true_us);
}
auto shifted_by(double seconds) {
  return [=](double true_us) { return as_it_is(true_us + 1e6 * seconds); };
}
auto times(double factor) {
  return [=](double true_us) { return as_it_is(factor * true_us); };
}

TEST(ClockComparison, ClocksThatAgreeAreNoFault) {
  EXPECT_EQ(after(60.0, as_it_is, as_it_is).fault(), "");
  EXPECT_EQ(after(60.0, as_it_is, as_it_is).warning(), "");
}

TEST(ClockComparison, LateFramesAreToldThoughTheyGetTheirAngles) {
  for (const double late_s : {0.5, 1.0, 2.0, 2.4}) {
    EXPECT_THAT(
        after(1.5, shifted_by(-late_s), as_it_is).fault(),
        AllOf(HasSubstr(base::text("%.1f s behind the head's angles, constantly", late_s + 0.06)),
              HasSubstr("they get the angles of that time")))
        << late_s;
  }
}

TEST(ClockComparison, LateFramesWhoseAnglesAreNotKeptAreToldSo) {
  constexpr double of_500_states_a_second = 0.51;
  EXPECT_THAT(after(1.5, shifted_by(-0.7), as_it_is, of_500_states_a_second).fault(),
              AllOf(HasSubstr("frames are stamped 0.8 s behind the head's angles, constantly"),
                    HasSubstr("those of the last 0.51 s are kept: there are none")));
  constexpr double of_10000_states_a_second = 0.0255;
  EXPECT_THAT(after(1.5, as_it_is, as_it_is, of_10000_states_a_second).fault(),
              HasSubstr("those of the last 0.03 s are kept: there are none"))
      << "frames 0.06 s old";
}

TEST(ClockComparison, DelayThatChangesIsCalledSo) {
  const auto uneven = [](double true_us) {
    return as_it_is(true_us - 1e6 - 5e5 * std::sin(1e-5 * true_us));
  };
  EXPECT_THAT(after(2.0, uneven, as_it_is).fault(),
              testing::ContainsRegex("by 0\\.[5-6] to 1\\.[4-6] s"));
}

TEST(ClockComparison, OneLateFrameIsNoFault) {
  ClockComparison clocks = after(2.0, as_it_is, as_it_is);
  clocks.saw_frame(1'700'000'001'000'000, begin_s + 2.0, kept_s);
  EXPECT_EQ(clocks.fault(), "");
}

TEST(ClockComparison, DifferenceIsToldInTwoSeconds) {
  EXPECT_THAT(after(2.0, shifted_by(-3600.0), as_it_is).fault(),
              AllOf(HasSubstr("frames are stamped 3600.1 s behind the head's angles"),
                    HasSubstr("constantly")));
  EXPECT_THAT(after(2.0, shifted_by(2.0), as_it_is).fault(), HasSubstr("1.9 s ahead of"));
  EXPECT_THAT(after(2.0, as_it_is, shifted_by(-1796.0)).fault(), HasSubstr("1795.9 s ahead of"));
}

TEST(ClockComparison, UnitsAreRecognised) {
  EXPECT_THAT(after(2.0, times(1000.0), as_it_is).fault(),
              HasSubstr("frames seem to be stamped in nanoseconds"));
  EXPECT_THAT(after(2.0, as_it_is, times(0.001)).fault(),
              HasSubstr("head states seem to be stamped in milliseconds"));
  EXPECT_THAT(after(2.0, times(1e-6), as_it_is).fault(), HasSubstr("in seconds"));
}

TEST(ClockComparison, ClockThatIsSetRightEndsTheFault) {
  ClockComparison clocks = after(2.0, shifted_by(5.0), as_it_is);
  ASSERT_NE(clocks.fault(), "");
  clocks.saw_head_state(1'700'000'010'000'000, begin_s + 10.0);
  clocks.saw_frame(1'700'000'009'950'000, begin_s + 10.0, kept_s);
  EXPECT_EQ(clocks.fault(), "");
}

/// What is said in the 5 s after a step of an hour, which the head states make first and the frames
/// `frames_s` later.
std::string after_set_back(double frames_s) {
  ClockComparison clocks;
  std::string said;
  for (int i = 0; i < 50 * 7; ++i) {
    const double t = i / 50.0, step_s = t - 2.0;
    const auto stamp = [&](double latency_s, double begins_s) {
      return as_it_is(1e6 * (1.7e9 + t - latency_s - (step_s >= begins_s ? 3600.0 : 0.0)));
    };
    clocks.saw_head_state(stamp(0.0, 0.0), begin_s + t);
    if (i % 5 == 0) clocks.saw_frame(stamp(0.06, frames_s), begin_s + t + 0.001, kept_s);
    if (said.empty() && !clocks.fault().empty()) said = clocks.fault();
  }
  return said;
}

TEST(ClockComparison, OneClockThatIsSetBackIsNotTwoThatDiffer) {
  for (const double frames_s : {0.0, 0.3, 0.7, 1.0}) EXPECT_EQ(after_set_back(frames_s), "");
}

TEST(ClockComparison, ClockThatAloneIsSetBackIsToldInThreeSeconds) {
  EXPECT_THAT(after_set_back(3.0), HasSubstr("frames are stamped 3599.9 s ahead of"));
}

TEST(ClockComparison, DriftIsToldWithinAMinute) {
  const auto slow = [](double true_us) { return as_it_is(true_us - 0.005 * (true_us - 1.7e15)); };
  ClockComparison clocks = after(60.0, slow, as_it_is);
  EXPECT_EQ(clocks.fault(), "");
  EXPECT_THAT(clocks.warning(), HasSubstr("drift apart by 5.0 ms a second"));
  EXPECT_EQ(clocks.warning(), "");
}

TEST(ClockComparison, DamagedStampIsNotTheClock) {
  ClockComparison clocks = after(2.0, as_it_is, as_it_is);
  clocks.saw_frame(0, begin_s + 2.0, kept_s);
  EXPECT_EQ(clocks.fault(), "");
}

}  // namespace
}  // namespace gazed::daemon::clock_comparison_test
