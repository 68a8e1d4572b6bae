#include "drivers/naoqi/connection.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

#include "tests/unit/naoqi/golden.hpp"

namespace gazed::connection_test {
namespace {

/// Fed as a socket feeds it, as far as it takes it. The messages, and how many.
struct Received {
  std::string payloads;
  int messages = 0;
  QiHeader last;
};
Received feed(QiInbox& inbox, QiBytes bytes) {
  Received all;
  while (!bytes.empty() && !inbox.broken()) {
    const auto room = inbox.room();
    const std::size_t count = std::min(room.size(), bytes.size());
    std::copy_n(bytes.begin(), count, room.begin());
    bytes.remove_prefix(count);
    if (const auto message = inbox.received(count)) {
      all.payloads += message->payload;
      all.last = message->header;
      ++all.messages;
    }
  }
  return all;
}

std::string header_of(std::uint32_t payload_bytes) {
  QiWriter header;
  header.header({.payload_bytes = payload_bytes});
  return std::string(header.bytes());
}

TEST(QiInbox, AHeaderIsReadAsItWasWritten) {
  const std::string bytes = from_hex(golden_get_angles_call);
  QiInbox dut;
  const QiHeader header = feed(dut, bytes).last;
  EXPECT_EQ(header.id, 10U);
  EXPECT_EQ(header.payload_bytes, bytes.size() - sizeof header);
  EXPECT_EQ(header.type, QiType::call);
  EXPECT_EQ(header.flags, 0);
  EXPECT_EQ(header.service, 2U);
  EXPECT_EQ(header.object, 1U);
  EXPECT_EQ(header.action, 100U);
}

TEST(QiInbox, MessagesComeOutHoweverTheyAreCut) {
  const std::string one = from_hex(golden_get_angles_call);
  std::string stream, payloads;
  for (int i = 0; i < 5; ++i) {
    stream += one + header_of(0);
    payloads += one.substr(sizeof(QiHeader));
  }
  for (const std::size_t piece : {1, 3, 27, 28, 29, 100, 1000}) {
    QiInbox dut;
    Received all;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      const Received some = feed(dut, QiBytes(stream).substr(at, piece));
      all.messages += some.messages;
      all.payloads += some.payloads;
    }
    EXPECT_EQ(all.messages, 10) << "in pieces of " << piece;
    EXPECT_EQ(all.payloads, payloads) << "in pieces of " << piece;
    EXPECT_FALSE(dut.broken());
  }
}

TEST(QiInbox, TheLargestMessageIsWaitedFor) {
  QiInbox dut;
  EXPECT_EQ(feed(dut, header_of(qi_payload_max)).messages, 0);
  EXPECT_EQ(dut.room().size(), qi_payload_max);
  EXPECT_FALSE(dut.received(qi_payload_max - 1));
  EXPECT_EQ(dut.room().size(), 1U);
  const auto message = dut.received(1);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->payload.size(), qi_payload_max);
}

TEST(QiInbox, APayloadOverTheLimitBreaksIt) {
  QiInbox dut;
  feed(dut, header_of(qi_payload_max + 1));
  EXPECT_TRUE(dut.broken());
}

TEST(QiInbox, WhatIsNoMessageBreaksItAsSoonAsItsHeaderIsThere) {
  std::string bytes = from_hex(golden_get_angles_call);
  bytes[2] = 0;
  QiInbox dut;
  feed(dut, bytes.substr(0, sizeof(QiHeader) - 1));
  EXPECT_FALSE(dut.broken());
  EXPECT_EQ(feed(dut, bytes.substr(sizeof(QiHeader) - 1)).messages, 0);
  EXPECT_TRUE(dut.broken());
}

}  // namespace
}  // namespace gazed::connection_test
