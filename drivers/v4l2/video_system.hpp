// The system calls of the V4L2 driver, in one place, so that a test can play the kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "drivers/clocks.hpp"

namespace gazed::v4l2 {

/// As the calls of these names: where one fails it says so and leaves errno.
struct VideoSystem {
  std::function<int(const char* path)> open;  // for reading and writing, never waiting; -1
  std::function<int(int descriptor)> close;
  std::function<int(int descriptor, unsigned long request, void* argument)> ioctl;    // -1
  std::function<void*(std::size_t length, int descriptor, std::int64_t offset)> map;  // nullptr
  std::function<int(void* start, std::size_t length)> unmap;
  drivers::Clocks clocks;
};

/// Those of the kernel that runs.
[[nodiscard]] VideoSystem kernel_video_system();

}  // namespace gazed::v4l2
