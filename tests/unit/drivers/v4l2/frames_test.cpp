// Frames: the newest, whole, from the kernel's own memory, and all others counted.
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::frames_test {
namespace {

class V4l2Frames : public testing::Test {
 protected:
  ~V4l2Frames() override { EXPECT_THAT(kernel.misuse, testing::IsEmpty()); }

  /// The picture that a frame shows.
  static int number(const std::optional<geometry::Frame>& frame) {
    return frame ? frame->image.data[0] : -1;
  }

  void shoot(int pictures) {
    for (int i = 0; i < pictures; ++i) kernel.shoot();
  }

  FakeCamera kernel;
  V4l2Camera dut{{.device = "/dev/video0"}, kernel.system()};
};

TEST_F(V4l2Frames, NothingIsOpenedBeforeTheFirstCall) {
  EXPECT_EQ(dut.descriptor(), -1);
  EXPECT_EQ(kernel.opened, 0);
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(kernel.path, "/dev/video0");
  EXPECT_TRUE(kernel.descriptors.contains(dut.descriptor()));
  EXPECT_EQ(kernel.queued(), 4U);
  EXPECT_EQ(dut.health().words, "");
  EXPECT_TRUE(dut.health().ok());
}

TEST_F(V4l2Frames, AFrameIsTheKernelsOwnMemory) {
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  const auto frame = dut.next_frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->image.width_px, 640);
  EXPECT_EQ(frame->image.height_px, 480);
  EXPECT_EQ(frame->image.row_stride, 1280);
  EXPECT_EQ(frame->image.format, base::PixelFormat::yuyv);
  EXPECT_EQ(frame->image.data, kernel.mapped(0));
}

TEST_F(V4l2Frames, TheFirstOnesOfAStreamAreDropped) {
  V4l2Camera camera({.device = "/dev/video0", .first_frames_dropped = 3}, kernel.system());
  EXPECT_FALSE(camera.next_frame());
  for (int i = 0; i < 3; ++i) {
    shoot(1);
    EXPECT_FALSE(camera.next_frame()) << i;
  }
  shoot(2);
  EXPECT_TRUE(camera.next_frame());
}

TEST_F(V4l2Frames, RowsMayBePadded) {
  kernel.row_padding = 64;
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  EXPECT_EQ(dut.next_frame()->image.row_stride, 1344);
}

TEST_F(V4l2Frames, ADriverThatDoesNotTellTheStrideHasUnpaddedRows) {
  kernel.lie = [](unsigned long request, void* argument) {
    if (request == VIDIOC_S_FMT) static_cast<v4l2_format*>(argument)->fmt.pix.bytesperline = 0;
  };
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  EXPECT_EQ(dut.next_frame()->image.row_stride, 1280);
}

TEST_F(V4l2Frames, AFrameIsGivenOnce) {
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  EXPECT_TRUE(dut.next_frame());
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(dut.health().dropped, 0);
}

TEST_F(V4l2Frames, DrainedToTheNewestAndTheOthersCounted) {
  EXPECT_FALSE(dut.next_frame());
  shoot(3);
  EXPECT_EQ(number(dut.next_frame()), 2);
  EXPECT_EQ(dut.health().dropped, 2);
  // The one that is looked at is held, all others are queued again.
  EXPECT_EQ(kernel.filled(), 0U);
  EXPECT_EQ(kernel.queued(), 3U);
  EXPECT_FALSE(kernel.is_queued(2));
}

TEST_F(V4l2Frames, TheFrameLookedAtIsNotFilledAgainBeforeTheNextCall) {
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  const auto first = dut.next_frame();
  shoot(10);  // more than there are buffers
  EXPECT_EQ(number(first), 0);
  EXPECT_EQ(number(dut.next_frame()), 3);  // the last that there was a buffer for
  EXPECT_EQ(dut.health().dropped, 2);
  shoot(1);
  EXPECT_EQ(number(dut.next_frame()), 11);
  EXPECT_EQ(dut.health().dropped, 9);  // ... and seven that there was none for
}

TEST_F(V4l2Frames, AFastCameraDoesNotKeepTheLoop) {
  EXPECT_FALSE(dut.next_frame());
  // A picture more whenever one is taken.
  kernel.lie = [this](unsigned long request, void*) {
    if (request == VIDIOC_QBUF) kernel.shoot();
  };
  shoot(4);
  EXPECT_TRUE(dut.next_frame());
  EXPECT_TRUE(dut.next_frame());
}

TEST_F(V4l2Frames, NumbersThatAreLeftOutAreCounted) {
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  EXPECT_TRUE(dut.next_frame());
  kernel.sequence += 3;
  shoot(1);
  EXPECT_TRUE(dut.next_frame());
  EXPECT_EQ(dut.health().dropped, 3);
}

TEST_F(V4l2Frames, GapsAreCountedOverTheWrapOfTheNumber) {
  kernel.sequence = 0xFFFFFFFE;
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  EXPECT_TRUE(dut.next_frame());
  kernel.sequence = 2;  // without 0xFFFFFFFF, 0 and 1
  shoot(1);
  EXPECT_TRUE(dut.next_frame());
  EXPECT_EQ(dut.health().dropped, 3);
}

TEST_F(V4l2Frames, NumbersThatStandStillOrGoBackLeaveNoneOut) {
  EXPECT_FALSE(dut.next_frame());
  for (const std::uint32_t sequence : {5U, 5U, 0U, 1U}) {
    kernel.sequence = sequence;
    shoot(1);
    EXPECT_TRUE(dut.next_frame());
  }
  EXPECT_EQ(dut.health().dropped, 0);
}

TEST_F(V4l2Frames, ADamagedBufferIsDroppedAndCounted) {
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  kernel.shoot({.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR});
  EXPECT_EQ(number(dut.next_frame()), 0);  // the one before it is the newest that is whole
  EXPECT_EQ(dut.health().dropped, 1);
  EXPECT_EQ(kernel.queued(), 3U);
  kernel.shoot({.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR});
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(dut.health().dropped, 2);
  EXPECT_THAT(dut.notes(), testing::HasSubstr("2 frames damaged"));
}

TEST_F(V4l2Frames, ABufferThatIsTooShortIsDroppedAndCounted) {
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot({.missing_bytes = 1});
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(dut.health().dropped, 1);
  EXPECT_EQ(kernel.queued(), 4U);
  EXPECT_THAT(dut.notes(), testing::HasSubstr("1 too short"));
}

TEST_F(V4l2Frames, ThePaddingOfTheLastRowMayBeMissing) {
  kernel.row_padding = 64;
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot({.missing_bytes = 64});
  EXPECT_TRUE(dut.next_frame());
}

TEST_F(V4l2Frames, ASignalBetweenIsNoError) {
  EXPECT_FALSE(dut.next_frame());
  shoot(1);
  kernel.errors[VIDIOC_DQBUF] = {EINTR, EINTR};
  EXPECT_TRUE(dut.next_frame());
  kernel.errors[VIDIOC_QBUF] = {EINTR};
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(dut.health().words, "");
}

TEST_F(V4l2Frames, TheTimeIsTheStampWithTheDelay) {
  V4l2Camera delayed{{.device = "/dev/video1", .timing = {.delay_s = -0.031}}, kernel.system()};
  EXPECT_FALSE(delayed.next_frame());
  kernel.shoot({.age_us = 5'000});
  EXPECT_EQ(delayed.next_frame()->utime_us, kernel.realtime_us - 5'000 - 31'000);
}

TEST_F(V4l2Frames, AStepOfTheWallClockMovesWhatComesAfterIt) {
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot({.age_us = 5'000});
  EXPECT_EQ(dut.next_frame()->utime_us, kernel.realtime_us - 5'000);
  // Set right after the picture was taken: its monotonic stamp is of no time in particular.
  kernel.shoot({.age_us = 5'000});
  kernel.realtime_us += 3'600'000'000;
  EXPECT_EQ(dut.next_frame()->utime_us, kernel.realtime_us - 5'000);
}

TEST_F(V4l2Frames, StampsOfNoClockCountFromNowAndAreTold) {
  EXPECT_FALSE(dut.next_frame());
  for (int i = 0; i < 2; ++i) {
    kernel.shoot({.flags = V4L2_BUF_FLAG_TIMESTAMP_COPY});
    EXPECT_EQ(dut.next_frame()->utime_us, kernel.realtime_us);
  }
  EXPECT_THAT(dut.warning(), testing::HasSubstr("time stamps are by no clock of this computer"));
  EXPECT_EQ(dut.warning(), "");
}

TEST_F(V4l2Frames, FramesOfOneStampCountFromNowWhichIsTold) {
  EXPECT_FALSE(dut.next_frame());
  std::int64_t utime_us = 0;
  for (int i = 0; i < 20; ++i) {
    // As old as the first one is by now: one stamp.
    kernel.shoot({.age_us = 5'000 + 33'000 * i});
    utime_us = dut.next_frame()->utime_us;
    EXPECT_EQ(utime_us, i < 8 ? kernel.realtime_us - 5'000 - 33'000 * i : kernel.realtime_us) << i;
    kernel.realtime_us += 33'000;
    kernel.monotonic_us += 33'000;
  }
  EXPECT_THAT(dut.warning(), testing::HasSubstr("gives every frame the same time stamp"));
  EXPECT_EQ(dut.warning(), "");
}

TEST_F(V4l2Frames, StampsOfTheEndAreToldWhenTheDelayDoesNotKnow) {
  for (const double delay_s : {0.002, -0.034}) {
    V4l2Camera camera{{.device = "/dev/video1", .timing = {.readout_s = 0.037, .delay_s = delay_s}},
                      kernel.system()};
    EXPECT_FALSE(camera.next_frame());
    kernel.shoot({.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_EOF});
    EXPECT_TRUE(camera.next_frame());
    const std::string warning = camera.warning();
    EXPECT_EQ(warning.find("the end of a frame") != std::string::npos, delay_s > 0.0) << warning;
  }
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot();  // of the start of exposure
  EXPECT_TRUE(dut.next_frame());
  EXPECT_EQ(dut.warning(), "");
}

}  // namespace
}  // namespace gazed::v4l2::frames_test
