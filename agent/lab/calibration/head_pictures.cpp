#include "agent/lab/calibration/head_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <unistd.h>
#include <utility>

#include "agent/base/regular_file.hpp"
#include "agent/base/text.hpp"
#include "agent/cycle/head_history.hpp"
#include "agent/lab/calibration/even_selection.hpp"
#include "agent/lab/io/frames_csv.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/lab/io/picture_files.hpp"
#include "agent/lab/io/progress.hpp"
#include "drivers/log/event.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"
#include "drivers/log/log_reader.hpp"

namespace gazed::lab::calibration {

namespace {

namespace fs = std::filesystem;

// Slower is still: the head moves 0.02 mrad during a frame.
constexpr double still_velocity_rad_s = 0.02;
// Two encoder steps of 12 bit and noise.
constexpr double same_rest_rad = 0.004;
// Nearer to an earlier picture it tells nothing new.
constexpr double least_turn_rad = 0.02;

[[noreturn]] void fail(const std::string& name, const std::string& why) {
  throw std::runtime_error(name + ": " + why);
}

/// lcm-logger gives its files any name.
bool starts_as_log(const fs::path& file) {
  const base::RegularFile opened = base::open_regular_file(file);
  log::LogHeaderBytes bytes{};
  return read(opened.descriptor.get(), bytes.data(), bytes.size()) == std::ssize(bytes) &&
         log::decode(bytes).sync_word == log::log_sync_word;
}

std::vector<HeadPicture> read_folder(const fs::path& csv, const geometry::CameraModel& camera) {
  std::vector<HeadPicture> pictures;
  const std::vector<io::RecordedFrame> frames = io::read_frames_csv(csv);
  io::Progress progress(frames.size());
  for (const io::RecordedFrame& frame : frames) {
    const fs::path file = csv.parent_path() / frame.file;
    HeadPicture picture{.name = file.string(), .grey = {}, .measured = frame.head};
    cv::cvtColor(io::read_picture(file, io::Orientation::as_coded), picture.grey,
                 cv::COLOR_BGR2GRAY);
    if (picture.grey.cols != camera.width_px || picture.grey.rows != camera.height_px) {
      fail(picture.name, base::text("is %dx%d (line %d of frames.csv), the camera is %dx%d: set "
                                    "camera.width_px and camera.height_px with --config",
                                    picture.grey.cols, picture.grey.rows, frame.line,
                                    camera.width_px, camera.height_px));
    }
    pictures.push_back(std::move(picture));
    progress.show(pictures.size(),
                  base::text("%zu of %zu pictures read", pictures.size(), frames.size()));
  }
  return pictures;
}

/// A log's rests, one after the other.
class Rests {
 public:
  Rests(const fs::path& log, const geometry::CameraModel& camera, const lcm::Channels& channels,
        double readout_s)
      : camera_(log.string(), channels, camera.width_px, camera.height_px),
        head_(log.string(), channels),
        readout_us_(std::llround(1e6 * readout_s)) {}

  /// The last picture of each rest; of more than most_pictures of them, evenly chosen ones.
  std::vector<HeadPicture> all() {
    EvenSelection<HeadPicture> rests(most_pictures);
    std::vector<geometry::HeadAngles> places;  // of all rests
    io::Progress progress(std::nullopt);
    while (!camera_.finished()) {
      const auto frame = camera_.next_frame();
      if (!frame) continue;
      const auto capture = head_during(frame->utime_us);
      if (!capture || !capture->still) continue;
      if (geometry::greatest_difference(capture->sweep, {}) > same_rest_rad) continue;
      HeadPicture picture{
          .name = base::text("frame at %lld us", static_cast<long long>(frame->utime_us)),
          .grey = grey_of(frame->image),
          .measured = capture->measured};
      const auto same = std::ranges::find_if(places, [&](geometry::HeadAngles earlier) {
        return geometry::greatest_difference(earlier, picture.measured) < least_turn_rad;
      });
      if (same == places.end()) {
        places.push_back(picture.measured);
        rests.add(std::move(picture));
      } else if (same == places.end() - 1) {
        *same = picture.measured;
        rests.replace_newest(std::move(picture));  // the longer the head rests the stiller it is
      }
      progress.show(places.size(), base::text("%zu rests of the head found", places.size()));
    }
    return rests.take();
  }

 private:
  std::optional<cycle::HeadAtCapture> head_during(std::int64_t utime_us) {
    const std::int64_t end_us = utime_us + readout_us_;
    while (!head_.finished() && (history_.empty() || history_.newest().utime_us < end_us)) {
      if (const auto state = head_.next_state()) (void)history_.add(*state);
    }
    return history_.during(utime_us, readout_us_);
  }

  log::LogCamera camera_;
  log::LogHead head_;
  std::int64_t readout_us_;
  cycle::HeadHistory history_{still_velocity_rad_s};
};

std::vector<HeadPicture> read_log(const fs::path& log, const geometry::CameraModel& camera,
                                  double readout_s, const std::string& prefix) {
  std::vector<HeadPicture> rests = [&] {
    try {
      const lcm::Channels channels(log::recorded_prefix(log.string(), prefix));
      return Rests(log, camera, channels, readout_s).all();
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(error.what());
    }
  }();
  if (rests.empty()) {
    fail(log.string(), "no frame with a head that is still (slower than " +
                           base::text("%g rad/s) found", still_velocity_rad_s));
  }
  return rests;
}

}  // namespace

bool has_head_angles(const fs::path& source) {
  if (fs::is_directory(source)) {
    return fs::exists(source / "frames.csv") || io::pictures_in(source).empty();
  }
  return source.extension() == ".csv" || source.extension() == ".lcm" || starts_as_log(source);
}

cv::Mat grey_of(const base::ImageView& image) {
  cv::Mat grey(image.height_px, image.width_px, CV_8UC1);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(base::luma(image, x, y));
    }
  }
  return grey;
}

std::vector<HeadPicture> read_head_pictures(const fs::path& source,
                                            const geometry::CameraModel& camera, double readout_s,
                                            const std::string& channel_prefix) {
  if (fs::is_directory(source)) return read_folder(source / "frames.csv", camera);
  if (source.extension() == ".csv") return read_folder(source, camera);
  return read_log(source, camera, readout_s, channel_prefix);
}

}  // namespace gazed::lab::calibration
