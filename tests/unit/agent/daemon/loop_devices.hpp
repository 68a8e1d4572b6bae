// Cameras and heads for tests of the loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/image.hpp"
#include "drivers/camera.hpp"
#include "drivers/head.hpp"

namespace gazed::daemon::loop_test {

// A head and a camera whose events are given beforehand.
class ListedHead : public drivers::HeadDriver {
 public:
  explicit ListedHead(std::vector<geometry::HeadState> states) : states_(std::move(states)) {}
  std::optional<std::int64_t> next_utime_us() override {
    return finished() ? std::nullopt : std::optional(states_[next_].utime_us);
  }
  std::optional<geometry::HeadState> next_state() override {
    return finished() ? std::nullopt : std::optional(states_[next_++]);
  }
  void command(const geometry::HeadCommand&) override {}
  void hold() override { ++*holds; }
  bool finished() const override { return next_ == states_.size(); }
  std::string warning() override { return std::exchange(warning_, {}); }
  std::shared_ptr<int> holds = std::make_shared<int>(0);

 private:
  std::vector<geometry::HeadState> states_;
  std::size_t next_ = 0;
  std::string warning_ = "this head is listed";
};

class ListedCamera : public drivers::CameraDriver {
 public:
  ListedCamera(base::Image image, std::vector<std::int64_t> utimes_us)
      : image_(std::move(image)), utimes_us_(std::move(utimes_us)) {}
  std::optional<std::int64_t> next_utime_us() override {
    return finished() ? std::nullopt : std::optional(utimes_us_[next_]);
  }
  std::optional<geometry::Frame> next_frame() override {
    return finished() ? std::nullopt
                      : std::optional(geometry::Frame{image_.view(), utimes_us_[next_++]});
  }
  bool finished() const override { return next_ == utimes_us_.size(); }

 private:
  base::Image image_;
  std::vector<std::int64_t> utimes_us_;
  std::size_t next_ = 0;
};

// A camera that gives grey frames of the wall clock's time; at first, of a clock that is ahead.
class LiveCamera : public drivers::CameraDriver {
 public:
  explicit LiveCamera(int frames_ahead = 0, std::int64_t ahead_us = 0)
      : frames_ahead_(frames_ahead), ahead_us_(ahead_us) {}
  std::optional<geometry::Frame> next_frame() override {
    const std::int64_t now_us = wall_us();
    if (now_us < next_us_) return std::nullopt;
    next_us_ = now_us + 33'000;
    return geometry::Frame{image_.view(), frames_ahead_-- > 0 ? now_us + ahead_us_ : now_us};
  }
  std::string warning() override { return std::exchange(warning_, {}); }

  static std::int64_t wall_us() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  }

 private:
  base::Image image_{640, 480, base::PixelFormat::yuyv};
  int frames_ahead_;
  std::int64_t ahead_us_;
  std::int64_t next_us_ = 0;
  std::string warning_ = "this camera is grey";
};

}  // namespace gazed::daemon::loop_test
