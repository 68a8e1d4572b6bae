// Kernels that answer anything: whatever a device does, the driver goes on, leaks nothing and hands
// out nothing but whole frames.
#include <array>
#include <cerrno>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <sys/ioctl.h>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/jpeg/files.hpp"
#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::random_test {
namespace {

constexpr int width_px = 160;
constexpr int height_px = 120;

class RandomKernel {
 public:
  explicit RandomKernel(std::uint64_t seed) : random_(seed) {
    camera.formats = {{V4L2_PIX_FMT_YUYV, {{width_px, height_px}}}};
    // From one in four calls to one in 256.
    error_odds_ = 4U << one_of(7);
    lie_odds_ = 4U << one_of(7);
    if (one_of(3) == 0) {
      jpeg_ = jpeg::file_of(jpeg::waves(width_px, height_px));
      camera.formats.front().four_cc = V4L2_PIX_FMT_MJPEG;
    }
    camera.lie = [this](unsigned long request, void* argument) { lie(request, argument); };
  }

  [[nodiscard]] VideoSystem system() {
    VideoSystem system = camera.system();
    system.open = [this, plain = system.open](const char* path) {
      if (!fails()) return plain(path);
      errno = any_error();
      return -1;
    };
    system.ioctl = [this, plain = system.ioctl](int descriptor, unsigned long request,
                                                void* argument) {
      if (!fails()) return plain(descriptor, request, argument);
      errno = any_error();
      return -1;
    };
    system.map = [this, plain = system.map](std::size_t length, int descriptor,
                                            std::int64_t offset) -> void* {
      if (!fails()) return plain(length, descriptor, offset);
      errno = ENOMEM;
      return nullptr;
    };
    return system;
  }

  [[nodiscard]] std::uint64_t one_of(std::uint64_t count) { return random_() % count; }

  /// Something happens to the camera.
  void live() {
    switch (one_of(8)) {
      case 0:
        camera.present = one_of(4) != 0;
        break;
      case 1:
        camera.sequence = static_cast<std::uint32_t>(random_());
        break;
      case 2:
        camera.pass(static_cast<double>(one_of(3000)) * 1e-3);
        break;
      case 3:
        camera.realtime_us += static_cast<std::int64_t>(random_() >> 20) - (1LL << 43);
        break;
      default:
        camera.pass(0.033);
    }
    for (std::uint64_t pictures = one_of(4); pictures > 0; --pictures) {
      camera.shoot({.flags = one_of(2) == 0 ? static_cast<std::uint32_t>(random_())
                                            : V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC,
                    .content = perhaps_damaged()});
    }
  }

  FakeCamera camera;

 private:
  [[nodiscard]] jpeg::Bytes perhaps_damaged() {
    jpeg::Bytes file = jpeg_;
    if (!file.empty() && one_of(2) == 0)
      file[one_of(file.size())] = static_cast<std::uint8_t>(random_());
    return file;
  }

  [[nodiscard]] bool fails() { return one_of(error_odds_) == 0; }

  [[nodiscard]] int any_error() {
    constexpr std::array errors{EAGAIN, EINTR,  EIO,    ENODEV, EINVAL, EBUSY,
                                ENOMEM, ENOSPC, ENOTTY, EPERM,  ERANGE, EPIPE};
    return errors[one_of(errors.size())];
  }

  /// Overwrites a part of an answer that says how much or how many, by little or by anything.
  void lie(unsigned long request, void* argument) {
    if (one_of(lie_odds_) != 0) return;
    const std::size_t words = _IOC_SIZE(request) / sizeof(std::uint32_t);
    if (words == 0) return;
    auto* numbers = static_cast<std::uint32_t*>(argument);
    std::uint32_t& number = numbers[one_of(words)];
    switch (one_of(4)) {
      case 0:
        number = static_cast<std::uint32_t>(random_());
        break;
      case 1:
        number = static_cast<std::uint32_t>(one_of(64));
        break;
      case 2:
        number += static_cast<std::uint32_t>(one_of(5)) - 2;
        break;
      default:
        number = std::numeric_limits<std::uint32_t>::max();
    }
  }

  std::mt19937_64 random_;
  jpeg::Bytes jpeg_;  // empty: the camera gives YUYV
  std::uint64_t error_odds_, lie_odds_;
};

/// The last byte of the frame's pixels lies in memory that is mapped.
bool is_mapped(const FakeCamera& camera, const base::ImageView& image) {
  for (const auto& [start, memory] : camera.mappings) {
    if (start != image.data) continue;
    const auto bytes = static_cast<std::size_t>(image.row_stride) * (height_px - 1) + 2 * width_px;
    return bytes <= memory->size();
  }
  return false;
}

void play(std::uint64_t seed, std::int64_t& frames, std::int64_t& openings) {
  RandomKernel kernel(seed);
  {
    V4l2Camera dut{{.device = "/dev/video0",
                    .width_px = width_px,
                    .height_px = height_px,
                    .timing = {.readout_s = 0.037, .delay_s = 0.002},
                    .controls = {.auto_exposure = false, .exposure = 3, .flip_vertical = true},
                    .flips_by_extension_unit = seed % 2 == 0},
                   kernel.system()};
    for (int i = 0; i < 60; ++i) {
      kernel.live();
      const std::int64_t dropped = dut.health().dropped;
      const auto frame = dut.next_frame();
      EXPECT_GE(dut.health().dropped, dropped);
      EXPECT_EQ(dut.descriptor() >= 0, !kernel.camera.descriptors.empty());
      EXPECT_TRUE(dut.descriptor() >= 0 || !dut.health().words.empty());
      if (!frame) continue;
      ++frames;
      EXPECT_EQ(frame->image.width_px, width_px);
      EXPECT_EQ(frame->image.height_px, height_px);
      EXPECT_GE(frame->image.row_stride, 2 * width_px);
      const bool yuyv = frame->image.format == base::PixelFormat::yuyv;
      ASSERT_EQ(is_mapped(kernel.camera, frame->image), yuyv);
      EXPECT_EQ(dut.health().words, "");
      static_cast<void>(dut.warning());
      static_cast<void>(dut.notes());
    }
  }
  openings += kernel.camera.opened;
  EXPECT_TRUE(kernel.camera.descriptors.empty());
  EXPECT_TRUE(kernel.camera.mappings.empty());
}

TEST(V4l2Random, WhateverTheKernelAnswers) {
  std::int64_t frames = 0, openings = 0;
  for (std::uint64_t seed = 0; seed < GAZED_RANDOM_KERNELS && !testing::Test::HasFailure();
       ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    play(seed, frames, openings);
  }
  // The odds are such that the camera works now and then.
  EXPECT_GT(frames, GAZED_RANDOM_KERNELS);
  EXPECT_GT(openings, GAZED_RANDOM_KERNELS);
}

}  // namespace
}  // namespace gazed::v4l2::random_test
