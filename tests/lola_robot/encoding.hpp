// The packets of a V6's LoLA, from the robot's side. Written from the descriptions of the packets
// and the MessagePack specification, and on purpose with nothing of gazed's.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <variant>

namespace lola_robot {

inline constexpr std::size_t joints = 25;
inline constexpr std::size_t yaw = 0, pitch = 1;
using Joints = std::array<float, joints>;

struct Sensors {
  Joints position{}, stiffness{}, temperature{}, current{};
  std::array<unsigned, joints> status{};
  std::array<float, 2> torso{};  // roll, pitch
};

/// 896 bytes with all 13 keys; in an order drawn from `shuffle`, or in the usual one when there is
/// none.
[[nodiscard]] std::string state_packet(const Sensors& sensors, std::mt19937_64* shuffle = nullptr);

struct Order {
  Joints position{}, stiffness{};
};

inline constexpr std::size_t order_bytes = 276;

/// The order, or what is wrong with its encoding: a real LoLA ends over that.
[[nodiscard]] std::variant<Order, std::string> read_order(std::string_view packet);

}  // namespace lola_robot
