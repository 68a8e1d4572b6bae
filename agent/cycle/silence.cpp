// What cannot be used, and what does not come.
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

std::string Cycle::refusal_of(const geometry::Frame& frame) const {
  const base::ImageView& image = frame.image;
  if (image.width_px != camera_.width_px || image.height_px != camera_.height_px) {
    return base::text("a frame of %dx%d pixels came; configured: %dx%d", image.width_px,
                      image.height_px, camera_.width_px, camera_.height_px);
  }
  if (!base::plausible_utime(frame.utime_us)) {
    return "a frame came whose time is no time";
  }
  if (frame.utime_us <= last_frame_utime_us_) {
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
  if (look_is_cut_short || !reported_s || now_s - *reported_s >= fault_repeat_s) {
    reported_s = now_s;
    Fixation fixation = new_fixation(believed_utime_us(), status, std::move(reason));
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
