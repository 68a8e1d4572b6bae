#include "drivers/v4l2/v4l2_camera.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>
#include <variant>

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"
#include "drivers/jpeg/decoder.hpp"
#include "drivers/v4l2/controls.hpp"

namespace gazed::v4l2 {

namespace {

constexpr std::int64_t first_back_off_us = 100'000;
constexpr std::int64_t longest_back_off_us = 2'000'000;
// A camera that answers slowly, as one that is about to fail does (5 s for a request in Linux 4.4's
// uvcvideo), must not keep the loop for all the steps of opening it.
constexpr std::int64_t opening_slice_us = 50'000;

std::int64_t microseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(1e6 * seconds));
}

}  // namespace

V4l2Camera::V4l2Camera(V4l2Settings settings, VideoSystem system)
    : settings_(std::move(settings)), system_(std::move(system)), back_off_us_(first_back_off_us) {}

std::optional<geometry::Frame> V4l2Camera::next_frame() {
  if (opening_ != Opening::done) {
    if (opening_ == Opening::device && system_.clocks.monotonic_us() < next_attempt_us_)
      return std::nullopt;
    if (const std::string problem = open(); !problem.empty()) {
      lose(drivers::HealthKind::lost, problem);
      return std::nullopt;
    }
    if (opening_ != Opening::done) return std::nullopt;
  }
  if (const std::string problem = take_newest(); !problem.empty()) {
    lose(drivers::HealthKind::lost, problem);
    return std::nullopt;
  }
  if (held_ && decode()) return frame();
  if (system_.clocks.monotonic_us() - last_frame_us_ > microseconds(settings_.timing.timeout_s))
    lose(drivers::HealthKind::no_data,
         base::text("no frame for %.1f s", settings_.timing.timeout_s) + unusable_);
  return std::nullopt;
}

std::string V4l2Camera::open() {
  const std::int64_t slice_ends_us = system_.clocks.monotonic_us() + opening_slice_us;
  do {
    if (std::string problem = open_next(); !problem.empty()) return problem;
  } while (opening_ != Opening::done && system_.clocks.monotonic_us() < slice_ends_us);
  return {};
}

std::string V4l2Camera::open_next() {
  switch (opening_) {
    case Opening::device:
      opening_ = Opening::format;
      return device_.open(settings_.device);
    case Opening::format: {
      const auto format = set_format(device_, settings_.width_px, settings_.height_px);
      if (const auto* problem = std::get_if<VideoProblem>(&format)) return problem->what;
      format_ = std::get<VideoFormat>(format);
      if (format_.is_jpeg())
        report(base::text("no YUYV of %dx%d: its JPEG frames (MJPG) are decoded", format_.width_px,
                          format_.height_px));
      report(set_frame_rate(device_));
      // The format first: setting it makes some drivers forget their controls.
      opening_ = Opening::controls;
      return {};
    }
    case Opening::controls: {
      ControlsSet set =
          set_controls(device_, settings_.controls, settings_.flips_by_extension_unit);
      for (std::string& problem : set.problems) report(std::move(problem));
      opening_ = Opening::buffers;
      return set.fault;
    }
    case Opening::buffers:
      if (std::string problem = buffers_.start(format_.bytes()); !problem.empty()) return problem;
      opening_ = Opening::done;
      begin_stream();
      return {};
    case Opening::done:
      break;
  }
  return {};
}

void V4l2Camera::begin_stream() {
  gaps_.restart();
  stamp_clock_.reset();
  repeated_stamp_ = {};
  unusable_.clear();
  first_frames_left_ = settings_.first_frames_dropped;
  last_frame_us_ = system_.clocks.monotonic_us();
  if (std::exchange(lost_, false)) ++reopened_;
}

void V4l2Camera::close() {
  held_.reset();
  buffers_.stop();
  device_.close();
  opening_ = Opening::device;
}

