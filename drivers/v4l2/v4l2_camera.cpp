#include "drivers/v4l2/v4l2_camera.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "agent/text.hpp"

namespace gazed {

namespace {

constexpr std::int64_t first_back_off_us = 100'000;
constexpr std::int64_t longest_back_off_us = 2'000'000;

std::int64_t microseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(1e6 * seconds));
}

}  // namespace

V4l2Camera::V4l2Camera(V4l2Settings settings, VideoSystem system)
    : settings_(std::move(settings)), system_(std::move(system)), back_off_us_(first_back_off_us) {}

std::optional<Frame> V4l2Camera::next_frame() {
  if (device_.descriptor() < 0) {
    if (system_.monotonic_us() < next_attempt_us_) return std::nullopt;
    if (const std::string problem = open(); !problem.empty()) {
      lose(problem);
      return std::nullopt;
    }
  }
  if (const std::string problem = take_newest(); !problem.empty()) {
    lose(problem);
    return std::nullopt;
  }
  if (held_) return frame();
  if (system_.monotonic_us() - last_frame_us_ > microseconds(settings_.timeout_s))
    lose(text("no frame for %.1f s", settings_.timeout_s));
  return std::nullopt;
}

std::string V4l2Camera::open() {
  if (std::string problem = device_.open(settings_.device); !problem.empty()) return problem;
  const auto format = set_format(device_, settings_.width_px, settings_.height_px);
  if (const auto* problem = std::get_if<VideoProblem>(&format)) return problem->what;
  format_ = std::get<VideoFormat>(format);
  static_cast<void>(set_frame_rate(device_));
  if (std::string problem = buffers_.start(format_.bytes()); !problem.empty()) return problem;
  gaps_.restart();
  last_frame_us_ = system_.monotonic_us();
  return {};
}

void V4l2Camera::close() {
  held_.reset();
  buffers_.stop();
  device_.close();
}

void V4l2Camera::lose(const std::string& why) {
  close();
  fault_ = settings_.device + ": " + why;
  if (std::exchange(frames_came_, false)) ++reopened_;
  next_attempt_us_ = system_.monotonic_us() + back_off_us_;
  back_off_us_ = std::min(2 * back_off_us_, longest_back_off_us);
}

std::string V4l2Camera::take_newest() {
  if (held_) {
    if (const int error = buffers_.give_back(held_->index); error != 0)
      return "VIDIOC_QBUF: " + camera_error(error);
    held_.reset();
  }
  // A buffer at most each: a camera faster than we are would keep us here.
  for (std::size_t i = 0; i < buffers_.count(); ++i) {
    v4l2_buffer buffer;
    const int taken = buffers_.take(buffer);
    if (taken == EAGAIN) break;
    if (taken != 0) return "VIDIOC_DQBUF: " + camera_error(taken);
    left_out_ += gaps_.before(buffer.sequence);
    std::uint32_t unused = buffer.index;
    if (is_whole(buffer)) {
      if (!held_) {
        held_ = buffer;
        continue;
      }
      ++older_;
      unused = std::exchange(*held_, buffer).index;
    }
    if (const int error = buffers_.give_back(unused); error != 0)
      return "VIDIOC_QBUF: " + camera_error(error);
  }
  return {};
}

bool V4l2Camera::is_whole(const v4l2_buffer& buffer) {
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    ++damaged_;
  } else if (buffer.bytesused < format_.bytes()) {
    ++too_short_;
  } else {
    return true;
  }
  return false;
}

Frame V4l2Camera::frame() {
  const ClockPair now = read_clocks(system_);
  last_frame_us_ = now.monotonic_us;
  frames_came_ = true;
  back_off_us_ = first_back_off_us;
  fault_.clear();
  const StampTime stamp = stamp_time(held_->flags, held_->timestamp, now);
  const ImageView image{buffers_.data(held_->index), format_.width_px, format_.height_px,
                        format_.row_stride, PixelFormat::yuyv};
  return {image, stamp.utime_us + microseconds(settings_.delay_s)};
}

std::int32_t V4l2Camera::frames_dropped() const {
  const std::int64_t all = older_ + left_out_ + damaged_ + too_short_;
  return static_cast<std::int32_t>(
      std::min<std::int64_t>(all, std::numeric_limits<std::int32_t>::max()));
}

std::string V4l2Camera::notes() const {
  if (reopened_ == 0 && damaged_ == 0 && too_short_ == 0) return {};
  return text("%s: opened again %lld times, %lld frames damaged, %lld too short",
              settings_.device.c_str(), static_cast<long long>(reopened_),
              static_cast<long long>(damaged_), static_cast<long long>(too_short_));
}

}  // namespace gazed
