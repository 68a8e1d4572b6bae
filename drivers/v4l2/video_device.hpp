// A video device that is open: what is asked of it goes through here.
//
// V4L2: the kernel's interface to cameras, "Linux Media Subsystem Documentation", part "Video for
// Linux API". Only what Linux 2.6.33 (NAO V4 and V5) has is used.
#pragma once

#include <string>

#include "drivers/v4l2/video_system.hpp"

namespace gazed::v4l2 {

class VideoDevice {
 public:
  /// `system` must outlive the device.
  explicit VideoDevice(const VideoSystem& system) : system_(system) {}
  ~VideoDevice() { close(); }
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;

  /// Opens a camera that streams. Empty, or why not and what to do; then it is closed.
  [[nodiscard]] std::string open(const std::string& path);
  void close();

  /// -1 while closed.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// An ioctl; 0 or its errno. A signal that comes between makes it try again.
  template <class Argument>
  [[nodiscard]] int request(unsigned long request, Argument& argument) const {
    return request_raw(request, &argument);
  }

 private:
  [[nodiscard]] int request_raw(unsigned long request, void* argument) const;
  [[nodiscard]] std::string capture_problem() const;

  const VideoSystem& system_;
  int descriptor_ = -1;
};

/// "Device or resource busy" and what that means of a camera.
[[nodiscard]] std::string camera_error(int error);

}  // namespace gazed::v4l2
