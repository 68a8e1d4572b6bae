// Each call of the kernel's fails once, whichever it is: that is told, and the camera gives its
// frames again.
#include <array>
#include <cerrno>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/jpeg/files.hpp"
#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::failing_calls_test {
namespace {

constexpr int width_px = 160;
constexpr int height_px = 120;
constexpr int frames_wanted = 10;
constexpr double frame_s = 1.0 / 30.0;
// Silence is noticed after 2 s (CameraTiming::timeout_s), and what is lost is opened again within
// 2 s.
constexpr double patience_s = 5.0;
constexpr int none = 0;

/// A kernel whose call number `failing`, from 1, fails with `error`. Closing and unmapping, which
/// leave nothing to be done about, are not counted.
struct Kernel {
  Kernel(int failing_call, int with_error) : failing(failing_call), error(with_error) {}

  [[nodiscard]] VideoSystem system() {
    VideoSystem system = camera.system();
    system.open = [this, plain = system.open](const char* path) {
      return fails() ? -1 : plain(path);
    };
    system.ioctl = [this, plain = system.ioctl](int descriptor, unsigned long request,
                                                void* argument) {
      return fails() ? -1 : plain(descriptor, request, argument);
    };
    system.map = [this, plain = system.map](std::size_t length, int descriptor,
                                            std::int64_t offset) {
      // mmap() is not interrupted (mmap(2)).
      return fails() && error != EINTR ? nullptr : plain(length, descriptor, offset);
    };
    return system;
  }

  bool fails() {
    if (++calls != failing) return false;
    errno = error;
    return true;
  }

  FakeCamera camera;
  int failing, error;
  int calls = 0;
};

struct Outcome {
  int frames = 0;
  int openings = 0;
  int calls = 0;       // of the whole life
  int calls_used = 0;  // before the camera is given back
  std::string told;
};

/// A V6's camera with its controls, and one that gives JPEG.
enum class Kind { yuyv, jpeg };

V4l2Settings settings_for(Kind kind) {
  return {.device = "/dev/video0",
          .width_px = width_px,
          .height_px = height_px,
          .controls = {.auto_exposure = false,
                       .exposure = 300,
                       .gain = 16,
                       .auto_focus = false,
                       .focus = 0,
                       .flip_horizontal = true,
                       .flip_vertical = false},
          .flips_by_extension_unit = kind == Kind::yuyv};
}

void give_controls(FakeCamera& camera) {
  const auto has = [&camera](std::uint32_t id, std::uint32_t type, int maximum) {
    FakeControl& control = camera.controls[id];
    control.query.id = id;
    control.query.type = type;
    control.query.maximum = maximum;
    control.query.step = 1;
  };
  has(V4L2_CID_EXPOSURE_AUTO, V4L2_CTRL_TYPE_MENU, 3);
  camera.controls[V4L2_CID_EXPOSURE_AUTO].menu = {V4L2_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL};
  has(V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CTRL_TYPE_INTEGER, 1048575);
  has(V4L2_CID_AUTOGAIN, V4L2_CTRL_TYPE_BOOLEAN, 1);
  has(V4L2_CID_GAIN, V4L2_CTRL_TYPE_INTEGER, 1023);
  has(V4L2_CID_FOCUS_AUTO, V4L2_CTRL_TYPE_BOOLEAN, 1);
  has(V4L2_CID_FOCUS_ABSOLUTE, V4L2_CTRL_TYPE_INTEGER, 250);
  has(V4L2_CID_HFLIP, V4L2_CTRL_TYPE_BOOLEAN, 1);
  has(V4L2_CID_VFLIP, V4L2_CTRL_TYPE_BOOLEAN, 1);
}

Outcome outcome_of(Kind kind, const jpeg::Bytes& content, int failing, int error) {
  Kernel kernel(failing, error);
  const std::uint32_t four_cc = kind == Kind::jpeg ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_YUYV;
  kernel.camera.formats = {{four_cc, {{width_px, height_px}}}};
  give_controls(kernel.camera);
  Outcome outcome;
  {
    V4l2Camera dut(settings_for(kind), kernel.system());
    for (double t = 0.0; t < patience_s && outcome.frames < frames_wanted; t += frame_s) {
      kernel.camera.pass(frame_s);
      kernel.camera.shoot({.content = content});
      if (dut.next_frame()) ++outcome.frames;
      outcome.told += dut.health().words + dut.warning();
    }
    outcome.calls_used = kernel.calls;
  }
  outcome.calls = kernel.calls;
  outcome.openings = kernel.camera.opened;
  EXPECT_THAT(kernel.camera.misuse, testing::IsEmpty());
  EXPECT_TRUE(kernel.camera.descriptors.empty());
  EXPECT_TRUE(kernel.camera.mappings.empty());
  return outcome;
}

class V4l2FailingCalls : public testing::TestWithParam<Kind> {
 protected:
  jpeg::Bytes content =
      GetParam() == Kind::jpeg ? jpeg::file_of(jpeg::waves(width_px, height_px)) : jpeg::Bytes();
  Outcome whole = outcome_of(GetParam(), content, none, none);
};

TEST_P(V4l2FailingCalls, WithoutAFailureAllIsWell) {
  EXPECT_EQ(whole.frames, frames_wanted) << whole.told;
  EXPECT_EQ(whole.openings, 1);
  EXPECT_GT(whole.calls_used, 3 * frames_wanted);
}

TEST_P(V4l2FailingCalls, EachIsToldAndTheFramesComeAgain) {
  for (int call = 1; call <= whole.calls; ++call) {
    for (const int error : {EIO, ENODEV, EBUSY, ENOMEM, ENOSPC, EINVAL, ENOTTY}) {
      const Outcome failed = outcome_of(GetParam(), content, call, error);
      EXPECT_EQ(failed.frames, frames_wanted) << "call " << call << ", error " << error;
      // So do kernels say that a camera has no such control.
      const bool is_an_answer = error == EINVAL || error == ENOTTY;
      if (call <= whole.calls_used && !is_an_answer) {
        EXPECT_NE(failed.told, whole.told) << "call " << call << ", error " << error;
      }
    }
  }
}

TEST_P(V4l2FailingCalls, ASignalIsNoFailure) {
  for (int call = 1; call <= whole.calls; ++call) {
    const Outcome failed = outcome_of(GetParam(), content, call, EINTR);
    EXPECT_EQ(failed.frames, frames_wanted) << "call " << call;
    EXPECT_EQ(failed.openings, 1) << "call " << call;
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, V4l2FailingCalls, testing::Values(Kind::yuyv, Kind::jpeg),
                         [](const auto& kind) {
                           return kind.param == Kind::jpeg ? "Jpeg" : "Yuyv";
                         });

}  // namespace
}  // namespace gazed::v4l2::failing_calls_test
