#include "drivers/lcm/datagram.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gazed::lcm::datagram_test {
namespace {

using Packet = std::vector<std::uint8_t>;

Packet packet(std::string_view text) {
  return {text.begin(), text.end()};
}

/// A literal with NULs in it.
template <std::size_t size>
Packet bytes_of(const char (&literal)[size]) {
  return packet(std::string_view(literal, size - 1));
}

std::vector<Packet> datagrams(DatagramWriter& writer) {
  std::vector<Packet> out;
  for (auto one = writer.next(); !one.empty(); one = writer.next())
    out.emplace_back(one.begin(), one.end());
  return out;
}

bool refused(const Packet& bytes) {
  return std::holds_alternative<std::monostate>(parse_datagram(bytes));
}

TEST(Datagram, AShortOneIsChannelAndData) {
  const Packet bytes = bytes_of("LC02\0\0\0\5NAME\0abc");
  const Datagram read = parse_datagram(bytes);
  const auto& message = std::get<ShortMessage>(read);
  EXPECT_EQ(message.channel, "NAME");
  EXPECT_EQ(Packet(message.data.begin(), message.data.end()), packet("abc"));
}

TEST(Datagram, AMessageMayBeEmpty) {
  const Packet bytes = bytes_of("LC02\0\0\0\5NAME\0");
  EXPECT_TRUE(std::get<ShortMessage>(parse_datagram(bytes)).data.empty());
}

TEST(Datagram, AFragmentHasItsPlace) {
  const Packet bytes = bytes_of("LC03\0\0\0\5\0\0\1\0\0\0\0\3\0\1\0\2abc");
  const Datagram read = parse_datagram(bytes);
  const auto& fragment = std::get<Fragment>(read);
  EXPECT_EQ(fragment.sequence, 5U);
  EXPECT_EQ(fragment.message_bytes, 256U);
  EXPECT_EQ(fragment.offset, 3U);
  EXPECT_EQ(fragment.number, 1);
  EXPECT_EQ(fragment.count, 2);
  EXPECT_TRUE(fragment.channel.empty());
  EXPECT_EQ(fragment.data.size(), 3U);
}

TEST(Datagram, WhatIsNotLcmIsRefused) {
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused(packet("LC02")));
  EXPECT_TRUE(refused(packet("LC03")));
  EXPECT_TRUE(refused(bytes_of("LC04\0\0\0\5NAME\0abc")));
  EXPECT_TRUE(refused(bytes_of("LC02\0\0\0\5NAME")));   // the name has no end
  EXPECT_TRUE(refused(bytes_of("LC02\0\0\0\5\0abc")));  // nor a beginning
  EXPECT_TRUE(refused(bytes_of("LC03\0\0\0\5\0\0\1\0")));
}

TEST(Datagram, AChannelNameHas63BytesAtMost) {
  const auto with_name = [](std::size_t bytes) {
    return packet("LC02abcd" + std::string(bytes, 'N') + std::string(1, '\0') + "x");
  };
  EXPECT_FALSE(refused(with_name(63)));
  EXPECT_TRUE(refused(with_name(64)));
}

TEST(Datagram, AFragmentThatContradictsItselfIsRefused) {
  // size 256, offset 0xFFFFFFF0: their sum would wrap to 4
  EXPECT_TRUE(
      refused(bytes_of("LC03\0\0\0\5\0\0\1\0\xFF\xFF\xFF\xF0\0\1\0\3xxxxxxxxxxxxxxxxxxxx")));
  EXPECT_TRUE(refused(bytes_of("LC03\0\0\0\5\0\0\0\2\0\0\0\0\0\1\0\2abc")));   // past the end
  EXPECT_TRUE(refused(bytes_of("LC03\0\0\0\5\0\0\1\0\0\0\0\3\0\2\0\2abc")));   // the third of two
  EXPECT_TRUE(refused(bytes_of("LC03\0\0\0\5\0\0\1\0\0\0\0\3\0\0\0\0abc")));   // of none
  EXPECT_TRUE(refused(bytes_of("LC03\0\0\0\5\0\0\1\0\0\0\0\0\0\0\0\2NAME")));  // no end of the name
  EXPECT_TRUE(refused(bytes_of("LC03\0\0\0\5\0\0\1\0\0\0\0\3\0\1\0\2")));      // nothing in it
}

