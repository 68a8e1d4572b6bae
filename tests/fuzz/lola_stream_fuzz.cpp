// Any bytes from LoLA's socket in any pieces: put together, read, and answered. What goes out must
// be an order within the limits, whatever came in.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <variant>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body_control.hpp"
#include "drivers/lola/order_packet.hpp"
#include "drivers/lola/packet_stream.hpp"
#include "drivers/lola/state_check.hpp"
#include "drivers/lola/state_packet.hpp"

#include "tests/lola_robot/encoding.hpp"

namespace {

void check(const gazed::lola::LolaOrder& order) {
  const gazed::lola::OrderPacket packet = gazed::lola::order_packet(order);
  const auto read = lola_robot::read_order({packet.data(), packet.size()});
  const auto* decoded = std::get_if<lola_robot::Order>(&read);
  if (decoded == nullptr) std::abort();
  const gazed::geometry::HeadAngles head{static_cast<double>(decoded->position[0]),
                                         static_cast<double>(decoded->position[1])};
  if (!gazed::geometry::HeadLimits().contains(head)) std::abort();
}

/// A state that is not answered is said again, so that few packets are enough to begin with.
void answer(gazed::lola::BodyControl& control, const gazed::lola::LolaState& state,
            std::int64_t& now_us) {
  for (int i = 0; i < gazed::lola::BodyControl::agreeing_states; ++i) {
    now_us += 12'000;
    if (const auto order = control.answer(state, now_us)) {
      check(*order);
      return;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static gazed::lola::StatePacketParser parser;
  gazed::lola::PacketStream stream;
  gazed::lola::BodyControl control(gazed::lola::OtherJoints::hold);
  control.command({0, {1.0, 0.2}, 0.5});
  std::int64_t now_us = 0;
  std::span<const std::uint8_t> rest(data, size);
  while (!rest.empty()) {
    std::span<const std::uint8_t> piece = rest.subspan(1).first(
        std::min<std::size_t>(rest.front(), rest.size() - 1));  // its length comes before it
    rest = rest.subspan(1 + piece.size());
    while (!piece.empty()) {
      const std::span<char> room = stream.room();
      const std::size_t bytes = std::min(room.size(), piece.size());
      std::copy_n(piece.begin(), bytes, room.begin());
      stream.received(bytes);
      piece = piece.subspan(bytes);
      if (!stream.complete()) continue;
      const auto state = parser.parse(stream.packet());
      if (!state) {
        stream.restart();
        control.interrupt();
      } else if (!gazed::lola::implausible(*state).empty()) {
        control.interrupt();
      } else {
        answer(control, *state, now_us);
      }
    }
  }
  return 0;
}
