#include "drivers/lola/order_packet.hpp"

#include <gtest/gtest.h>
#include <string>

namespace gazed::lola::order_packet_test {
namespace {

// python3-msgpack 1.1: packb({"Position": [(i - 12) / 8 ...], "Stiffness": [i / 32 ...]},
// use_single_float=True), i from 0 to 24: the numbers are floats without rounding.
const std::string golden =
    "82a8506f736974696f6edc0019cabfc00000cabfb00000cabfa00000cabf900000cabf800000"
    "cabf600000cabf400000cabf200000cabf000000cabec00000cabe800000cabe000000ca0000"
    "0000ca3e000000ca3e800000ca3ec00000ca3f000000ca3f200000ca3f400000ca3f600000ca"
    "3f800000ca3f900000ca3fa00000ca3fb00000ca3fc00000a953746966666e657373dc0019ca"
    "00000000ca3d000000ca3d800000ca3dc00000ca3e000000ca3e200000ca3e400000ca3e6000"
    "00ca3e800000ca3e900000ca3ea00000ca3eb00000ca3ec00000ca3ed00000ca3ee00000ca3e"
    "f00000ca3f000000ca3f080000ca3f100000ca3f180000ca3f200000ca3f280000ca3f300000"
    "ca3f380000ca3f400000";

TEST(OrderPacket, IsTheseBytes) {
  LolaOrder order;
  for (std::size_t i = 0; i < joint_count; ++i) {
    order.position_rad[i] = (static_cast<float>(i) - 12.0F) / 8.0F;
    order.stiffness[i] = static_cast<float>(i) / 32.0F;
  }
  std::string hex;
  for (const char byte : order_packet(order)) {
    constexpr char digits[] = "0123456789abcdef";
    hex += digits[static_cast<unsigned char>(byte) >> 4];
    hex += digits[static_cast<unsigned char>(byte) & 0xf];
  }
  EXPECT_EQ(hex, golden);
}

}  // namespace
}  // namespace gazed::lola::order_packet_test
