#include "drivers/lcm/reassembly.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "drivers/lcm/datagram.hpp"

namespace gazed::lcm::reassembly_test {
namespace {

using namespace std::chrono_literals;
using Packet = std::vector<std::uint8_t>;

constexpr std::size_t limit = 300'000;
constexpr Reassembly::Clock::time_point start{1000s};
constexpr DatagramSource robot{1, 1}, other{2, 1};

Packet some_message(std::size_t bytes) {
  Packet out(bytes);
  for (std::size_t i = 0; i < bytes; ++i) out[i] = static_cast<std::uint8_t>(i * 13 + i / 7);
  return out;
}

/// A message as the datagrams that carry it.
std::vector<Packet> datagrams(const Packet& message) {
  static DatagramWriter writer;  // so that each message has a sequence number of its own
  EXPECT_TRUE(writer.begin("NAME", message));
  std::vector<Packet> out;
  for (auto one = writer.next(); !one.empty(); one = writer.next())
    out.emplace_back(one.begin(), one.end());
  return out;
}

/// The message, copied, when the datagram completes one.
std::optional<Packet> add(Reassembly& reassembly, const Packet& datagram,
                          const DatagramSource& source = robot,
                          Reassembly::Clock::time_point now = start) {
  const Datagram read = parse_datagram(datagram);
  const auto done = reassembly.add(source, std::get<Fragment>(read), limit, now);
  if (!done) return std::nullopt;
  return Packet(done->begin(), done->end());
}

TEST(Reassembly, InOrder) {
  Reassembly reassembly;
  const Packet message = some_message(200'000);
  const auto pieces = datagrams(message);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) EXPECT_FALSE(add(reassembly, pieces[i]));
  EXPECT_EQ(add(reassembly, pieces.back()), message);
  EXPECT_EQ(reassembly.channel(), "NAME");
}

TEST(Reassembly, LaterFragmentsInAnyOrderAndTwice) {
  Reassembly reassembly;
  const Packet message = some_message(250'000);
  const auto pieces = datagrams(message);
  ASSERT_EQ(pieces.size(), 4U);
  EXPECT_FALSE(add(reassembly, pieces[0]));
  EXPECT_FALSE(add(reassembly, pieces[3]));
  EXPECT_FALSE(add(reassembly, pieces[3]));
  EXPECT_FALSE(add(reassembly, pieces[1]));
  EXPECT_EQ(add(reassembly, pieces[2]), message);
}

TEST(Reassembly, TwoSendersAtOnce) {
  Reassembly reassembly;
  const Packet a = some_message(100'000), b = some_message(120'000);
  const auto of_a = datagrams(a), of_b = datagrams(b);
  EXPECT_FALSE(add(reassembly, of_a[0], robot));
  EXPECT_FALSE(add(reassembly, of_b[0], other));
  EXPECT_EQ(add(reassembly, of_a[1], robot), a);
  EXPECT_EQ(add(reassembly, of_b[1], other), b);
}

TEST(Reassembly, ALostFragmentCostsItsMessageOnly) {
  Reassembly reassembly;
  const Packet message = some_message(200'000);
  EXPECT_FALSE(add(reassembly, datagrams(message)[0]));
  int complete = 0;
  for (const Packet& piece : datagrams(message)) {
    const auto done = add(reassembly, piece);
    if (!done) continue;
    ++complete;
    EXPECT_EQ(*done, message);
  }
  EXPECT_EQ(complete, 1);
}

TEST(Reassembly, WithoutItsFirstFragmentAMessageIsNotBegun) {
  Reassembly reassembly;
  EXPECT_FALSE(add(reassembly, datagrams(some_message(100'000))[1]));
  EXPECT_EQ(reassembly.held_bytes(), 0U);
}

TEST(Reassembly, WhatIsLargerThanItsChannelAllowsTakesNoMemory) {
  Reassembly reassembly;
  EXPECT_FALSE(add(reassembly, datagrams(some_message(limit + 1))[0]));
  EXPECT_EQ(reassembly.held_bytes(), 0U);
}

TEST(Reassembly, AMessageIsNotCompletedLate) {
  Reassembly reassembly;
  const auto pieces = datagrams(some_message(100'000));
  EXPECT_FALSE(add(reassembly, pieces[0]));
  EXPECT_FALSE(add(reassembly, pieces[1], robot, start + Reassembly::patience + 1ms));
}

TEST(Reassembly, FragmentsThatDoNotBelongTogetherEndTheMessage) {
  const Packet message = some_message(100'000);
  Fragment first{.sequence = 1,
                 .message_bytes = 10,
                 .offset = 0,
                 .number = 0,
                 .count = 2,
                 .channel = "NAME",
                 .data = std::span(message).first(5)};
  Fragment second{.sequence = 1,
                  .message_bytes = 10,
                  .offset = 5,
                  .number = 1,
                  .count = 2,
                  .channel = {},
                  .data = std::span(message).first(5)};
  const auto completes = [&](const Fragment& then) {
    Reassembly reassembly;
    EXPECT_FALSE(reassembly.add(robot, first, limit, start));
    return reassembly.add(robot, then, limit, start).has_value();
  };
  EXPECT_TRUE(completes(second));
  Fragment wrong = second;
  wrong.count = 3;
  EXPECT_FALSE(completes(wrong));
  wrong = second;
  wrong.message_bytes = 11;
  EXPECT_FALSE(completes(wrong));
  wrong = second;
  wrong.sequence = 2;
  EXPECT_FALSE(completes(wrong));
  wrong = second;
  wrong.data = std::span(message).first(4);  // a byte is missing
  EXPECT_FALSE(completes(wrong));
  wrong.offset = 0;
  wrong.data = std::span(message).first(10);  // more bytes than the message has
  EXPECT_FALSE(completes(wrong));
}

TEST(Reassembly, ManySendersHoldBoundedMemory) {
  Reassembly reassembly;
  const auto pieces = datagrams(some_message(limit));
  for (std::uint32_t address = 0; address < 1000; ++address)
    EXPECT_FALSE(add(reassembly, pieces[0], {address, 1}));
  EXPECT_LE(reassembly.held_bytes(), Reassembly::messages_held_max * limit);
  EXPECT_GE(reassembly.held_bytes(), limit);
}

TEST(Reassembly, SmallMessagesOfManySendersAreAllCompleted) {
  Reassembly reassembly;
  const auto large = datagrams(some_message(limit)), small = datagrams(some_message(70'000));
  EXPECT_FALSE(add(reassembly, large[0], {0, 1}));
  for (std::uint32_t address = 1; address < Reassembly::sources_max; ++address)
    EXPECT_FALSE(add(reassembly, small[0], {address, 1}));
  for (std::uint32_t address = 1; address < Reassembly::sources_max; ++address)
    EXPECT_TRUE(add(reassembly, small[1], {address, 1}));
}

// Random mixtures of what can be sent never reach beyond a message (the sanitizers look), and what
// is completed is what one sender sent.
TEST(Reassembly, RandomMixtures) {
  std::mt19937 random(1);
  Reassembly reassembly;
  const std::vector<Packet> messages{some_message(70'000), some_message(140'000)};
  int completed = 0;
  std::vector<std::vector<Packet>> queues(6);
  for (int turn = 0; turn < 20'000; ++turn) {
    const std::size_t sender = random() % queues.size();
    auto& queue = queues[sender];
    if (queue.empty()) queue = datagrams(messages[sender % 2]);
    const Packet piece = queue.front();
    queue.erase(queue.begin());
    if (random() % 8 == 0) continue;  // lost
    const auto done = add(reassembly, piece, {static_cast<std::uint32_t>(sender), 9});
    if (!done) continue;
    ++completed;
    ASSERT_EQ(*done, messages[sender % 2]);
  }
  EXPECT_GT(completed, 0);
}

}  // namespace
}  // namespace gazed::lcm::reassembly_test
