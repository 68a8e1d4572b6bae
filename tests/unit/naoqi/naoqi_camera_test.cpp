#include "drivers/naoqi/naoqi_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>

#include "tests/unit/allocations.hpp"
#include "tests/unit/naoqi/fake_naoqi.hpp"

namespace gazed::naoqi_camera_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr int width_px = 160, height_px = 120;
constexpr std::int64_t start_us = 1'700'000'000'000'000;

/// A number as a type of the robot's choice writes it.
void write_number(QiWriter& writer, char type, std::int64_t number) {
  writer.text(std::string_view(&type, 1));
  if (type == 'd') {
    writer.integer(std::bit_cast<std::uint64_t>(static_cast<double>(number)), 8);
  } else {
    writer.integer(static_cast<std::uint64_t>(number), type == 'i' || type == 'I' ? 4 : 8);
  }
}

class NaoqiCameraTest : public testing::Test {
 protected:
  NaoqiCameraTest() {
    const auto add = [this](const char* name, const char* parameters, const char* returns,
                            FakeNaoqi::Handler handler) {
      robot_.methods.push_back({name, parameters, returns, std::move(handler)});
    };
    add("subscribeCamera", "(siiii)", "s", [this](QiReader arguments) {
      FakeAnswer answer;
      name_ = arguments.text();
      for (std::int64_t& number : asked_for_) number = arguments.u32();
      handle_ = refuses_ ? "" : name_ + "_0";
      answer.payload.text(handle_);
      return answer;
    });
    add("getImageRemote", "(s)", "m", [this](QiReader arguments) {
      if (arguments.text() != handle_) return fake_error("unknown handle");
      return image();
    });
    add("releaseImage", "(s)", "b", [](QiReader) { return truth(); });
    add("unsubscribe", "(s)", "b", [this](QiReader arguments) {
      unsubscribed_.emplace_back(arguments.text());
      return truth();
    });
    add("unsubscribeAllInstances", "(s)", "b", [this](QiReader arguments) {
      unsubscribed_.push_back("all of " + std::string(arguments.text()));
      return truth();
    });
  }
  ~NaoqiCameraTest() override { robot_.close_all(); }

  static FakeAnswer truth() {
    FakeAnswer answer;
    answer.payload.integer(1, 1);
    return answer;
  }

  /// The image of the robot's clock, 30 a second.
  FakeAnswer image() {
    FakeAnswer answer;
    if (no_image_) {
      answer.payload.text("v");
      return answer;
    }
    const std::int64_t stamp_us = (frozen_us_ ? *frozen_us_ : robots_us()) / 33'333 * 33'333;
    answer.payload.text("[m]").u32(12);
    for (const std::int64_t number :
         {sent_width_, std::int64_t{height_px}, std::int64_t{2}, std::int64_t{naoqi_yuv422},
          stamp_us / 1'000'000, stamp_us % 1'000'000})
      write_number(answer.payload, number_type_, number);
    answer.payload.text(bytes_type_).text(pixels_);
    for (int i = 0; i < 5; ++i) write_number(answer.payload, 'd', 0);
    return answer;
  }
  std::int64_t robots_us() const { return now_us_ + robot_ahead_us_; }

  NaoqiCamera& dut() {
    if (!dut_) {
      NaoqiCameraSettings settings{.robot = {robot_.endpoint(), "", ""},
                                   .position = CameraPosition::bottom,
                                   .width_px = width_px,
                                   .height_px = height_px,
                                   .delay_s = -0.02};
      dut_.emplace(settings,
                   Clocks{[this] { return now_us_ - start_us; }, [this] { return now_us_; }});
    }
    return *dut_;
  }
  void turn() {
    robot_.serve();
    now_us_ += 1'000;
    const long before = allocations();
    const auto frame = dut().next_frame();
    allocated_ += allocations() - before;
    if (!frame) return;
    ++frames_;
    frame_ = *frame;
    last_y_ = frame->image.row(height_px - 1)[2 * width_px - 2];
  }
  template <typename Condition>
  bool turn_until(Condition condition) {
    for (int i = 0; i < 6'000 && !condition(); ++i) turn();
    return condition();
  }
  bool turn_until_frame() {
    frames_ = 0;
    return turn_until([this] { return frames_ > 0; });
  }
  bool turn_until_fault(const std::string& part) {
    return turn_until([&] { return dut().fault().find(part) != std::string::npos; });
  }

  FakeNaoqi robot_;
  std::int64_t now_us_ = start_us;
  std::int64_t robot_ahead_us_ = 0;
  std::optional<std::int64_t> frozen_us_;
  std::string name_, handle_;
  std::vector<std::string> unsubscribed_;
  std::array<std::int64_t, 4> asked_for_{};
  std::int64_t sent_width_ = width_px;
  std::string pixels_ = std::string(2 * width_px * height_px, '\x37');
  std::string_view bytes_type_ = "r";
  char number_type_ = 'i';
  bool refuses_ = false, no_image_ = false;

  std::optional<NaoqiCamera> dut_;
  int frames_ = 0;
  Frame frame_;
  int last_y_ = 0;
  long allocated_ = 0;
};

TEST_F(NaoqiCameraTest, ImagesComeWithTheRobotsOwnTime) {
  ASSERT_TRUE(turn_until_frame()) << dut().fault();
  EXPECT_EQ(frame_.image.width_px, width_px);
  EXPECT_EQ(frame_.image.height_px, height_px);
  EXPECT_EQ(frame_.image.format, PixelFormat::yuyv);
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
  EXPECT_EQ(dut().frames_dropped(), 0);
  EXPECT_EQ(dut().fault(), "");
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
      EXPECT_TRUE(turn_until_frame()) << type << bytes << dut().fault();
    }
  }
}

