#include "drivers/naoqi/wire.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "drivers/naoqi/value.hpp"

#include "tests/unit/naoqi/golden.hpp"

namespace gazed::wire_test {
namespace {

TEST(QiWire, ACallIsWhatTheOfficialClientSends) {
  QiWriter arguments;
  write_dynamic_list(arguments, std::vector<std::string_view>{"HeadYaw", "HeadPitch"});
  arguments.integer(1, 1);
  QiHeader header;
  header.id = 10;
  header.payload_bytes = static_cast<std::uint32_t>(arguments.bytes().size());
  header.service = 2;
  header.object = 1;
  header.action = 100;
  QiWriter message;
  message.header(header).raw(arguments.bytes());
  EXPECT_TRUE(std::ranges::equal(message.bytes(), from_hex(golden_get_angles_call)));
}

TEST(QiWire, AHeaderIsReadAsItWasWritten) {
  const auto bytes = from_hex(golden_get_angles_call);
  const auto header = read_header(QiBytes(bytes).first(qi_header_bytes));
  ASSERT_TRUE(header);
  EXPECT_EQ(header->id, 10U);
  EXPECT_EQ(header->payload_bytes, bytes.size() - qi_header_bytes);
  EXPECT_EQ(header->type, QiType::call);
  EXPECT_EQ(header->flags, 0);
  EXPECT_EQ(header->service, 2U);
  EXPECT_EQ(header->object, 1U);
  EXPECT_EQ(header->action, 100U);
}

TEST(QiWire, WhatIsNoHeaderIsRefused) {
  auto bytes = from_hex(golden_get_angles_call);
  bytes.resize(qi_header_bytes);
  EXPECT_FALSE(read_header(QiBytes(bytes).first(qi_header_bytes - 1)));
  bytes[0] = 0;
  EXPECT_FALSE(read_header(bytes));
}

TEST(QiWire, APayloadOverTheLimitIsRefused) {
  QiHeader header;
  header.payload_bytes = qi_payload_max;
  QiWriter largest;
  largest.header(header);
  EXPECT_TRUE(read_header(largest.bytes()));
  ++header.payload_bytes;
  QiWriter too_large;
  too_large.header(header);
  EXPECT_FALSE(read_header(too_large.bytes()));
}

TEST(QiWire, ReadingPastTheEndGivesNothingFromThenOn) {
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5};
  QiReader reader{QiBytes(bytes)};
  EXPECT_EQ(reader.u32(), 0x04030201U);
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.integer(2), 0U);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.integer(1), 0U);
}

void fill(QiInbox& inbox, QiBytes bytes) {
  const auto room = inbox.room();
  ASSERT_GE(room.size(), bytes.size());
  std::ranges::copy(bytes, room.begin());
  inbox.received(bytes.size());
}

TEST(QiInbox, MessagesComeOutHoweverTheyAreCut) {
  const auto one = from_hex(golden_get_angles_call);
  std::vector<std::uint8_t> stream;
  for (int i = 0; i < 5; ++i) stream.insert(stream.end(), one.begin(), one.end());
  for (const std::size_t piece : {1, 3, 27, 28, 29, 100, 1000}) {
    QiInbox dut;
    int messages = 0;
    for (QiBytes rest(stream); !rest.empty(); rest = rest.subspan(std::min(piece, rest.size()))) {
      fill(dut, rest.first(std::min(piece, rest.size())));
      while (const auto message = dut.next()) {
        ++messages;
        EXPECT_TRUE(std::ranges::equal(message->payload, QiBytes(one).subspan(qi_header_bytes)));
      }
    }
    EXPECT_EQ(messages, 5) << "in pieces of " << piece;
    EXPECT_FALSE(dut.broken());
  }
}

TEST(QiInbox, AMessageLargerThanItsRoomIsWaitedFor) {
  QiHeader header;
  header.payload_bytes = qi_payload_max;
  QiWriter begin;
  begin.header(header);
  QiInbox dut;
  fill(dut, begin.bytes());
  EXPECT_FALSE(dut.next());
  EXPECT_GE(dut.room().size(), qi_payload_max);
  dut.received(qi_payload_max - 1);
  EXPECT_FALSE(dut.next());
  EXPECT_FALSE(dut.room().empty());
  dut.received(1);
  ASSERT_TRUE(dut.has_message());
  EXPECT_EQ(dut.next()->payload.size(), qi_payload_max);
}

TEST(QiInbox, WhatIsNoMessageBreaksItUntilItIsCleared) {
  auto bytes = from_hex(golden_get_angles_call);
  QiInbox dut;
  bytes[2] = 0;
  fill(dut, bytes);
  EXPECT_FALSE(dut.next());
  EXPECT_TRUE(dut.broken());
  dut.clear();
  fill(dut, from_hex(golden_get_angles_call));
  EXPECT_TRUE(dut.next());
}

}  // namespace
}  // namespace gazed::wire_test
