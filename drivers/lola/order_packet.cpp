#include "drivers/lola/order_packet.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace gazed::lola {

namespace {

// The MessagePack specification, "Formats".
constexpr unsigned fixmap = 0x80;
constexpr unsigned fixstr = 0xa0;
constexpr unsigned array16 = 0xdc;
constexpr unsigned float32 = 0xca;

class Writer {
 public:
  explicit Writer(OrderPacket& packet) : next_(packet.begin()) {}

  void map(unsigned pairs) { byte(fixmap | pairs); }
  void key(std::string_view text) {
    byte(fixstr | static_cast<unsigned>(text.size()));
    next_ = std::ranges::copy(text, next_).out;
  }
  void numbers(std::span<const float, joint_count> values) {
    byte(array16);
    big_endian(joint_count, 2);
    for (const float value : values) {
      byte(float32);
      big_endian(std::bit_cast<std::uint32_t>(value), 4);
    }
  }

 private:
  void byte(unsigned value) { *next_++ = static_cast<char>(value); }
  void big_endian(std::uint32_t value, unsigned bytes) {
    for (unsigned i = bytes; i-- > 0;) byte((value >> (8 * i)) & 0xff);
  }

  OrderPacket::iterator next_;
};

}  // namespace

OrderPacket order_packet(const LolaOrder& order) {
  OrderPacket packet;
  Writer writer(packet);
  writer.map(2);
  writer.key("Position");
  writer.numbers(order.position_rad);
  writer.key("Stiffness");
  writer.numbers(order.stiffness);
  return packet;
}

}  // namespace gazed::lola
