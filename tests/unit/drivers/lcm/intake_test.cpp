#include "drivers/lcm/intake.hpp"

#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>

#include "drivers/jpeg/encoder.hpp"

#include "messages.hpp"

namespace gazed::lcm::intake_test {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t hour_us = 3'600'000'000;

TEST(GapCounter, SteadyFramesHaveNone) {
  GapCounter gaps;
  for (int i = 0; i < 100; ++i) gaps.saw(start_us + i * frame_us + (i % 3) * 4000);  // jitter
  EXPECT_EQ(gaps.missing(), 0);
}

TEST(GapCounter, CountsWhatIsMissing) {
  GapCounter gaps;
  for (const int i : {0, 1, 2, 3, 4, 6, 7, 11, 12}) gaps.saw(start_us + i * frame_us);
  EXPECT_EQ(gaps.missing(), 1 + 3);
}

TEST(GapCounter, APauseIsNotAThousandFrames) {
  GapCounter gaps;
  for (int i = 0; i < 10; ++i) gaps.saw(start_us + i * frame_us);
  gaps.saw(start_us + hour_us);
  EXPECT_EQ(gaps.missing(), 1);
}

TEST(GapCounter, FollowsAnotherRate) {
  GapCounter gaps;
  for (int i = 0; i < 10; ++i) gaps.saw(start_us + i * frame_us);
  const std::int64_t slow_start = start_us + 9 * frame_us;
  for (int i = 1; i < 50; ++i) gaps.saw(slow_start + i * 3 * frame_us);
  EXPECT_EQ(gaps.missing(), 5 * 2) << "five intervals until the median is the new one";
}

TEST(FrameIntake, KeepsTheNewestAndCountsTheOthers) {
  FrameIntake intake("GAZED_IMAGE", 8, 4);
  EXPECT_FALSE(intake.next_frame());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(intake.take(
        encoded(image_message(8, 4, base::PixelFormat::yuyv, start_us + i * frame_us))));
  }
  const auto frame = intake.next_frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->utime_us, start_us + 2 * frame_us);
  EXPECT_EQ(intake.frames_dropped(), 2);
  EXPECT_FALSE(intake.next_frame());
}

TEST(FrameIntake, AFrameStaysWhileTheNextOnesCome) {
  FrameIntake intake("GAZED_IMAGE", 8, 4);
  intake.take(encoded(image_message(8, 4, base::PixelFormat::grey)));
  const auto frame = intake.next_frame();
  ASSERT_TRUE(frame);
  for (int i = 1; i < 4; ++i) {
    auto other = image_message(8, 4, base::PixelFormat::grey, start_us + i * frame_us);
    std::ranges::fill(other.data, 0xEE);
    EXPECT_TRUE(intake.take(encoded(other)));
  }
  const base::Image expected = test_image(8, 4, base::PixelFormat::grey);
  EXPECT_TRUE(same_pixels(frame->image, expected.view()));
}

TEST(FrameIntake, AllocatesNothingAfterTheFirst) {
  FrameIntake intake("GAZED_IMAGE", 8, 4);
  const std::uint8_t* first = nullptr;
  const std::uint8_t* second = nullptr;
  for (int i = 0; i < 10; ++i) {
    const auto format = i % 2 == 0 ? base::PixelFormat::rgb24 : base::PixelFormat::grey;
    intake.take(encoded(image_message(8, 4, format, start_us + i * frame_us)));
    const auto frame = intake.next_frame();
    ASSERT_TRUE(frame);
    if (i == 0) first = frame->image.data;
    if (i == 1) second = frame->image.data;
    EXPECT_EQ(frame->image.data, i % 2 == 0 ? first : second);
  }
}

TEST(FrameIntake, BgrAndUyvyBecomeWhatTheyMean) {
  for (const auto format : {base::PixelFormat::rgb24, base::PixelFormat::yuyv}) {
    const bool rgb = format == base::PixelFormat::rgb24;
    auto message = image_message(8, 4, format);
    // The same picture as the other format has it.
    const std::size_t step = rgb ? 3 : 2, other = rgb ? 2 : 1;
    for (std::size_t i = 0; i < message.data.size(); i += step) {
      std::swap(message.data[i], message.data[i + other]);
    }
    message.pixelformat = rgb ? 861030210 : 1498831189;
    FrameIntake intake("GAZED_IMAGE", 8, 4);
    ASSERT_TRUE(intake.take(encoded(message))) << intake.refusals().text();
    EXPECT_TRUE(same_pixels(intake.next_frame()->image, test_image(8, 4, format).view())) << rgb;
  }
}

