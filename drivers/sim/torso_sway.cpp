#include "drivers/sim/torso_sway.hpp"

#include <cmath>
#include <numbers>

#include "agent/base/random.hpp"
#include "agent/geometry/chain.hpp"

namespace gazed::sim {

namespace {

constexpr std::uint64_t sway_stream = 103;  // of the seed, beside those of joints and camera

}  // namespace

TorsoSway::TorsoSway(const Sway& sway, std::uint64_t seed) : sway_(sway) {
  base::Random random(seed, sway_stream);
  for (auto& of_component : phases_rad_)
    for (double& phase_rad : of_component) phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
}

double TorsoSway::component(std::size_t index, double time_s) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < frequency_shares.size(); ++i) {
    const double angular = 2.0 * std::numbers::pi * frequency_shares[i] * sway_.frequency_hz;
    sum += std::sin(angular * time_s + phases_rad_[index][i]);
  }
  return sum / std::numbers::sqrt3;  // variances add up
}

geometry::Pose TorsoSway::room_from_torso(double time_s) const {
  if (!sways()) return {};
  const auto amount = [&](std::size_t index, double amplitude) {
    return amplitude * component(index, time_s);
  };
  // Angles of milliradians: their order does not matter.
  return {geometry::about_z(amount(5, sway_.rotation_rad)) *
              geometry::about_y(amount(4, sway_.rotation_rad)) *
              geometry::about_x(amount(3, sway_.rotation_rad)),
          {amount(0, sway_.translation_m), amount(1, sway_.translation_m),
           amount(2, sway_.translation_m)}};
}

}  // namespace gazed::sim
