#include "drivers/lola/state_packet.hpp"

#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <string>

#include "tests/lola_robot/encoding.hpp"
#include "tests/unit/allocations.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::lola::state_packet_test {
namespace {

lola_robot::Sensors numbered_sensors() {
  lola_robot::Sensors sensors;
  for (std::size_t i = 0; i < joint_count; ++i) {
    const auto number = static_cast<float>(i);
    sensors.position[i] = 0.1F * number;
    sensors.stiffness[i] = 0.01F * number;
    sensors.temperature[i] = 30.0F + number;
    sensors.current[i] = 0.001F * number;
    sensors.status[i] = static_cast<unsigned>(i % 4);
  }
  sensors.torso = {0.1F, -0.2F};
  return sensors;
}

class StatePackets : public testing::Test {
 protected:
  std::optional<LolaState> parse(const std::string& packet) {
    std::string padded = packet;
    padded.resize(state_packet_bytes, '\0');
    return parser_.parse(StatePacket(padded.data(), state_packet_bytes));
  }
  /// The usual packet with one thing in it changed; both texts are of the same length.
  std::optional<LolaState> with(const std::string& from, const std::string& to) {
    std::string packet = usual_;
    const std::size_t place = packet.find(from);
    EXPECT_NE(place, std::string::npos);
    EXPECT_EQ(from.size(), to.size());
    packet.replace(place, from.size(), to);
    return parse(packet);
  }