bot_core::image_t jpeg_message(const base::Image& image, std::int64_t utime_us) {
  jpeg::Encoder encoder(95);
  bot_core::image_t message;
  to_message(geometry::Frame{image.view(), utime_us}, encoder.encode(image.view()), message);
  return message;
}

TEST(FrameIntake, JpegBecomesPixels) {
  base::Image red(32, 16, base::PixelFormat::rgb24);
  for (std::size_t i = 0; i < red.pixels().size(); i += 3) red.pixels()[i] = 200;
  FrameIntake intake("GAZED_IMAGE", 32, 16);
  ASSERT_TRUE(intake.take(encoded(jpeg_message(red, start_us)))) << intake.refusals().text();
  const auto frame = intake.next_frame();
  ASSERT_EQ(frame->image.format, base::PixelFormat::rgb24);
  constexpr int tolerance = 3;  // both directions round
  EXPECT_NEAR(frame->image.row(8)[3 * 16], 200, tolerance);
  EXPECT_NEAR(frame->image.row(8)[3 * 16 + 1], 0, tolerance);
  EXPECT_NEAR(frame->image.row(8)[3 * 16 + 2], 0, tolerance);
}

TEST(FrameIntake, ADamagedJpegIsRefusedAndTheFrameBeforeStays) {
  base::Image dark(32, 16, base::PixelFormat::grey), bright(32, 16, base::PixelFormat::grey);
  std::ranges::fill(dark.pixels(), std::uint8_t{40});
  std::ranges::fill(bright.pixels(), std::uint8_t{200});
  FrameIntake intake("GAZED_IMAGE", 32, 16);
  ASSERT_TRUE(intake.take(encoded(jpeg_message(dark, start_us))));
  auto damaged = jpeg_message(bright, start_us + frame_us);
  damaged.data.resize(damaged.data.size() - 8);
  damaged.size = static_cast<std::int32_t>(damaged.data.size());
  EXPECT_FALSE(intake.take(encoded(damaged)));
  EXPECT_THAT(intake.refusals().text(), HasSubstr("JPEG"));
  const auto frame = intake.next_frame();
  EXPECT_EQ(frame->utime_us, start_us);
  EXPECT_NEAR(frame->image.row(0)[0], 40, 1);
}

TEST(FrameIntake, AJpegOfAnotherSizeThanItsMessageIsRefused) {
  auto message = jpeg_message(test_image(32, 16, base::PixelFormat::grey), start_us);
  message.width = 64;
  FrameIntake intake("GAZED_IMAGE", 64, 16);
  EXPECT_FALSE(intake.take(encoded(message)));
  EXPECT_THAT(intake.refusals().text(),
              HasSubstr("a JPEG of 32x16 pixels where the frame has 64x16"));
}

TEST(FrameIntake, MessagesOfOneStampCountFromTheirArrival) {
  FrameIntake intake("GAZED_IMAGE", 8, 4);
  std::string warning;
  std::int64_t arrived_us = start_us;
  for (int i = 0; i < 30; ++i) {
    intake.take(encoded(image_message(8, 4, base::PixelFormat::grey, 0)), arrived_us += frame_us);
    if (warning.empty()) warning = intake.warning();
  }
  ASSERT_TRUE(intake.next_frame());
  EXPECT_EQ(intake.waiting_utime_us(), std::nullopt);
  EXPECT_THAT(warning, HasSubstr("every message has the same utime"));
  EXPECT_EQ(intake.warning(), "");
  intake.take(encoded(image_message(8, 4, base::PixelFormat::grey, 0)), arrived_us += frame_us);
  EXPECT_EQ(intake.next_frame()->utime_us, arrived_us);
}

