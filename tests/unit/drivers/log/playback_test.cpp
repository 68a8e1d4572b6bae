// What LogWriter wrote, played by LogCamera and LogHead; and logs that others wrote, badly.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/lcm/big_endian.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"
#include "drivers/log/log_writer.hpp"

#include "log_files.hpp"
#include "tests/unit/drivers/lcm/messages.hpp"

namespace gazed::log::playback_test {
namespace {

using lcm::encoded;
using lcm::frame_us;
using lcm::head_message;
using lcm::image_message;
using lcm::start_us;
using ::testing::AllOf;
using ::testing::HasSubstr;

const lcm::Channels channels("GAZED");

Bytes image_event(std::int64_t utime_us, base::PixelFormat format = base::PixelFormat::yuyv) {
  return event(channels.image, encoded(image_message(8, 4, format, utime_us)), utime_us);
}

Bytes head_event(double yaw_rad, std::int64_t utime_us) {
  return event(channels.head_state, encoded(head_message(yaw_rad, 0, utime_us)), utime_us);
}

template <class Make>
std::string refusal_of(const Make& make) {
  try {
    make();
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Playback, IsWhatWasWritten) {
  const TemporaryFile file;
  const auto formats = {base::PixelFormat::yuyv, base::PixelFormat::rgb24, base::PixelFormat::grey};
  {
    LogWriter writer(file.path(), channels);
    std::int64_t utime_us = lcm::start_us;
    for (const base::PixelFormat format : formats) {
      EXPECT_TRUE(writer.write(geometry::Frame{lcm::test_image(8, 4, format).view(), utime_us}));
      EXPECT_TRUE(writer.write(
          geometry::HeadState{.utime_us = utime_us + 7,
                              .measured = {0.1, -0.2},
                              .velocity_rad_s = {std::numeric_limits<double>::quiet_NaN(), 0.5},
                              .stiffness = 0.25F,
                              .temperature_c = 40.0F}));
      utime_us += lcm::frame_us;
    }
    EXPECT_EQ(writer.fault(), "");
  }
  LogCamera camera(file.path(), channels, 8, 4);
  LogHead head(file.path(), channels);
  std::int64_t utime_us = lcm::start_us;
  for (const base::PixelFormat format : formats) {
    EXPECT_EQ(camera.next_utime_us(), utime_us);
    EXPECT_FALSE(camera.finished());
    const auto frame = camera.next_frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->utime_us, utime_us);
    EXPECT_TRUE(lcm::same_pixels(frame->image, lcm::test_image(8, 4, format).view()));

    EXPECT_EQ(head.next_utime_us(), utime_us + 7);
    const auto state = head.next_state();
    ASSERT_TRUE(state);
    EXPECT_EQ(state->utime_us, utime_us + 7);
    EXPECT_EQ(state->measured, (geometry::HeadAngles{0.1, -0.2}));
    EXPECT_TRUE(std::isnan(state->velocity_rad_s.yaw_rad));
    EXPECT_EQ(state->velocity_rad_s.pitch_rad, 0.5);
    EXPECT_EQ(state->stiffness, 0.25F);
    EXPECT_EQ(state->temperature_c, 40.0F);
    utime_us += lcm::frame_us;
  }
  EXPECT_TRUE(camera.finished());
  EXPECT_TRUE(head.finished());
  EXPECT_FALSE(camera.next_utime_us());
  EXPECT_FALSE(head.next_utime_us());
  EXPECT_FALSE(camera.next_frame());
  EXPECT_FALSE(head.next_state());
  EXPECT_EQ(camera.notes() + head.notes() + camera.health().words + head.health().words, "");
  EXPECT_EQ(camera.health().dropped, 0);
}

TEST(Playback, LiblcmReadsWhatWasWritten) {
  const TemporaryFile file;
  {
    LogWriter writer(file.path(), channels);
    writer.write(geometry::Frame{lcm::test_image(8, 4, base::PixelFormat::yuyv).view(), start_us});
    writer.write(lcm::head_state(start_us + 1));
  }
  ::lcm::LogFile log(file.path(), "r");
  ASSERT_TRUE(log.good());
  const ::lcm::LogEvent* first = log.readNextEvent();
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->channel, "GAZED_IMAGE");
  EXPECT_EQ(first->eventnum, 0);
  EXPECT_EQ(first->timestamp, start_us);
  const Bytes message = encoded(image_message(8, 4, base::PixelFormat::yuyv));
  ASSERT_EQ(static_cast<std::size_t>(first->datalen), message.size());
  EXPECT_TRUE(
      std::equal(message.begin(), message.end(), static_cast<const std::uint8_t*>(first->data)));
  const ::lcm::LogEvent* second = log.readNextEvent();
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(second->channel, "GAZED_HEAD_STATE");
  EXPECT_EQ(second->eventnum, 1);
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST(Playback, LogThatLiblcmWrote) {
  const TemporaryFile file;
  {
    ::lcm::LogFile log(file.path(), "w");
    Bytes message = encoded(head_message(0.5, 0));
    ::lcm::LogEvent written{};
    written.channel = channels.head_state;
    written.timestamp = lcm::start_us;
    written.data = message.data();
    written.datalen = static_cast<std::int32_t>(message.size());
    log.writeEvent(&written);
  }
  LogHead head(file.path(), channels);
  EXPECT_EQ(head.next_state()->measured.yaw_rad, 0.5);
}

TEST(LogHead, ObeysNoCommand) {
  const TemporaryFile file;
  file.write(head_event(0.5, start_us));
  LogHead head(file.path(), channels);
  EXPECT_FALSE(head.obeys());
  head.command({.utime_us = 1, .target = {0.1, 0.1}, .speed_fraction = 0.2});
  EXPECT_EQ(head.next_state()->measured.yaw_rad, 0.5);
}

TEST(LogCamera, AFrameStaysUntilTheNextIsAskedFor) {
  const TemporaryFile file;
  auto second = image_message(8, 4, base::PixelFormat::yuyv, start_us + frame_us);
  std::ranges::fill(second.data, 0);
  file.write(joined({image_event(start_us), event(channels.image, encoded(second))}));
  LogCamera camera(file.path(), channels, 8, 4);
  const auto frame = camera.next_frame();
  EXPECT_TRUE(camera.next_utime_us());
  EXPECT_TRUE(
      lcm::same_pixels(frame->image, lcm::test_image(8, 4, base::PixelFormat::yuyv).view()));
}

TEST(LogCamera, CountsGaps) {
  const TemporaryFile file;
  Bytes bytes;
  for (const int i : {0, 1, 2, 3, 6, 7}) {
    bytes = joined({bytes, image_event(start_us + i * frame_us)});
  }
  file.write(bytes);
  LogCamera camera(file.path(), channels, 8, 4);
  while (camera.next_frame()) {
  }
  EXPECT_EQ(camera.health().dropped, 2);
}

TEST(LogCamera, NoEventOfTheChannel) {
  const TemporaryFile file;
  file.write(joined({event("ROBOT_IMAGE", {1}), event("POSE", {2})}));
  EXPECT_EQ(
      refusal_of([&] { LogCamera(file.path(), channels, 8, 4); }),
      "the log " + file.path() + " holds no message on GAZED_IMAGE; it holds: ROBOT_IMAGE, POSE");
}

TEST(LogCamera, EmptyLog) {
  const TemporaryFile file;
  file.write({});
  EXPECT_EQ(refusal_of([&] { LogCamera(file.path(), channels, 8, 4); }), file.path() + " is empty");
}

TEST(LogCamera, FileThatIsNoLogIsCalledSo) {
  const TemporaryFile file;
  const auto refusal = [&](std::string_view beginning) {
    Bytes bytes(beginning.begin(), beginning.end());
    bytes.resize(100, 'x');
    file.write(bytes);
    return refusal_of([&] { LogCamera(file.path(), channels, 8, 4); });
  };
  EXPECT_EQ(refusal("utime_us,file"), file.path() + " is no LCM log: no event begins in it");
  EXPECT_EQ(refusal("\x1F\x8B\x08"),
            file.path() + " is no LCM log but gzip data; unpack it first: gunzip");
  EXPECT_EQ(refusal("#ROSBAG V2.0"), file.path() + " is no LCM log but a ROS bag");
}

TEST(LogCamera, ClockThatIsSetBackIsNotWaitedFor) {
  constexpr std::int64_t back_us = 30'000'000;
  constexpr int before = 5, after = 40, not_believed = 19;
  std::vector<Bytes> events;
  std::int64_t utime_us = start_us;
  for (int i = 0; i < before; ++i) events.push_back(image_event(utime_us += frame_us));
  for (int i = 0; i < after; ++i) events.push_back(image_event((utime_us += frame_us) - back_us));
  const TemporaryFile file;
  Bytes bytes;
  for (const Bytes& one : events) bytes.insert(bytes.end(), one.begin(), one.end());
  file.write(bytes);
  LogCamera camera(file.path(), channels, 8, 4);
  std::int64_t due_us = 0;
  int frames = 0;
  while (const auto next_us = camera.next_utime_us()) {
    EXPECT_GT(*next_us, due_us);
    due_us = *next_us;
    ASSERT_TRUE(camera.next_frame());
    ++frames;
  }
  EXPECT_EQ(frames, before + after - not_believed);
  EXPECT_NEAR(static_cast<double>(due_us), static_cast<double>(utime_us), 1.0 * frame_us);
}

TEST(LogCamera, MissingLog) {
  EXPECT_EQ(refusal_of([] { LogCamera("/nowhere/a.lcm", channels, 8, 4); }),
            "cannot read the log /nowhere/a.lcm: No such file or directory");
}

TEST(LogCamera, NoFrameOfTheConfiguredSize) {
  const TemporaryFile file;
  file.write(joined({image_event(start_us), image_event(start_us + frame_us)}));
  EXPECT_THAT(refusal_of([&] { LogCamera(file.path(), channels, 640, 480); }),
              AllOf(HasSubstr("nothing to play in the log " + file.path()),
                    HasSubstr("GAZED_IMAGE: 2 messages refused"),
                    HasSubstr("8x4 pixels where 640x480 is configured")));
}

TEST(LogCamera, WhatCannotBeUsedIsPassedOverAndTold) {
  const TemporaryFile file;
  Bytes lying = encoded(image_message(8, 4, base::PixelFormat::yuyv, start_us + 1));
  lcm::write_big_endian<std::int32_t>(1'000'000'000, std::span(lying).subspan(32));  // its size
  file.write(joined({{9, 9, 9},
                     image_event(start_us),
                     event(channels.image, lying),
                     event("POSE", {1, 2, 3}),
                     event(channels.image, {1, 2, 3}),
                     image_event(start_us - 1),  // goes backwards
                     image_event(start_us + frame_us)}));
  LogCamera camera(file.path(), channels, 8, 4);
  EXPECT_EQ(camera.next_frame()->utime_us, start_us);
  EXPECT_EQ(camera.next_frame()->utime_us, start_us + frame_us);
  EXPECT_TRUE(camera.finished());
  EXPECT_EQ(camera.health().words, "") << "frames came";
  EXPECT_THAT(camera.notes(), AllOf(HasSubstr("3 bytes passed over in 1 place "),
                                    HasSubstr("GAZED_IMAGE: 3 messages refused"),
                                    HasSubstr("time goes backwards")));
}

TEST(LogHead, NanAnglesAndTimeGoingBackwards) {
  const TemporaryFile file;
  file.write(joined({head_event(0.1, start_us),
                     head_event(std::numeric_limits<double>::quiet_NaN(), start_us + 1),
                     head_event(0.2, start_us - 5), head_event(0.3, start_us + 2)}));
  LogHead head(file.path(), channels);
  EXPECT_EQ(head.next_state()->measured.yaw_rad, 0.1);
  EXPECT_EQ(head.next_state()->measured.yaw_rad, 0.3);
  EXPECT_TRUE(head.finished());
  EXPECT_THAT(head.notes(), HasSubstr("GAZED_HEAD_STATE: 2 messages refused"));
}

TEST(Playback, RandomDamageNeverHarms) {
  std::mt19937_64 random(5);
  Bytes sound;
  for (int i = 0; i < 4; ++i) {
    sound =
        joined({sound, image_event(start_us + i * frame_us), head_event(0.1 * i, start_us + i)});
  }
  const TemporaryFile file;
  int frames = 0;
  int unusable = 0;
  for (int run = 0; run < 30'000; ++run) {
    Bytes damaged = sound;
    lcm::mutate(damaged, random);
    file.write(damaged);
    try {
      LogCamera camera(file.path(), channels, 8, 4);
      LogHead head(file.path(), channels);
      while (camera.next_frame()) ++frames;
      while (head.next_state()) {
      }
    } catch (const std::invalid_argument&) {
      ++unusable;
    }
  }
  EXPECT_GT(frames, 30'000);
  EXPECT_LT(unusable, 30'000);
}

}  // namespace
}  // namespace gazed::log::playback_test
