// The head over LCM's in-process provider, memq://.
#include "drivers/lcm/lcm_head.hpp"

#include <cstddef>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "agent/geometry/limits.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/link.hpp"

#include "messages.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::lcm::lcm_head_test {
namespace {

constexpr std::size_t bytes_max = 1000;  // of the messages that these tests send

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Channels channels("GAZED");

TEST(Head, StatesInCommandsOut) {
  LcmLink link("memq://");
  LcmHead head(link, channels);
  std::vector<std::uint8_t> sent;
  link.subscribe(channels.head_command, bytes_max,
                 [&](auto message) { sent.assign(message.begin(), message.end()); });
  link.publish(channels.head_state, head_message(0.25, -0.125));
  const auto state = head.next_state();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->measured, (geometry::HeadAngles{0.25, -0.125}));

  head.command({.utime_us = start_us, .target = {0.5, 0.1}, .speed_fraction = 0.2});
  link.handle();
  head_command_t command{};
  ASSERT_EQ(command.decode(sent.data(), 0, static_cast<int>(sent.size())),
            static_cast<int>(sent.size()));
  EXPECT_EQ(command.utime, start_us);
  EXPECT_EQ(command.yaw_rad, 0.5);
  EXPECT_EQ(command.pitch_rad, 0.1);
  EXPECT_EQ(command.speed_fraction, 0.2);
  EXPECT_TRUE(head.obeys());
  EXPECT_EQ(head.health().words, "");
}

/// The commands that went over a link since this was made.
class SentCommands {
 public:
  explicit SentCommands(LcmLink& link) {
    link.subscribe(channels.head_command, bytes_max, [this](auto message) {
      head_command_t command{};
      command.decode(message.data(), 0, static_cast<int>(message.size()));
      all_.push_back(from_message(command));
    });
  }
  SentCommands(const SentCommands&) = delete;
  SentCommands& operator=(const SentCommands&) = delete;

  [[nodiscard]] const std::vector<geometry::HeadCommand>& all() const { return all_; }

 private:
  std::vector<geometry::HeadCommand> all_;
};

TEST(Head, HoldsWhereItWasMeasured) {
  LcmLink link("memq://");
  LcmHead head(link, channels);
  const SentCommands commands(link);
  const std::vector<geometry::HeadCommand>& sent = commands.all();
  head.hold();
  link.handle();
  EXPECT_TRUE(sent.empty()) << "a head that was never moved is left alone";
  head.command({.utime_us = start_us, .target = {0.5, 0.1}, .speed_fraction = 0.2});
  link.publish(channels.head_state, head_message(0.375, 0.0625, start_us + 9));
  EXPECT_TRUE(head.next_state());
  head.hold();
  link.handle();
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[1].target, (geometry::HeadAngles{0.375, 0.0625}));
  EXPECT_EQ(sent[1].utime_us, start_us + 9);
  EXPECT_EQ(sent[1].speed_fraction, 0.2);
}

// A head's encoders may be off by more than its margin: the place it is to be held at is where it
// may be told to go.
TEST(Head, HoldsAtTheEdgeWhatWasMeasuredBeyondTheLimits) {
  LcmLink link("memq://");
  LcmHead head(link, channels);
  const SentCommands sent(link);
  head.command({.utime_us = start_us, .target = {0.5, 0.5}, .speed_fraction = 0.2});
  link.publish(channels.head_state, head_message(0.5, 0.55, start_us + 9));
  EXPECT_TRUE(head.next_state());
  head.hold();
  link.handle();
  ASSERT_EQ(sent.all().size(), 2U);
  EXPECT_EQ(sent.all()[1].target, geometry::HeadLimits().clamp({0.5, 0.55}));
}

TEST(Head, ACommandThatIsNoneIsNotSentAndTold) {
  LcmLink link("memq://");
  LcmHead head(link, channels);
  const SentCommands sent(link);
  head.command({start_us, {std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.2});
  link.handle();
  EXPECT_THAT(sent.all(), IsEmpty());
  EXPECT_EQ(head.health().kind, drivers::HealthKind::disobeyed);
  EXPECT_THAT(head.health().words, HasSubstr("(nan, 0) rad at speed 0.2 is not a valid command"));
  head.command({start_us, {0.1, 0.0}, 0.2});
  EXPECT_EQ(head.health().words, "");
}

TEST(Head, WhateverItReportsAndIsToldNothingOutsideTheLimitsIsSent) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> said_rad(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> told_rad(-10.0, 10.0), speed(0.01, 3.0);
  const geometry::HeadLimits limits;
  const int heads = test::trials(2'000, 100);
  std::size_t outside = 0;
  for (int i = 0; i < heads; ++i) {
    LcmLink link("memq://");
    LcmHead head(link, channels);
    const SentCommands sent(link);
    const geometry::HeadAngles said{said_rad(random), said_rad(random)};
    head.command({start_us, {told_rad(random), told_rad(random)}, speed(random)});
    link.publish(channels.head_state, head_message(said.yaw_rad, said.pitch_rad, start_us + 9));
    ASSERT_TRUE(head.next_state());
    head.hold();
    link.handle();
    ASSERT_EQ(sent.all().size(), 2U);
    if (!limits.contains(said)) ++outside;
    for (const geometry::HeadCommand& command : sent.all()) {
      ASSERT_TRUE(limits.contains(command.target))
          << command.target.yaw_rad << ' ' << command.target.pitch_rad;
      ASSERT_LE(command.speed_fraction, 1.0);
    }
  }
  EXPECT_GT(outside, static_cast<std::size_t>(heads) / 2);
}

TEST(Head, NanAnglesAreRefusedAndTold) {
  LcmLink link("memq://");
  LcmHead head(link, channels);
  link.publish(channels.head_state, head_message(std::numeric_limits<double>::quiet_NaN(), 0.0));
  EXPECT_FALSE(head.next_state());
  EXPECT_THAT(head.health().words,
              HasSubstr("GAZED_HEAD_STATE: 1 message refused, the last: head angles "
                        "(nan, 0) rad"));
  link.publish(channels.head_state, head_message(0, 0));
  EXPECT_TRUE(head.next_state());
  EXPECT_EQ(head.health().words, "");
}

TEST(Head, TimeGoingBackwards) {
  LcmLink link("memq://");
  LcmHead head(link, channels);
  link.publish(channels.head_state, head_message(0, 0, start_us));
  EXPECT_TRUE(head.next_state());
  link.publish(channels.head_state, head_message(0, 0, start_us - 1));
  EXPECT_FALSE(head.next_state());
  EXPECT_THAT(head.health().words, HasSubstr("time goes backwards"));
  EXPECT_EQ(head.health().kind, drivers::HealthKind::refused);
}

}  // namespace
}  // namespace gazed::lcm::lcm_head_test
