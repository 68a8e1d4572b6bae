// Where frames come from that are looked at one after the other: a camera, or a video.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "drivers/camera.hpp"

namespace gazed::lab::live {

class Frames {
 public:
  virtual ~Frames() = default;
  /// The next frame, 8UC3, blue green red, waited for if it must be; empty at the end. Throws
  /// std::runtime_error with the reason when none comes.
  [[nodiscard]] virtual cv::Mat next() = 0;
  /// As it should be shown, frames a second; 0: as they come.
  [[nodiscard]] virtual double pace() const { return 0.0; }
  [[nodiscard]] virtual const std::string& name() const = 0;
};

class Camera : public Frames {
 public:
  /// gazed's own driver: 640x480, YUYV or else JPEG, the newest frame. `device` is "/dev/video0".
  explicit Camera(const std::string& device);
  /// Any driver, which gets `patience_s` for a frame.
  Camera(std::string name, std::unique_ptr<drivers::CameraDriver> driver, double patience_s);

  [[nodiscard]] cv::Mat next() override;
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  std::string name_;
  std::unique_ptr<drivers::CameraDriver> driver_;
  double patience_s_;
};

/// Whatever OpenCV's decoders read, at the pace it was taken with.
class Video : public Frames {
 public:
  /// Throws std::invalid_argument for what is no video.
  explicit Video(const std::string& file);

  [[nodiscard]] cv::Mat next() override;
  [[nodiscard]] double pace() const override { return pace_; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  std::string name_;
  cv::VideoCapture capture_;
  double pace_ = 0.0;
};

}  // namespace gazed::lab::live
