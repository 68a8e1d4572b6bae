#include "drivers/v4l2/buffers.hpp"

#include <cerrno>
#include <cstring>

#include "agent/base/text.hpp"

namespace gazed::v4l2 {

namespace {

// One is held while its frame is looked at, one is being filled, and one waits to be filled next:
// with two the camera would lose every frame that ends while we look at one. A fourth would hold
// 614 kB for a frame that is older than the one wanted.
constexpr std::uint32_t buffers_needed = 3;
constexpr std::uint32_t buffers_max = 32;  // VIDEO_MAX_FRAME of the kernel

v4l2_buffer empty_buffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

}  // namespace

std::string VideoBuffers::start(std::size_t bytes) {
  v4l2_requestbuffers wish{};
  wish.count = buffers_needed;
  wish.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  wish.memory = V4L2_MEMORY_MMAP;
  if (const int error = device_.request(VIDIOC_REQBUFS, wish); error != 0)
    return "VIDIOC_REQBUFS: " + camera_error(error);
  if (wish.count < buffers_needed || wish.count > buffers_max) {
    return base::text("the camera's driver gives %u buffers, %u to %u are needed", wish.count,
                      buffers_needed, buffers_max);
  }
  mapped_.reserve(wish.count);
  for (std::uint32_t i = 0; i < wish.count; ++i) {
    if (std::string problem = map(i, bytes); !problem.empty()) return problem;
  }
  for (std::uint32_t i = 0; i < wish.count; ++i) {
    if (const int error = give_back(i); error != 0) return "VIDIOC_QBUF: " + camera_error(error);
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = device_.request(VIDIOC_STREAMON, type); error != 0)
    return "VIDIOC_STREAMON: " + camera_error(error);
  streaming_ = true;
  return {};
}

std::string VideoBuffers::map(std::uint32_t index, std::size_t bytes) {
  v4l2_buffer buffer = empty_buffer(index);
  if (const int error = device_.request(VIDIOC_QUERYBUF, buffer); error != 0)
    return "VIDIOC_QUERYBUF: " + camera_error(error);
  if (buffer.length < bytes) {
    return base::text("the camera's driver gives buffers of %u bytes, %zu are needed",
                      buffer.length, bytes);
  }
  void* start = system_.map(buffer.length, device_.descriptor(), buffer.m.offset);
  if (start == nullptr) return base::text("mmap: %s", std::strerror(errno));
  mapped_.push_back({start, buffer.length});
  return {};
}

void VideoBuffers::stop() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  // A camera that is gone cannot be told; closing its device ends the stream all the same.
  if (streaming_) static_cast<void>(device_.request(VIDIOC_STREAMOFF, type));
  streaming_ = false;
  for (const Mapped& buffer : mapped_) system_.unmap(buffer.start, buffer.length);
  mapped_.clear();
}

int VideoBuffers::take(v4l2_buffer& buffer) const {
  buffer = empty_buffer(0);
  const int error = device_.request(VIDIOC_DQBUF, buffer);
  if (error != 0) return error;
  return buffer.index < mapped_.size() ? 0 : EIO;
}

int VideoBuffers::give_back(std::uint32_t index) const {
  v4l2_buffer buffer = empty_buffer(index);
  return device_.request(VIDIOC_QBUF, buffer);
}

}  // namespace gazed::v4l2
