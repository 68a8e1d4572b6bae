#include "drivers/v4l2/video_system.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace gazed::v4l2 {

namespace {

// With a 64-bit time_t on a 32-bit CPU a buffer has another layout and VIDIOC_DQBUF another number,
// which Linux before 5.6 does not know.
static_assert(sizeof(void*) == 8 || sizeof(v4l2_buffer) == 68);

}  // namespace

VideoSystem kernel_video_system() {
  return {
      .open =
          [](const char* path) { return ::open(path, O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC); },
      .close = [](int descriptor) { return ::close(descriptor); },
      .ioctl = [](int descriptor, unsigned long request,
                  void* argument) { return ::ioctl(descriptor, request, argument); },
      .map = [](std::size_t length, int descriptor, std::int64_t offset) -> void* {
        // For writing too: some drivers map in no other way (V4L2 documentation, mmap()).
        void* start =
            ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, offset);
        return start == MAP_FAILED ? nullptr : start;
      },
      .unmap = [](void* start, std::size_t length) { return ::munmap(start, length); },
      .clocks = drivers::computers_clocks()};
}

}  // namespace gazed::v4l2
