// Any 896 bytes as a state packet of LoLA's.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/lola/state_check.hpp"
#include "drivers/lola/state_packet.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static gazed::lola::StatePacketParser
      parser;  // as in the driver: what one packet leaves, the next meets
  std::array<char, gazed::lola::state_packet_bytes> packet{};
  std::copy_n(data, std::min(size, packet.size()), packet.begin());
  const auto state = parser.parse(packet);
  if (!state) return 0;
  if (!gazed::lola::implausible(*state).empty()) return 0;
  const double tilt_rad = gazed::lola::torso_tilt_rad(*state);
  if (!(tilt_rad >= 0.0 && tilt_rad < 3.15)) std::abort();
  static_cast<void>(gazed::lola::out_of_place(*state, {state->stiffness, state->position_rad}));
  static_cast<void>(gazed::lola::changed_since(gazed::lola::LolaState{}, *state));
  return 0;
}