TEST_F(NaoqiCameraTest, AListThatIsNotDynamicIsAnImageToo) {
  robot_.methods[1].returns = "[m]";
  robot_.methods[1].handler = [this](QiReader) {
    const FakeAnswer dynamic = image();
    FakeAnswer answer;
    answer.payload.raw(dynamic.payload.bytes().subspan(4 + 3));  // without its signature
    return answer;
  };
  EXPECT_TRUE(turn_until_frame()) << dut().fault();
}

TEST_F(NaoqiCameraTest, AnotherComputersClockIsFollowed) {
  // As long ago as since a robot's start: nobody set its clock.
  robot_ahead_us_ = 60'000'000 - start_us;
  ASSERT_TRUE(turn_until_frame());
  for (int i = 0; i < 1'000; ++i) turn();
  // Within the time between two questions.
  EXPECT_NEAR(static_cast<double>(now_us_ - frame_.utime_us), 40'000.0, 30'000.0);
}

TEST_F(NaoqiCameraTest, ItIsUnsubscribedAtTheEnd) {
  ASSERT_TRUE(turn_until_frame());
  unsubscribed_.clear();
  dut_.reset();
  robot_.serve();
  EXPECT_THAT(unsubscribed_, ElementsAre(handle_));
}

TEST_F(NaoqiCameraTest, WhatAnEarlierOneLeftIsUnsubscribedFirst) {
  ASSERT_TRUE(turn_until_frame());
  EXPECT_THAT(unsubscribed_, ElementsAre("all of " + name_));
}

TEST_F(NaoqiCameraTest, WithoutTheMethodForItTheyAreUnsubscribedOneByOne) {
  ASSERT_TRUE(turn_until_frame());
  const std::string own = name_;
  dut_.reset();
  robot_.serve();
  unsubscribed_.clear();
  robot_.methods.pop_back();
  robot_.methods.push_back(
      {"getSubscribers", "()", "[s]", [own](QiReader) {
         FakeAnswer answer;
         answer.payload.u32(3).text(own + "_0").text("other_0").text(own + "_3");
         return answer;
       }});
  ASSERT_TRUE(turn_until_frame());
  EXPECT_THAT(unsubscribed_, ElementsAre(own + "_0", own + "_3"));
}

TEST_F(NaoqiCameraTest, ARefusalIsAFaultAndTriedAgain) {
  refuses_ = true;
  EXPECT_TRUE(turn_until_fault("cannot be subscribed"));
  refuses_ = false;
  EXPECT_TRUE(turn_until_frame());
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiCameraTest, WhatIsNoSuchImageIsAFault) {
  ASSERT_TRUE(turn_until_frame());
  sent_width_ = 320;
  EXPECT_TRUE(turn_until_fault("ALVideoDevice: an image of 320x120 in colour space 9"));
  sent_width_ = width_px;
  pixels_.pop_back();
  EXPECT_TRUE(turn_until_fault("an image of 38399 bytes; 38400 were due"));
  pixels_.push_back('\0');
  no_image_ = true;
  EXPECT_TRUE(turn_until_fault("it has no image"));
  no_image_ = false;
  frozen_us_ = -5'000'000;
  EXPECT_TRUE(turn_until_fault("an image without a time"));
  EXPECT_GE(dut().frames_dropped(), 4);
  frozen_us_.reset();
  EXPECT_TRUE(turn_until_frame());
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiCameraTest, AnImageThatStaysTheSameIsSubscribedAnew) {
  ASSERT_TRUE(turn_until_frame());
  frozen_us_ = robots_us();
  EXPECT_TRUE(turn_until_fault("no new image for 2.0 s"));
  turn_until([this] { return robot_.calls_of("subscribeCamera") == 2; });
  frozen_us_.reset();
  EXPECT_TRUE(turn_until_frame());
}

TEST_F(NaoqiCameraTest, AVideoDeviceThatForgotUsIsSubscribedAnew) {
  ASSERT_TRUE(turn_until_frame());
  handle_ = "somebody else";
  EXPECT_TRUE(turn_until_fault("unknown handle"));
  EXPECT_TRUE(turn_until_frame());
}

TEST_F(NaoqiCameraTest, ARobotThatComesBackIsSubscribedAnew) {
  ASSERT_TRUE(turn_until_frame());
  robot_.close_all();
  EXPECT_TRUE(turn_until_fault("ALVideoDevice at 127.0.0.1"));
  EXPECT_TRUE(turn_until_frame());
  EXPECT_EQ(robot_.calls_of("subscribeCamera"), 2);
}

TEST_F(NaoqiCameraTest, SizesThatTheRobotHasNotAreRefused) {
  EXPECT_THROW(NaoqiCamera({.robot = {}, .width_px = 800, .height_px = 600}),
               std::invalid_argument);
  EXPECT_THROW(NaoqiCamera({.robot = {}, .width_px = 2560, .height_px = 1920}),
               std::invalid_argument);
  EXPECT_NO_THROW(NaoqiCamera({.robot = {}, .width_px = 1280, .height_px = 960}));
}

}  // namespace
}  // namespace gazed::naoqi_camera_test
