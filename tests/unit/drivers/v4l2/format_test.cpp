// Devices that are no camera, and cameras that do not give what is asked for.
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::format_test {
namespace {

using ::testing::HasSubstr;

class V4l2Format : public testing::Test {
 protected:
  ~V4l2Format() override { EXPECT_THAT(kernel.misuse, testing::IsEmpty()); }

  /// What is said of the camera when it cannot be used; empty when it can.
  std::string fault() {
    V4l2Camera dut{settings, kernel.system()};
    EXPECT_FALSE(dut.next_frame());
    warning = dut.warning();
    EXPECT_EQ(kernel.descriptors.empty(), !dut.health().words.empty());
    return dut.health().words;
  }

  V4l2Settings settings{.device = "/dev/video0"};
  FakeCamera kernel;
  std::string warning;
};

TEST_F(V4l2Format, NoPermissionSaysWhatToDo) {
  kernel.open_error = EACCES;
  EXPECT_EQ(fault(),
            "/dev/video0: no permission; add the user to the group video (usermod -aG "
            "video USER) and log in again");
}

TEST_F(V4l2Format, ADirectoryIsNamed) {
  kernel.open_error = EISDIR;
  EXPECT_EQ(fault(), "/dev/video0: a directory, not a video device");
}

TEST_F(V4l2Format, WhatKnowsNoV4l2IsNoVideoDevice) {
  for (const int error : {ENOTTY, EINVAL}) {
    kernel.errors[VIDIOC_QUERYCAP] = {error};
    EXPECT_EQ(fault(), "/dev/video0: not a video device");
  }
}

TEST_F(V4l2Format, ANodeWithoutCaptureIsNamed) {
  // The second node of a USB camera: the device captures, this node has metadata.
  kernel.capability.capabilities |= V4L2_CAP_DEVICE_CAPS | V4L2_CAP_META_CAPTURE;
  kernel.capability.device_caps = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_EQ(fault(),
            "/dev/video0: this node of \"Fake camera\" (driver fake) does not capture "
            "video (capabilities 0x04800000); another /dev/video* may");
}

TEST_F(V4l2Format, AnOldKernelTellsNoNodesApart) {
  kernel.capability.device_caps = 0;
  EXPECT_EQ(fault(), "");
}

TEST_F(V4l2Format, ADeviceThatDoesNotStreamIsNamed) {
  kernel.capability.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE;
  EXPECT_THAT(fault(), HasSubstr("\"Fake camera\" (driver fake) does not stream into memory"));
}

TEST_F(V4l2Format, NamesOfDriversNeedNotEnd) {
  kernel.capability.capabilities = 0;
  std::memset(kernel.capability.card, 'x', sizeof kernel.capability.card);
  std::memset(kernel.capability.driver, '\n', sizeof kernel.capability.driver);
  EXPECT_THAT(fault(),
              HasSubstr("\"" + std::string(32, 'x') + "\" (driver " + std::string(16, '?') + ")"));
}

TEST_F(V4l2Format, WhatIsNoCameraIsClosedAgain) {
  kernel.capability.capabilities = 0;
  const VideoSystem system = kernel.system();
  VideoDevice dut(system);
  EXPECT_NE(dut.open("/dev/video0"), "");
  EXPECT_EQ(dut.descriptor(), -1);
  EXPECT_TRUE(kernel.descriptors.empty());
}

TEST_F(V4l2Format, AnotherProgramsCameraIsNamed) {
  for (const unsigned long request : {VIDIOC_S_FMT, VIDIOC_REQBUFS, VIDIOC_STREAMON}) {
    kernel.errors[request] = {EBUSY};
    EXPECT_THAT(fault(), HasSubstr("another program uses the camera"));
  }
}

TEST_F(V4l2Format, OnlyH264ListsWhatThereIs) {
  kernel.formats = {{V4L2_PIX_FMT_H264, {{1920, 1080}}}, {V4L2_PIX_FMT_MJPEG, {{1280, 720}}}};
  EXPECT_EQ(fault(),
            "/dev/video0: YUYV or MJPG 640x480 was asked for, the camera gives H264 1920x1080; it "
            "offers H264 1920x1080; MJPG 1280x720");
}

TEST_F(V4l2Format, JpegIsTakenWhereThereIsNoYuyvOfTheSize) {
  kernel.formats = {{V4L2_PIX_FMT_MJPEG, {{640, 480}, {1280, 720}}},
                    {V4L2_PIX_FMT_YUYV, {{320, 240}}}};
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(warning, "/dev/video0: no YUYV of 640x480: its JPEG frames (MJPG) are decoded");
  kernel.errors[VIDIOC_S_FMT] = {EINVAL};
  EXPECT_EQ(fault(), "");
}

TEST_F(V4l2Format, AnotherSizeListsWhatThereIs) {
  settings.width_px = 1280;
  settings.height_px = 960;
  EXPECT_EQ(fault(),
            "/dev/video0: YUYV or MJPG 1280x960 was asked for, the camera gives YUYV 640x480; it "
            "offers YUYV 640x480, 320x240");
}

TEST_F(V4l2Format, AFormatThatIsRefusedListsWhatThereIs) {
  kernel.errors[VIDIOC_S_FMT] = {EINVAL};
  EXPECT_EQ(fault(),
            "/dev/video0: YUYV or MJPG 640x480 was asked for: Invalid argument; the camera "
            "offers YUYV 640x480, 320x240");
}

TEST_F(V4l2Format, SizesMayBeARange) {
  settings.width_px = 1280;
  settings.height_px = 960;
  kernel.lie = [](unsigned long request, void* argument) {
    if (request != VIDIOC_ENUM_FRAMESIZES) return;
    auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
    size.type = V4L2_FRMSIZE_TYPE_STEPWISE;
    size.stepwise = {16, 1920, 8, 16, 1080, 8};
  };
  EXPECT_THAT(fault(), HasSubstr("it offers YUYV 16x16 to 1920x1080"));
}

TEST_F(V4l2Format, AListWithoutEndEnds) {
  settings.width_px = 1280;
  settings.height_px = 960;
  kernel.formats.assign(1000, kernel.formats.front());
  kernel.formats.front().sizes.assign(1000, {640, 480});
  EXPECT_LT(fault().size(), 10'000U);
}

TEST_F(V4l2Format, HalfFramesAreRefused) {
  for (const std::uint32_t field : {V4L2_FIELD_TOP, V4L2_FIELD_ALTERNATE, V4L2_FIELD_SEQ_TB}) {
    kernel.field = field;
    EXPECT_THAT(fault(), HasSubstr("half frames"));
  }
  kernel.field = V4L2_FIELD_INTERLACED;
  EXPECT_EQ(fault(), "");
}

TEST_F(V4l2Format, RowsThatAreTooShortAreRefused) {
  kernel.lie = [](unsigned long request, void* argument) {
    if (request == VIDIOC_S_FMT) static_cast<v4l2_format*>(argument)->fmt.pix.bytesperline = 640;
  };
  EXPECT_EQ(fault(), "/dev/video0: the camera gives rows of 640 bytes; 640 pixels need 1280");
}

TEST_F(V4l2Format, BuffersThatAreTooSmallAreRefused) {
  kernel.lie = [](unsigned long request, void* argument) {
    if (request == VIDIOC_QUERYBUF) static_cast<v4l2_buffer*>(argument)->length = 4096;
  };
  EXPECT_EQ(fault(),
            "/dev/video0: the camera's driver gives buffers of 4096 bytes, 614400 are needed");
}

TEST_F(V4l2Format, FewerThanThreeBuffersAreRefused) {
  for (const std::uint32_t buffers : {0U, 1U, 2U}) {
    kernel.buffers_given = buffers;
    EXPECT_EQ(fault(), "/dev/video0: the camera's driver gives " + std::to_string(buffers) +
                           " buffers, 3 to 32 are needed");
  }
  for (const std::uint32_t buffers : {3U, 32U}) {
    kernel.buffers_given = buffers;
    EXPECT_EQ(fault(), "");
  }
}

TEST_F(V4l2Format, ThirtyFramesASecondAreAskedForAndOthersTold) {
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(warning, "");
  kernel.interval = {1001, 30000};
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(warning, "");
  kernel.interval = {2, 15};
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(warning, "/dev/video0: it gives 7.5 frames a second; 30 were asked for");
  kernel.interval = {0, 0};
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(warning, "/dev/video0: its frame rate cannot be set");
}

// The kernel that runs, on what any computer has.
TEST(V4l2Kernel, FilesFoldersAndOtherDevicesAreNoCameras) {
  const auto fault_of = [](const std::string& path) {
    V4l2Camera dut{{.device = path}};
    EXPECT_FALSE(dut.next_frame());
    EXPECT_EQ(dut.descriptor(), -1);
    return dut.health().words;
  };
  const std::string folder = testing::TempDir();
  const std::string file = folder + "/no_camera";
  std::ofstream(file) << "no camera";
  EXPECT_EQ(fault_of(folder), folder + ": a directory, not a video device");
  EXPECT_EQ(fault_of(file), file + ": not a video device");
  EXPECT_EQ(fault_of("/dev/null"), "/dev/null: not a video device");
  EXPECT_THAT(fault_of(folder + "/nothing_here"), HasSubstr("no such device"));
  EXPECT_TRUE(std::filesystem::remove(file));
}

}  // namespace
}  // namespace gazed::v4l2::format_test