void V4l2Camera::lose(drivers::HealthKind fault, const std::string& why) {
  close();
  fault_ = fault;
  fault_words_ = settings_.device + ": " + why;
  lost_ = std::exchange(frames_came_, false) || lost_;
  next_attempt_us_ = system_.clocks.monotonic_us() + back_off_us_;
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
    v4l2_buffer buffer{};
    const int taken = buffers_.take(buffer);
    if (taken == EAGAIN) break;
    if (taken != 0) return "VIDIOC_DQBUF: " + camera_error(taken);
    left_out_ += gaps_.before(buffer.sequence);
    std::uint32_t unused = buffer.index;
    if (is_of_use(buffer)) {
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

bool V4l2Camera::is_of_use(const v4l2_buffer& buffer) {
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    ++damaged_;
    unusable_ = "; the last one was damaged";
    return false;
  }
  if (buffer.bytesused < format_.bytes()) {
    ++too_short_;
    unusable_ = base::text("; the last one had %u of %zu bytes", buffer.bytesused, format_.bytes());
    return false;
  }
  if (first_frames_left_ > 0) {
    --first_frames_left_;
    return false;
  }
  return true;
}

/// False where the frame is no picture.
bool V4l2Camera::decode() {
  if (!format_.is_jpeg()) return true;
  const std::size_t bytes = std::min<std::size_t>(held_->bytesused, buffers_.length(held_->index));
  const std::string problem = jpeg::decode({buffers_.data(held_->index), bytes}, format_.width_px,
                                           format_.height_px, decoded_);
  if (problem.empty()) return true;
  ++damaged_;
  unusable_ = "; of the last one: " + problem;
  return false;
}

geometry::Frame V4l2Camera::frame() {
  const ClockPair now = read_clocks(system_.clocks);
  const bool time_passed = now.monotonic_us > std::exchange(last_frame_us_, now.monotonic_us);
  frames_came_ = true;
  back_off_us_ = first_back_off_us;
  fault_ = drivers::HealthKind::ok;
  unusable_.clear();
  StampTime stamp = stamp_time(held_->flags, held_->timestamp, now);
  if (stamp.clock != stamp_clock_) check_stamp(stamp.clock);
  // Any numbers: whether they are the same again is all that counts.
  const std::uint64_t raw = 1'000'000U * static_cast<std::uint64_t>(held_->timestamp.tv_sec) +
                            static_cast<std::uint64_t>(held_->timestamp.tv_usec);
  const bool arrival_counted = repeated_stamp_.arrival_counts();
  repeated_stamp_.saw(static_cast<std::int64_t>(raw), time_passed);
  if (repeated_stamp_.arrival_counts()) {
    stamp.utime_us = now.realtime_us;
    if (!arrival_counted)
      report(
          "it gives every frame the same time stamp; frames count from when they are fetched, and "
          "where the head was then is uncertain");
  }
  const base::ImageView image =
      format_.is_jpeg()
          ? decoded_.view()
          : base::ImageView{buffers_.data(held_->index), format_.width_px, format_.height_px,
                            format_.row_stride, base::PixelFormat::yuyv};
  return {image, stamp.utime_us + microseconds(settings_.timing.delay_s)};
}

void V4l2Camera::check_stamp(StampClock clock) {
  stamp_clock_ = clock;
  if (clock == StampClock::none) {
    report(
        "its time stamps are by no clock of this computer; frames count from when they are "
        "fetched, and where the head was then is uncertain");
  }
  // Only a kernel that names the clock also names the event.
  constexpr std::uint32_t monotonic = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  const bool names_event = (held_->flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == monotonic;
  const bool at_the_end =
      names_event && (held_->flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_EOF;
  if (at_the_end && settings_.timing.delay_s > -0.5 * settings_.timing.readout_s) {
    report(base::text(
        "it stamps the end of a frame, whose first row was exposed camera.readout_s = %g s "
        "before or more; camera.delay_s = %g s does not say so",
        settings_.timing.readout_s, settings_.timing.delay_s));
  }
}

/// Once, however often the camera is opened.
void V4l2Camera::report(std::string what) {
  constexpr std::size_t noted_max = 64;  // a camera that says something new each time is let be
  if (what.empty() || noted_.size() >= noted_max || std::ranges::find(noted_, what) != noted_.end())
    return;
  unreported_ += (unreported_.empty() ? settings_.device + ": " : "; ") + what;
  noted_.push_back(std::move(what));
}

drivers::Health V4l2Camera::health() const {
  drivers::Health health{.dropped = older_ + left_out_ + damaged_ + too_short_};
  if (fault_ != drivers::HealthKind::ok) health.add(fault_, fault_words_);
  return health;
}

std::string V4l2Camera::notes() const {
  if (reopened_ == 0 && damaged_ == 0 && too_short_ == 0) return {};
  return settings_.device + ": opened again " + base::counted(reopened_, "time") + ", " +
         base::counted(damaged_, "frame") + " damaged, " + std::to_string(too_short_) +
         " too short";
}

}  // namespace gazed::v4l2
