#include "agent/daemon/clock_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"

namespace gazed::daemon {

namespace {

// No camera stamps its frames later than this after the head's newest state, or delivers them this
// late; if it does, a fault is reported.
constexpr double greatest_ahead_s = 0.5, greatest_lag_s = 0.5;
// A larger difference is not explained by a slow connection to the camera.
constexpr double slowest_way_s = 2.5;
// A single stamp may be damaged; a run of them that lasts this long is the clock. Including the
// second until the next status, the fault is reported within 2 s.
constexpr int fewest_frames = 5;
constexpr double shortest_run_s = 0.7;
constexpr double constant_within_s = 0.25;  // the network's jitter
// If one clock serves both and is set back, one of the two is accepted before the other, whose
// messages look late for a while (lcm::UtimeCheck: less than a second at five messages a second or
// more).
constexpr double set_back_by_s = 0.5, follows_within_s = 1.2;

/// Returns "frames are stamped in milliseconds", or an empty text if no unit explains the
/// difference.
std::string other_unit(std::int64_t frame_us, std::int64_t head_us) {
  struct Unit {
    double per_second;
    const char* name;
  };
  constexpr auto units =
      std::to_array<Unit>({{1e9, "nanoseconds"}, {1e3, "milliseconds"}, {1.0, "seconds"}});
  constexpr double microseconds = 1e6, alike = 1.02;
  // Frames in nanoseconds and head states in milliseconds have the same ratio: microseconds are the
  // value between the years 2000 and 2100.
  const bool frames_are_right = frame_us > 946'000'000'000'000 && frame_us < 4'102'000'000'000'000;
  const double ratio = static_cast<double>(frame_us) / std::max(1.0, static_cast<double>(head_us));
  for (const auto& [per_second, name] : units) {
    const double unit_ratio = per_second / microseconds;
    const double expected = frames_are_right ? 1.0 / unit_ratio : unit_ratio;
    if (ratio > alike * expected || expected > alike * ratio) continue;
    return base::text("%s seem to be stamped in %s", frames_are_right ? "head states" : "frames",
                      name);
  }
  return {};
}

std::string difference(std::int64_t frame_us, std::int64_t head_us, double least_s,
                       double greatest_s, double kept_s) {
  const std::string unit = other_unit(frame_us, head_us);
  if (!unit.empty()) return unit + ", the others in microseconds, as utime is";
  const double offset_s = 0.5 * (least_s + greatest_s);
  const bool constant = greatest_s - least_s <= constant_within_s;
  std::string words = base::text("frames are stamped %.1f s %s the head's angles, ",
                                 std::abs(offset_s), offset_s > 0.0 ? "ahead of" : "behind");
  words += constant
               ? "constantly"
               : base::text("by %.1f to %.1f s", std::min(std::abs(least_s), std::abs(greatest_s)),
                            std::max(std::abs(least_s), std::abs(greatest_s)));
  if (least_s < -slowest_way_s || greatest_s > greatest_ahead_s) {
    return "the clocks of frames and head states differ: " + words +
           (constant ? ": one clock is set wrong" : "");
  }
  words += ": they come late, or their clock is behind; ";
  if (-least_s > kept_s)
    return words + base::text(
                       "at the rate at which the angles come, those of the last %.2f s are kept: "
                       "there are none for such frames",
                       kept_s);
  return words + "they get the angles of that time, which is wrong if it is the clock";
}

}  // namespace

void ClockComparison::notice_set_back(std::int64_t utime_us, std::int64_t before_us, double now_s) {
  if (base::seconds_between(utime_us, before_us) > set_back_by_s) set_back_s_ = now_s;
}

void ClockComparison::saw_head_state(std::int64_t utime_us, double now_s) {
  if (head_came_) notice_set_back(utime_us, head_utime_us_, now_s);
  head_utime_us_ = utime_us;
  head_came_s_ = now_s;
  head_came_ = true;
}

void ClockComparison::saw_frame(std::int64_t utime_us, double now_s, double kept_s) {
  constexpr double longest_silence_s = 1.0;  // of the head; longer is a fault of its own
  if (frame_came_) notice_set_back(utime_us, frame_utime_us_, now_s);
  frame_utime_us_ = utime_us;
  frame_came_ = true;
  if (!head_came_ || now_s - head_came_s_ > longest_silence_s) return;
  const double offset_s = base::seconds_between(head_utime_us_, utime_us) - (now_s - head_came_s_);
  if (offset_s <= greatest_ahead_s && offset_s >= -std::min(greatest_lag_s, kept_s)) {
    apart_ = {};
    fault_.clear();
    watch_drift(offset_s, now_s);
    return;
  }
  if (apart_.frames++ == 0) apart_ = {1, now_s, offset_s, offset_s};
  apart_.least_s = std::min(apart_.least_s, offset_s);
  apart_.greatest_s = std::max(apart_.greatest_s, offset_s);
  const bool lasts = apart_.frames >= fewest_frames && now_s - apart_.begin_s >= shortest_run_s &&
                     now_s - set_back_s_ >= follows_within_s;
  if (lasts && fault_.empty()) {
    fault_ = difference(utime_us, head_utime_us_, apart_.least_s, apart_.greatest_s, kept_s);
  }
}

void ClockComparison::watch_drift(double offset_s, double now_s) {
  constexpr double stretch_s = 10.0, first_to_last_s = 40.0;
  // 20 times a bad crystal's drift: 4 ms in the 2 s of a fixation, in which the head turns by 4
  // mrad.
  constexpr double least_drift = 0.002;
  if (stretch_begin_s_ < 0.0 || now_s - stretch_begin_s_ > stretch_s) {
    if (stretch_begin_s_ >= 0.0 && first_begin_s_ < 0.0) {
      first_begin_s_ = stretch_begin_s_;
      first_greatest_s_ = stretch_greatest_s_;
    }
    const double since_first_s = stretch_begin_s_ - first_begin_s_;
    const double drift = (stretch_greatest_s_ - first_greatest_s_) / since_first_s;
    if (first_begin_s_ >= 0.0 && since_first_s >= first_to_last_s && !drift_reported_ &&
        std::abs(drift) >= least_drift) {
      drift_reported_ = true;
      warning_ = base::text(
          "the clocks of frames and head states drift apart by %.1f ms a second: frames will "
          "get the angles of another time",
          1e3 * std::abs(drift));
    }
    stretch_begin_s_ = now_s;
    stretch_greatest_s_ = offset_s;
  }
  stretch_greatest_s_ = std::max(stretch_greatest_s_, offset_s);
}

}  // namespace gazed::daemon
