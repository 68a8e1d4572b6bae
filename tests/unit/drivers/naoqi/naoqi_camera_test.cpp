#include "drivers/naoqi/naoqi_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string_view>

#include "tests/unit/drivers/naoqi/camera_rig.hpp"

namespace gazed::naoqi::naoqi_camera_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using NaoqiCameraTest = NaoqiCameraRig;

TEST_F(NaoqiCameraTest, ImagesComeWithTheRobotsOwnTime) {
  ASSERT_TRUE(turn_until_frame()) << dut().health().words;
  EXPECT_EQ(frame_.image.width_px, width_px);
  EXPECT_EQ(frame_.image.height_px, height_px);
  EXPECT_EQ(frame_.image.format, base::PixelFormat::yuyv);
  EXPECT_EQ(last_y_, 0x37);
  EXPECT_EQ((frame_.utime_us + 20'000) % 33'333, 0);
  EXPECT_LE(now_us_ - frame_.utime_us, 33'333 + 20'000 + 10'000);
  EXPECT_THAT(asked_for_, ElementsAre(1, 0, naoqi_yuv422, 30));  // bottom, 160x120
  EXPECT_THAT(name_, StartsWith("gazed_"));
  EXPECT_THAT(name_, ::testing::EndsWith("_bottom"));
}

TEST_F(NaoqiCameraTest, EveryImageComesOnce) {
  ASSERT_TRUE(turn_until_frame());
  frames_ = 0;
  for (int i = 0; i < 3'000; ++i) turn();
  EXPECT_GE(frames_, 88);
  EXPECT_LE(frames_, 91);
  EXPECT_EQ(dut().health().dropped, 0);
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiCameraTest, NothingIsAllocatedOnceItRuns) {
  ASSERT_TRUE(turn_until_frame());
  ASSERT_TRUE(turn_until_frame());
  allocated_ = 0;
  for (int i = 0; i < 1'000; ++i) turn();
  EXPECT_EQ(allocated_, 0);
}

TEST_F(NaoqiCameraTest, NumbersAndBytesMayBeOfAnyType) {
  for (const char type : {'i', 'I', 'l', 'L', 'd'}) {
    for (const std::string_view bytes : {"r", "s"}) {
      number_type_ = type;
      bytes_type_ = bytes;
      EXPECT_TRUE(turn_until_frame()) << type << bytes << dut().health().words;
    }
  }
}

TEST_F(NaoqiCameraTest, AListThatIsNotDynamicIsAnImageToo) {
  robot_.methods[1].returns = "[m]";
  robot_.methods[1].handler = [this](QiReader) {
    const FakeAnswer dynamic = image();
    FakeAnswer answer;
    answer.payload.raw(dynamic.payload.bytes().substr(4 + 3));  // without its signature
    return answer;
  };
  EXPECT_TRUE(turn_until_frame()) << dut().health().words;
}

TEST_F(NaoqiCameraTest, AnotherComputersClockIsFollowed) {
  // As long ago as since a robot's start: nobody set its clock.
  robot_ahead_us_ = 60'000'000 - start_us;
  ASSERT_TRUE(turn_until_frame());
  for (int i = 0; i < 1'000; ++i) turn();
  // Within the time between two questions.
  EXPECT_NEAR(static_cast<double>(now_us_ - frame_.utime_us), 40'000.0, 30'000.0);
}

// Behind a tunnel's end on this computer.
TEST_F(NaoqiCameraTest, AClockThatIsNearlyThisComputersIsStillAnothers) {
  robot_ahead_us_ = -3'000'000;
  ASSERT_TRUE(turn_until_frame());
  for (int i = 0; i < 1'000; ++i) turn();
  EXPECT_NEAR(static_cast<double>(now_us_ - frame_.utime_us), 40'000.0, 30'000.0);
}

TEST_F(NaoqiCameraTest, ALateImageOfThisComputersClockKeepsItsTime) {
  for (int i = 0; i < 12; ++i) ASSERT_TRUE(turn_until_frame());
  robot_ahead_us_ = -700'000;
  for (int i = 0; i < 100; ++i) turn();
  EXPECT_GE(now_us_ - frame_.utime_us, 700'000);
}

TEST_F(NaoqiCameraTest, ARefusalIsAFaultAndTriedAgain) {
  refuses_ = true;
  EXPECT_TRUE(turn_until_fault("cannot be subscribed"));
  EXPECT_EQ(dut().health().kind, drivers::HealthKind::lost);
  refuses_ = false;
  EXPECT_TRUE(turn_until_frame());
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiCameraTest, WhatIsNoSuchImageIsAFault) {
  ASSERT_TRUE(turn_until_frame());
  sent_width_ = 320;
  EXPECT_TRUE(turn_until_fault("ALVideoDevice: an image of 320x120 in colour space 9"));
  EXPECT_EQ(dut().health().kind, drivers::HealthKind::refused);
  sent_width_ = width_px;
  pixels_.pop_back();
  EXPECT_TRUE(turn_until_fault("an image of 38399 bytes; 38400 were due"));
  pixels_.push_back('\0');
  no_image_ = true;
  EXPECT_TRUE(turn_until_fault("it has no image"));
  no_image_ = false;
  frozen_us_ = -5'000'000;
  EXPECT_TRUE(turn_until_fault("an image without a time"));
  EXPECT_GE(dut().health().dropped, 4);
  frozen_us_.reset();
  EXPECT_TRUE(turn_until_frame());
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiCameraTest, AnImageThatStaysTheSameIsSubscribedAnew) {
  ASSERT_TRUE(turn_until_frame());
  frozen_us_ = robots_us();
  EXPECT_TRUE(turn_until_fault("no new image for 2.0 s"));
  EXPECT_EQ(dut().health().kind, drivers::HealthKind::no_data);
  turn_until([this] { return robot_.calls_of("subscribeCamera") == 2; });
  frozen_us_.reset();
  EXPECT_TRUE(turn_until_frame());
}

TEST_F(NaoqiCameraTest, SizesThatTheRobotHasNotAreRefused) {
  EXPECT_THROW(NaoqiCamera({.robot = {}, .width_px = 800, .height_px = 600}),
               std::invalid_argument);
  EXPECT_THROW(NaoqiCamera({.robot = {}, .width_px = 2560, .height_px = 1920}),
               std::invalid_argument);
  EXPECT_NO_THROW(NaoqiCamera({.robot = {}, .width_px = 1280, .height_px = 960}));
}

}  // namespace
}  // namespace gazed::naoqi::naoqi_camera_test
