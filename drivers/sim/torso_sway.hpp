// The swaying torso of a standing robot.
#pragma once

#include <array>
#include <cstdint>

#include "agent/geometry/pose.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed::sim {

class TorsoSway {
 public:
  TorsoSway(const Sway& sway, std::uint64_t seed);

  [[nodiscard]] bool sways() const { return sway_.sways(); }
  /// Where the torso is in the room, whose frame is that of the torso at rest, this long after the
  /// robot's start.
  [[nodiscard]] geometry::Pose room_from_torso(double time_s) const;

 private:
  static constexpr std::array<double, 3> frequency_shares{0.62, 1.0, 1.41};
  static constexpr std::size_t components = 6;  // x, y, z, about x, y, z

  /// Varies as much as a sine does.
  [[nodiscard]] double component(std::size_t index, double time_s) const;

  Sway sway_;
  std::array<std::array<double, frequency_shares.size()>, components> phases_rad_{};
};

}  // namespace gazed::sim
