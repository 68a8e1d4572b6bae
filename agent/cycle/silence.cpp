// What cannot be used, what does not come, and clocks that are set back.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"
#include "agent/cycle/cycle.hpp"

namespace gazed::cycle {

namespace {

/// Drivers drop what is late: what is earlier by more than this is of a clock that was set back.
bool is_set_back(std::int64_t newest_us, std::int64_t utime_us) {
  constexpr double farthest_s = 0.5;
  return base::plausible_utime(utime_us) && base::seconds_between(utime_us, newest_us) > farthest_s;
}

}  // namespace

/// A clock that is set takes along what is timed by it: how long a fixation lasts, when a fault was
/// last reported. One that was set ahead shows as a gap longer than any silence that was reported.
void Cycle::follow_a_clock_that_is_set(std::int64_t utime_us, CycleOutput& output) {
  if (history_.empty() || !base::plausible_utime(utime_us)) return;
  const std::int64_t newest_us = history_.newest().utime_us;
  const bool back = is_set_back(newest_us, utime_us);
  if (!back && base::seconds_between(newest_us, utime_us) <= settings_.head_timeout_s) return;
  const std::int64_t step_us = utime_us - newest_us;
  command_utime_us_ += step_us;
  if (looking_since_us_) *looking_since_us_ += step_us;
  if (last_head_fault_us_) *last_head_fault_us_ += step_us;
  if (back && look_under_way()) {
    end_by_head_fault(base::text("the clock of the head states was set back by %.1f s",
                                 -1e-6 * static_cast<double>(step_us)),
                      utime_us, output);
  }
  // What is known of the head is of times that come once more, or of a while ago.
  history_ = HeadHistory(settings_.motion.settle_velocity_rad_s, encoder_sigma_rad_);
  if (!back) return;
  last_frame_utime_us_ = INT64_MIN;
  start_looking(INT64_MIN);
  if (must_look_back_ && !output.command) look_back(utime_us, output);
  if (output.command) history_.restart(output.command->utime_us + setting_off_us);
}

std::string Cycle::refusal_of(const geometry::Frame& frame) const {
  const base::ImageView& image = frame.image;
  if (image.width_px != camera_.width_px || image.height_px != camera_.height_px) {
    return base::text("a frame of %dx%d pixels came; configured: %dx%d", image.width_px,
                      image.height_px, camera_.width_px, camera_.height_px);
  }
  if (!base::plausible_utime(frame.utime_us)) {
    return "a frame came whose time is no time";
  }
  if (frame.utime_us <= last_frame_utime_us_ &&
      !is_set_back(last_frame_utime_us_, frame.utime_us)) {
    return base::text("a frame came whose time lies %.3f s before the last one's",
                      base::seconds_between(frame.utime_us, last_frame_utime_us_));
  }
  return {};
}

CycleOutput Cycle::on_silence(const Silence& silence) {
  CycleOutput output;
  const bool camera_is_silent = silence.camera_s >= settings_.camera.timeout_s;
  const bool head_is_silent = silence.head_s >= settings_.head_timeout_s;
  if (!camera_is_silent && !head_is_silent) return output;
  std::string reason;
  const auto add = [&reason](const std::string& what, std::string_view why) {
    reason.append(reason.empty() ? "" : "; ").append(what);
    if (!why.empty()) reason.append(": ").append(why);
  };
  if (camera_is_silent) {
    add(base::text("no usable frame for %.1f s", silence.camera_s),
        refused_frame_.empty() ? silence.camera_fault : std::string_view(refused_frame_));
  }
  if (head_is_silent)
    add(base::text("no head state for %.1f s", silence.head_s), silence.head_fault);
  report_silence(camera_is_silent ? Status::camera_fault : Status::head_fault, std::move(reason),
                 silence.now_s, output);
  return output;
}

/// The newest time; of two that lie far apart the earlier one, since the other's clock was set back
/// meanwhile.
std::int64_t Cycle::believed_utime_us() const {
  constexpr double far_s = 60.0;
  const std::int64_t newest_us = history_.empty() ? 0 : history_.newest().utime_us;
  const auto [earlier, later] =
      std::minmax({std::max<std::int64_t>(0, last_frame_utime_us_), newest_us});
  return earlier > 0 && base::seconds_between(earlier, later) > far_s ? earlier : later;
}

void Cycle::report_silence(Status status, std::string reason, double now_s, CycleOutput& output) {
  std::optional<double>& reported_s =
      status == Status::camera_fault ? camera_reported_s_ : head_reported_s_;
  const bool look_is_cut_short = look_under_way();
  must_look_back_ = must_look_back_ || planned_look_under_way();
  if (look_is_cut_short || !reported_s || now_s - *reported_s >= fault_repeat_s) {
    reported_s = now_s;
    Fixation fixation = new_fixation(believed_utime_us(), status, std::move(reason));
    // Not by the frames' clock, which may have been set back.
    if (!history_.empty()) fixation.duration_s = looked_for_s(history_.newest().utime_us);
    fixation.counts = look_is_cut_short;
    if (look_is_cut_short) report_first_view(fixation);
    finish(std::move(fixation), output);
  }
  start_looking(history_.empty() ? INT64_MIN : history_.newest().utime_us);
  // Whatever comes back may count its time anew.
  if (status == Status::camera_fault) last_frame_utime_us_ = INT64_MIN;
  if (status == Status::head_fault) {
    history_ = HeadHistory(settings_.motion.settle_velocity_rad_s, encoder_sigma_rad_);
  }
  state_ = CycleState::fault;
  fault_ = status;
}

}  // namespace gazed::cycle
