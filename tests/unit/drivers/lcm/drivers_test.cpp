// Camera, head and watch over LCM's in-process provider, memq://.
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/lcm_camera.hpp"
#include "drivers/lcm/lcm_head.hpp"
#include "drivers/lcm/link.hpp"
#include "drivers/lcm/publisher_watch.hpp"

#include "messages.hpp"

namespace gazed::lcm::drivers_test {
namespace {

constexpr std::size_t bytes_max = 1000;  // of the messages that these tests send

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Channels channels("GAZED");

TEST(ChannelNames, FollowThePrefix) {
  EXPECT_EQ(channels.image, "GAZED_IMAGE");
  EXPECT_EQ(channels.head_state, "GAZED_HEAD_STATE");
  EXPECT_EQ(channels.head_command, "GAZED_HEAD_COMMAND");
  EXPECT_EQ(channels.located_point, "GAZED_LOCATED_POINT");
  EXPECT_EQ(channels.fixation, "GAZED_FIXATION");
  EXPECT_EQ(channels.saliency, "GAZED_SALIENCY");
  EXPECT_EQ(channels.status, "GAZED_STATUS");
}

TEST(ChannelNames, PrefixThatLcmWouldReadAsAPatternIsRefused) {
  for (const std::string prefix : {"", "GAZED.*", "a b", "(", "Gaze-d"}) {
    EXPECT_THROW(Channels{prefix}, std::invalid_argument) << prefix;
  }
  EXPECT_THROW(Channels{std::string(41, 'A')}, std::invalid_argument);
  EXPECT_NO_THROW(Channels{std::string(40, 'A')});
}

TEST(ChannelNames, OfCameraAndHeadMayBeOthers) {
  LcmSettings settings;
  settings.image_channel = "camera/front.image";
  const Channels named(settings);
  EXPECT_EQ(named.image, "camera/front.image");
  EXPECT_EQ(named.head_state, "GAZED_HEAD_STATE");
  settings.head_command_channel = "ROBOT (1)";
  EXPECT_THROW(Channels{settings}, std::invalid_argument);
}

TEST(Link, DeliversWhatIsPublished) {
  LcmLink link("memq://");
  ASSERT_TRUE(link.connected());
  EXPECT_GE(link.descriptor(), 0);
  std::vector<std::uint8_t> got;
  link.subscribe("CHANNEL", bytes_max,
                 [&](auto message) { got.assign(message.begin(), message.end()); });
  const auto message = head_message(0.5, 0.25);
  EXPECT_TRUE(link.publish("CHANNEL", message));
  EXPECT_TRUE(got.empty()) << "not before handle()";
  link.handle();
  EXPECT_EQ(got, encoded(message));
  EXPECT_EQ(link.fault(), "");
}

TEST(Link, HandleDoesNotWait) {
  LcmLink link("memq://");
  link.handle();
  int received = 0;
  link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
  link.handle();
  EXPECT_EQ(received, 0);
  EXPECT_EQ(link.fault(), "");
}

TEST(Camera, ReceivesFrames) {
  LcmLink link("memq://");
  LcmCamera camera(link, channels, 8, 4);
  EXPECT_EQ(camera.descriptor(), link.descriptor());
  EXPECT_FALSE(camera.next_frame());
  link.publish(channels.image, image_message(8, 4, base::PixelFormat::yuyv));
  const auto frame = camera.next_frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->utime_us, start_us);
  EXPECT_TRUE(same_pixels(frame->image, test_image(8, 4, base::PixelFormat::yuyv).view()));
  EXPECT_EQ(camera.health().words, "");
  EXPECT_FALSE(camera.next_utime_us()) << "a live camera does not know";
  EXPECT_FALSE(camera.finished());
}

TEST(Camera, FaultUntilAGoodFrameComes) {
  LcmLink link("memq://");
  LcmCamera camera(link, channels, 8, 4);
  link.publish(channels.image, image_message(16, 4, base::PixelFormat::yuyv));
  EXPECT_FALSE(camera.next_frame());
  EXPECT_THAT(camera.health().words, AllOf(HasSubstr("GAZED_IMAGE: 1 message refused"),
                                           HasSubstr("16x4"), HasSubstr("8x4 is configured")));
  EXPECT_EQ(camera.health().kind, drivers::HealthKind::refused);
  link.publish(channels.image, image_message(8, 4, base::PixelFormat::yuyv));
  EXPECT_TRUE(camera.next_frame());
  EXPECT_EQ(camera.health().words, "");
  EXPECT_EQ(camera.refused(), 1);
}

TEST(Camera, AnotherTypeOnItsChannel) {
  LcmLink link("memq://");
  LcmCamera camera(link, channels, 8, 4);
  link.publish(channels.image, head_message(0, 0));
  EXPECT_FALSE(camera.next_frame());
  EXPECT_THAT(camera.health().words, HasSubstr("not a bot_core.image_t"));
}

TEST(Camera, CountsGaps) {
  LcmLink link("memq://");
  LcmCamera camera(link, channels, 8, 4);
  for (const int i : {0, 1, 2, 3, 6, 7}) {
    link.publish(channels.image,
                 image_message(8, 4, base::PixelFormat::yuyv, start_us + i * frame_us));
    EXPECT_TRUE(camera.next_frame());
  }
  EXPECT_EQ(camera.health().dropped, 2);
}

// No message ends the drivers, and a good one is received after any of them.
TEST(Drivers, SurviveRandomMessages) {
  LcmLink link("memq://");
  LcmCamera camera(link, channels, 16, 8);
  LcmHead head(link, channels);
  std::mt19937_64 random(3);
  const auto image = encoded(image_message(16, 8, base::PixelFormat::grey));
  const auto state = encoded(head_message(0.1, 0.2));
  for (int i = 0; i < 100'000; ++i) {
    const bool is_image = i % 2 == 0;
    auto bytes = is_image ? image : state;
    mutate(bytes, random);
    link.publish_bytes(is_image ? channels.image : channels.head_state, bytes);
    (void)camera.next_frame();
    (void)head.next_state();
  }
  EXPECT_GT(camera.refused(), 10'000);
  EXPECT_GT(head.refused(), 10'000);
}

class Watch : public ::testing::Test {
 protected:
  status_t status(std::int64_t utime_us) {
    status_t message{};
    message.utime = utime_us;
    message.state = "looking";
    return message;
  }
  void publish_own(std::int64_t utime_us) {
    watch_.sent(status(utime_us));
    link_.publish(channels.status, status(utime_us));
    link_.handle();
  }
  void publish_foreign(std::int64_t utime_us) {
    link_.publish(channels.status, status(utime_us));
    link_.handle();
  }

  LcmLink link_{"memq://"};
  PublisherWatch watch_{link_, channels};
  PublisherWatch::Clock::time_point now_{1000s};
};

TEST_F(Watch, OwnMessagesAreKnown) {
  for (int i = 0; i < 5000; ++i) publish_own(start_us + i);
  EXPECT_EQ(watch_.warning(now_), "");
}

TEST_F(Watch, AForeignMessageIsToldOnceAMinute) {
  publish_own(start_us);
  publish_foreign(start_us + 1);
  EXPECT_THAT(watch_.warning(now_),
              HasSubstr("another program publishes on GAZED_STATUS too (1 message so far)"));
  EXPECT_EQ(watch_.warning(now_), "") << "said already";
  publish_foreign(start_us + 2);
  EXPECT_EQ(watch_.warning(now_ + 59s), "");
  EXPECT_THAT(watch_.warning(now_ + 60s), HasSubstr("(2 messages so far)"));
  EXPECT_EQ(watch_.warning(now_ + 1h), "") << "the other one has ended";
}

TEST_F(Watch, TheSameTimeWithOtherContentIsForeign) {
  watch_.sent(status(start_us));
  auto other = status(start_us);
  other.state = "turning";
  link_.publish(channels.status, other);
  link_.handle();
  EXPECT_THAT(watch_.warning(now_), HasSubstr("(1 message so far)"));
}

TEST_F(Watch, GarbageIsNoOtherGazed) {
  link_.publish_bytes(channels.status, std::vector<std::uint8_t>{1, 2, 3});
  link_.handle();
  EXPECT_EQ(watch_.warning(now_), "");
}

}  // namespace
}  // namespace gazed::lcm::drivers_test
