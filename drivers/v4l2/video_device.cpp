#include "drivers/v4l2/video_device.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <linux/videodev2.h>
#include <string_view>

#include "agent/base/text.hpp"

namespace gazed::v4l2 {

namespace {

// More signals than that in one call do not come; it is not waited for ever.
constexpr int tries_max = 16;

std::string open_problem(int error) {
  switch (error) {
    case ENOENT:
      return "no such device; is the camera connected, and its kernel module loaded?";
    case EACCES:
    case EPERM:
      return "no permission; add the user to the group video (usermod -aG video USER) and log in "
             "again";
    case EISDIR:
      return "a directory, not a video device";
    default:
      return camera_error(error);
  }
}

/// Text of a fixed field, which need not end in a 0.
template <std::size_t size>
std::string field_text(const __u8 (&field)[size]) {
  std::string_view text(reinterpret_cast<const char*>(field), size);
  return base::excerpt(text.substr(0, text.find('\0')));
}

}  // namespace

std::string camera_error(int error) {
  std::string words = std::strerror(error);
  switch (error) {
    case EBUSY:
      return words +
             ": another program uses the camera (on a NAO: ALVideoDevice of NAOqi, which "
             "can be left out of its autoload.ini)";
    case ENOSPC:
      return words + ": not enough bandwidth on the USB bus for this size and rate";
    case ENODEV:
    case ENXIO:
      return words + ": the camera is gone";
    default:
      return words;
  }
}

std::string VideoDevice::open(const std::string& path) {
  close();
  for (int i = 0; i < tries_max && descriptor_ < 0; ++i) {
    descriptor_ = system_.open(path.c_str());
    if (descriptor_ < 0 && errno != EINTR) return open_problem(errno);
  }
  if (descriptor_ < 0) return open_problem(EINTR);
  std::string problem = capture_problem();
  if (!problem.empty()) close();
  return problem;
}

std::string VideoDevice::capture_problem() const {
  v4l2_capability found{};
  const int error = request(VIDIOC_QUERYCAP, found);
  // A device that is not V4L2's answers with one of these; the last one is an emulated kernel's.
  if (error == ENOTTY || error == EINVAL || error == ENOSYS) return "not a video device";
  if (error != 0) return "VIDIOC_QUERYCAP: " + camera_error(error);
  // What this node can do, where the kernel tells it apart from what the whole device can (3.4).
  const std::uint32_t can =
      (found.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? found.device_caps : found.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    return base::text(
        "this node of \"%s\" (driver %s) does not capture video (capabilities 0x%08x); another "
        "/dev/video* may",
        field_text(found.card).c_str(), field_text(found.driver).c_str(), can);
  }
  if ((can & V4L2_CAP_STREAMING) == 0) {
    return base::text("\"%s\" (driver %s) does not stream into memory (capabilities 0x%08x)",
                      field_text(found.card).c_str(), field_text(found.driver).c_str(), can);
  }
  return {};
}

void VideoDevice::close() {
  if (descriptor_ >= 0) system_.close(descriptor_);
  descriptor_ = -1;
}

int VideoDevice::request_raw(unsigned long request, void* argument) const {
  for (int i = 0; i < tries_max; ++i) {
    if (system_.ioctl(descriptor_, request, argument) >= 0) return 0;
    if (errno != EINTR) return errno;
  }
  return EINTR;
}

}  // namespace gazed::v4l2