TEST(FrameIntake, StampsOfWholeSecondsCountFromTheirArrivalUntilTheyGoOn) {
  constexpr std::int64_t second_us = 1'000'000;
  FrameIntake intake("GAZED_IMAGE", 8, 4);
  const auto time_of = [&](std::int64_t stamp_us, std::int64_t arrived_us) {
    intake.take(encoded(image_message(8, 4, base::PixelFormat::grey, stamp_us)), arrived_us);
    const auto frame = intake.next_frame();
    return frame ? frame->utime_us : -1;
  };
  std::int64_t arrived_us = start_us;
  for (int i = 0; i < 100; ++i) {
    arrived_us += frame_us;
    const std::int64_t time_us = time_of(arrived_us / second_us * second_us, arrived_us);
    if (i >= 40) {  // within two seconds they are seen through
      EXPECT_EQ(time_us, arrived_us) << i;
    }
  }
  std::int64_t time_us = 0;
  for (int i = 0; i < 20; ++i) {
    arrived_us += frame_us;
    time_us = time_of(arrived_us - 1000, arrived_us);
  }
  EXPECT_EQ(time_us, arrived_us - 1000) << "now each has its own";
}

TEST(HeadStateIntake, DoubledMessagesKeepTheirStamps) {
  HeadStateIntake intake("GAZED_HEAD_STATE");
  for (int i = 0; i < 20; ++i) {
    for (int twice = 0; twice < 2; ++twice) {
      intake.take(encoded(head_message(0, 0, start_us + i)), 2 * start_us);
    }
  }
  EXPECT_EQ(intake.newest()->utime_us, start_us + 19);
  EXPECT_EQ(intake.warning(), "");
}

TEST(FrameIntake, AnotherSizeIsRefusedWithBoth) {
  FrameIntake intake("GAZED_IMAGE", 640, 480);
  EXPECT_FALSE(intake.take(encoded(image_message(320, 240, base::PixelFormat::yuyv))));
  EXPECT_THAT(intake.refusals().text(),
              HasSubstr("an image of 320x240 pixels where 640x480 is configured"));
  EXPECT_FALSE(intake.next_frame());
}

TEST(FrameIntake, RefusalsAreCountedAndTold) {
  FrameIntake intake("GAZED_IMAGE", 8, 4);
  EXPECT_EQ(intake.refusals().text(), "");
  EXPECT_TRUE(intake.take(encoded(image_message(8, 4, base::PixelFormat::yuyv, start_us))));
  EXPECT_FALSE(intake.take(encoded(image_message(8, 4, base::PixelFormat::yuyv, start_us - 1))));
  EXPECT_FALSE(intake.take({}));
  EXPECT_EQ(intake.refusals().count(), 2);
  EXPECT_TRUE(intake.refusals().last_was_refused());
  EXPECT_EQ(intake.refusals().text(),
            "GAZED_IMAGE: 2 messages refused, the last: too short to be a bot_core.image_t");
  EXPECT_TRUE(intake.take(encoded(image_message(8, 4, base::PixelFormat::yuyv, start_us + 1))));
  EXPECT_FALSE(intake.refusals().last_was_refused());
}

TEST(HeadStateIntake, GivesTheStatesInOrder) {
  HeadStateIntake intake("GAZED_HEAD_STATE");
  EXPECT_FALSE(intake.next_state());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(intake.take(encoded(head_message(0.1 * i, 0, start_us + i))));
  }
  EXPECT_EQ(intake.waiting_utime_us(), start_us);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(intake.next_state()->measured.yaw_rad, 0.1 * i);
  EXPECT_FALSE(intake.next_state());
  EXPECT_EQ(intake.newest()->utime_us, start_us + 2);
}

TEST(HeadStateIntake, KeepsTheNewestWhenNobodyAsks) {
  HeadStateIntake intake("GAZED_HEAD_STATE");
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(intake.take(encoded(head_message(0, 0, start_us + i))));
  }
  int states = 0;
  std::int64_t next_us = start_us + 1000 - 256;
  while (const auto state = intake.next_state()) {
    EXPECT_EQ(state->utime_us, next_us++);
    ++states;
  }
  EXPECT_EQ(states, 256);
}

}  // namespace
}  // namespace gazed::lcm::intake_test
