// The memory that kernel and driver pass back and forth: a queue of buffers to be filled, a queue
// of filled ones. A buffer is in one of them, or held by us.
#pragma once

#include <cstddef>
#include <cstdint>
#include <linux/videodev2.h>
#include <string>
#include <vector>

#include "drivers/v4l2/video_device.hpp"

namespace gazed::v4l2 {

class VideoBuffers {
 public:
  /// `system` and `device` must outlive the buffers.
  VideoBuffers(const VideoSystem& system, const VideoDevice& device)
      : system_(system), device_(device) {}
  ~VideoBuffers() { stop(); }
  VideoBuffers(const VideoBuffers&) = delete;
  VideoBuffers& operator=(const VideoBuffers&) = delete;

  /// Maps buffers of at least `bytes`, queues all and lets the camera stream. Empty, or why not;
  /// call stop() then.
  [[nodiscard]] std::string start(std::size_t bytes);
  /// Ends the stream and unmaps everything.
  void stop();

  /// Takes a filled buffer: 0 or an errno, EAGAIN when none is filled. A buffer with an index that
  /// cannot be is EIO.
  [[nodiscard]] int take(v4l2_buffer& buffer) const;
  /// Gives it back to be filled: 0 or an errno.
  [[nodiscard]] int give_back(std::uint32_t index) const;

  [[nodiscard]] std::size_t count() const { return mapped_.size(); }
  [[nodiscard]] const std::uint8_t* data(std::uint32_t index) const {
    return static_cast<const std::uint8_t*>(mapped_[index].start);
  }
  [[nodiscard]] std::size_t length(std::uint32_t index) const { return mapped_[index].length; }

 private:
  struct Mapped {
    void* start;
    std::size_t length;
  };

  [[nodiscard]] std::string map(std::uint32_t index, std::size_t bytes);

  const VideoSystem& system_;
  const VideoDevice& device_;
  std::vector<Mapped> mapped_;
  bool streaming_ = false;
};

}  // namespace gazed::v4l2
