#include "drivers/lola/packet_stream.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <span>
#include <string>

#include "tests/unit/trials.hpp"

namespace gazed::lola::packet_stream_test {
namespace {

std::string numbered_packet(int number) {
  std::string packet(state_packet_bytes, '\0');
  for (std::size_t i = 0; i < packet.size(); ++i)
    packet[i] = static_cast<char>(static_cast<int>(i) + 7 * number);
  return packet;
}

TEST(PacketStream, JoinsWhatComesInAnyPieces) {
  std::mt19937_64 random(1);
  constexpr int packets = 20;
  std::string bytes;
  for (int i = 0; i < packets; ++i) bytes += numbered_packet(i);
  for (int trial = 0; trial < test::trials(500, 20); ++trial) {
    PacketStream stream;
    int found = 0;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::span<char> room = stream.room();
      ASSERT_FALSE(room.empty());
      const std::size_t piece =
          std::min({room.size(), bytes.size() - at, 1 + static_cast<std::size_t>(random() % 1200)});
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), piece, room.begin());
      stream.received(piece);
      at += piece;
      if (!stream.complete()) continue;
      const StatePacket packet = stream.packet();
      ASSERT_EQ(std::string(packet.begin(), packet.end()), numbered_packet(found++));
    }
    ASSERT_EQ(found, packets);
  }
}

TEST(PacketStream, ForgetsAnUnfinishedPacketWhenItBeginsAnew) {
  PacketStream stream;
  stream.room()[0] = 'x';
  stream.received(1);
  stream.restart();
  EXPECT_EQ(stream.room().size(), state_packet_bytes);
  EXPECT_FALSE(stream.complete());
}

}  // namespace
}  // namespace gazed::lola::packet_stream_test