TEST(DatagramWriter, CutsAsLiblcmDoes) {
  DatagramWriter writer;
  const Packet message(200'000, 'm');
  ASSERT_TRUE(writer.begin("NAME", message));
  const auto out = datagrams(writer);
  // 65507 - 20 bytes of payload each; the first also holds the name and its NUL (lcm_udpm.c).
  ASSERT_EQ(out.size(), 4U);
  const Datagram first_read = parse_datagram(out[0]), second_read = parse_datagram(out[1]);
  const auto& first = std::get<Fragment>(first_read);
  const auto& second = std::get<Fragment>(second_read);
  EXPECT_EQ(first.channel, "NAME");
  EXPECT_EQ(first.count, 4);
  EXPECT_EQ(first.data.size(), 65487U - 5U);
  EXPECT_EQ(second.offset, first.data.size());
  EXPECT_EQ(second.sequence, first.sequence);
  EXPECT_EQ(second.data.size(), 65487U);
}

TEST(DatagramWriter, WhatFitsIsOnePiece) {
  DatagramWriter writer;
  for (const std::size_t bytes : {0U, 1U, 65494U}) {
    const Packet message(bytes, 'm');
    ASSERT_TRUE(writer.begin("NAME", message));
    const auto out = datagrams(writer);
    ASSERT_EQ(out.size(), 1U) << bytes;
    EXPECT_EQ(std::get<ShortMessage>(parse_datagram(out[0])).data.size(), bytes);
    EXPECT_LE(out[0].size(), datagram_bytes_max);
  }
  const Packet one_more(65495, 'm');
  ASSERT_TRUE(writer.begin("NAME", one_more));
  EXPECT_EQ(datagrams(writer).size(), 2U);
}

TEST(DatagramWriter, WhatCannotBeSentIsRefused) {
  DatagramWriter writer;
  EXPECT_FALSE(writer.begin("", {}));
  EXPECT_FALSE(writer.begin(std::string(64, 'N'), {}));
  EXPECT_TRUE(writer.next().empty());
}

// Whatever comes, the parts lie inside the datagram and inside the message.
TEST(Datagram, RandomBytesNeverReachBeyondTheDatagram) {
  std::mt19937 random(1);
  Packet bytes;
  for (int turn = 0; turn < 100'000; ++turn) {
    bytes = bytes_of("LC03\0\0\0\5\0\0\0\2\0\0\0\0\0\0\0\2NAME\0ab");
    bytes[3] = static_cast<std::uint8_t>('2' + random() % 2);
    for (int change = 0; change < 4; ++change)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(random() % (bytes.size() + 1));
    const Datagram read = parse_datagram(bytes);
    const auto inside = [&](const std::uint8_t* begin, std::size_t size) {
      return size == 0 || (begin >= bytes.data() && begin + size <= bytes.data() + bytes.size());
    };
    if (const auto* message = std::get_if<ShortMessage>(&read)) {
      ASSERT_TRUE(inside(message->data.data(), message->data.size()));
      ASSERT_LE(message->channel.size(), channel_bytes_max);
    } else if (const auto* fragment = std::get_if<Fragment>(&read)) {
      ASSERT_TRUE(inside(fragment->data.data(), fragment->data.size()));
      ASSERT_LE(std::uint64_t{fragment->offset} + fragment->data.size(), fragment->message_bytes);
      ASSERT_LT(fragment->number, fragment->count);
    }
  }
}

}  // namespace
}  // namespace gazed::lcm::datagram_test
