#include "agent/lab/live/sources.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <poll.h>
#include <stdexcept>
#include <thread>
#include <utility>

#include "agent/lab/io/frame_picture.hpp"
#include "drivers/v4l2/v4l2_camera.hpp"

namespace gazed::lab::live {

namespace {

using Clock = std::chrono::steady_clock;

// To open a camera takes some of them two seconds.
constexpr double patience_with_a_camera_s = 5.0;
// The driver wants to be asked every 100 ms, descriptor or not.
constexpr std::chrono::milliseconds between_asks{50};

}  // namespace

Camera::Camera(const std::string& device)
    : Camera(device, std::make_unique<v4l2::V4l2Camera>(v4l2::V4l2Settings{.device = device}),
             patience_with_a_camera_s) {}

Camera::Camera(std::string name, std::unique_ptr<drivers::CameraDriver> driver, double patience_s)
    : name_(std::move(name)), driver_(std::move(driver)), patience_s_(patience_s) {}

cv::Mat Camera::next() {
  const auto end = Clock::now() + std::chrono::duration<double>(patience_s_);
  for (;;) {
    if (const auto frame = driver_->next_frame()) return io::bgr_of(frame->image);
    if (driver_->finished()) return {};
    if (Clock::now() > end) {
      const std::string why = driver_->health().words;  // names the device
      throw std::runtime_error(why.empty() ? name_ + ": no frame comes" : why);
    }
    pollfd ready{driver_->descriptor(), POLLIN, 0};
    if (ready.fd < 0) {
      std::this_thread::sleep_for(between_asks);
    } else {
      poll(&ready, 1, static_cast<int>(between_asks.count()));
    }
  }
}

Video::Video(const std::string& file) : name_(file) {
  // OpenCV would take a name with a % for pictures in a row, and others for a network's address.
  if (!std::filesystem::is_regular_file(file)) {
    throw std::invalid_argument("--video: " + file + ": there is no such file");
  }
  if (!capture_.open(file, cv::CAP_FFMPEG)) {
    throw std::invalid_argument("--video: " + file + ": no video that OpenCV can decode");
  }
  const double told = capture_.get(cv::CAP_PROP_FPS);
  constexpr double fastest = 1000.0;  // more is nonsense
  if (std::isfinite(told) && told > 0.0 && told <= fastest) pace_ = told;
}

cv::Mat Video::next() {
  cv::Mat bgr;
  capture_.read(bgr);
  return bgr;
}

}  // namespace gazed::lab::live