  StatePacketParser parser_;
  const std::string usual_ = lola_robot::state_packet(numbered_sensors());
};

TEST_F(StatePackets, AreReadWhole) {
  ASSERT_EQ(usual_.size(), state_packet_bytes);
  const auto state = parse(usual_);
  ASSERT_TRUE(state);
  const lola_robot::Sensors sensors = numbered_sensors();
  EXPECT_EQ(state->position_rad, sensors.position);
  EXPECT_EQ(state->stiffness, sensors.stiffness);
  EXPECT_EQ(state->temperature_c, sensors.temperature);
  EXPECT_EQ(state->current_a, sensors.current);
  EXPECT_EQ(state->torso_rad, sensors.torso);
  for (std::size_t i = 0; i < joint_count; ++i) EXPECT_EQ(state->temperature_status[i], i % 4);
}

TEST_F(StatePackets, MayHaveTheirKeysInAnyOrder) {
  std::mt19937_64 random(3);
  const auto expected = parse(usual_);
  for (int i = 0; i < test::trials(2000, 50); ++i) {
    const auto state = parse(lola_robot::state_packet(numbered_sensors(), &random));
    ASSERT_TRUE(state);
    ASSERT_EQ(state->position_rad, expected->position_rad);
    ASSERT_EQ(state->temperature_status, expected->temperature_status);
  }
}

TEST_F(StatePackets, MayHoldAnythingUnderOtherKeys) {
  EXPECT_TRUE(with("Gyroscope", "Gyroskope"));
  EXPECT_TRUE(
      with("\xa5"
           "6.0.0",
           "\xa5"
           "7.0.0"));
  // Sonar, two floats in an array, as 9 bytes of anything.
  const std::string sonar = usual_.substr(usual_.find("Sonar"), 16);
  EXPECT_TRUE(with(sonar,
                   "Sonar\xc4\x09"
                   "123456789"));
}

TEST_F(StatePackets, LackingAKeyAreRefused) {
  for (const char* key : {"Position", "Stiffness", "Temperature", "Current", "Status", "Angles"}) {
    std::string other = key;
    other.back() = '?';
    EXPECT_FALSE(with(key, other)) << key;
  }
}

TEST_F(StatePackets, WithAKeyTwiceAreRefused) {
  std::string packet = usual_;
  const std::size_t gyroscope = packet.find("\xa9Gyroscope\x93");
  ASSERT_NE(gyroscope, std::string::npos);
  // "Gyroscope" and three floats are as long as "Angles", two floats and a short text.
  std::string twice =
      "\xa6"
      "Angles\x92";
  for (int i = 0; i < 2; ++i) twice += std::string("\xca\0\0\0\0", 5);
  packet.replace(gyroscope, 26, twice + "\xa1x" + "\xa5yyyyy");
  packet[0] = static_cast<char>(packet[0] + 1);  // a pair more
  EXPECT_FALSE(parse(packet));
}

TEST_F(StatePackets, WithAnArrayOfAnotherLengthAreRefused) {
  EXPECT_FALSE(with(std::string("Position\xdc\0\x19", 11), std::string("Position\xdc\0\x18", 11)));
  EXPECT_FALSE(with(std::string("Position\xdc\0\x19", 11), std::string("Position\xdc\0\x1a", 11)));
  EXPECT_FALSE(with("Angles\x92", "Angles\x90"));
}

TEST_F(StatePackets, WithNumbersOfAnotherTypeAreRefused) {
  EXPECT_FALSE(
      with(std::string("Position\xdc\0\x19\xca", 12), std::string("Position\xdc\0\x19\xce", 12)))
      << "an integer of 32 bits";
  EXPECT_FALSE(with(std::string("Status\xdc\0\x19\0", 10), std::string("Status\xdc\0\x19\xff", 10)))
      << "a negative one";
  EXPECT_FALSE(with("Angles\x92\xca", "Angles\xca\x92"));
}

TEST_F(StatePackets, ThatAreNoneSayWhatTheyHaveInstead) {
  const auto problem = [this](const std::optional<LolaState>& state) {
    EXPECT_FALSE(state);
    return parser_.problem();
  };
  EXPECT_EQ(problem(parse("{\"Position\": [0.1]}")),
            "it begins with the byte 0x7b, not with a map");
  EXPECT_EQ(problem(parse("\x81\xa1x\x01")), "a map of 4 bytes, LoLA's has 896");
  EXPECT_EQ(problem(with("Angles", "angles")), "a map without Angles");
  EXPECT_EQ(problem(with("Angles\x92", "Angles\x90")), "Angles has 0 values, LoLA's 2");
  EXPECT_EQ(
      problem(with(std::string("Status\xdc\0\x19\0", 10), std::string("Status\xdc\0\x19\xff", 10))),
      "Status is, or holds, a negative integer");
  std::string longer = usual_;
  longer[0] = static_cast<char>(longer[0] + 1);  // a pair more than there is
  EXPECT_EQ(problem(parse(longer)), "a map that does not end within 896 bytes");
}

TEST_F(StatePackets, CutAnywhereAreRefused) {
  // But in the very last text, of which any bytes are some.
  for (std::size_t length = 0; length < usual_.size() - 5; ++length)
    ASSERT_FALSE(parse(usual_.substr(0, length))) << length;
  EXPECT_TRUE(parse(usual_));
}

TEST_F(StatePackets, ThatAreOtherThingsAreRefused) {
  EXPECT_FALSE(parse(""));
  EXPECT_FALSE(parse("\xc0"));
  EXPECT_FALSE(parse(std::string(896, '\x91'))) << "arrays in arrays";
  EXPECT_FALSE(parse(std::string(896, '\x81'))) << "maps in maps";
  EXPECT_FALSE(parse("\xdf\xff\xff\xff\xff")) << "a map of 4294967295";
  EXPECT_FALSE(parse("\xc9\xff\xff\xff\xff\x01")) << "an extension of 4 GB";
  EXPECT_FALSE(parse("\xdb\xff\xff\xff\xff")) << "a text of 4 GB";
}

// Each byte changed in turn: refused or read, and nothing else.
TEST_F(StatePackets, OfWhichAnyByteIsWrongDoNoHarm) {
  std::mt19937_64 random(5);
  int read = 0;
  for (int i = 0; i < test::trials(100'000, 3'000); ++i) {
    std::string packet = usual_;
    for (std::uint64_t changes = 1 + random() % 3; changes-- > 0;)
      packet[random() % packet.size()] = static_cast<char>(random());
    read += parse(packet) ? 1 : 0;
  }
  EXPECT_GT(read, 0) << "most bytes are parts of numbers";
}

TEST_F(StatePackets, AreReadWithoutAllocating) {
  static_cast<void>(parser_.parse(StatePacket(usual_.data(), state_packet_bytes)));
  const std::string garbage(state_packet_bytes, '\xdc');
  const long before = test::allocations();
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(parser_.parse(StatePacket(usual_.data(), state_packet_bytes)));
    static_cast<void>(parser_.parse(StatePacket(garbage.data(), state_packet_bytes)));
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace gazed::lola::state_packet_test
