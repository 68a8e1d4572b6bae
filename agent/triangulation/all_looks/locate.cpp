#include "agent/triangulation/all_looks/locate.hpp"

#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/triangulation/all_looks/estimation.hpp"

namespace gazed::triangulation::all_looks {

Estimate locate(const geometry::Rig& rig, std::span<const Look> looks,
                std::span<const FeatureObservations> features, const Gate& gate,
                const NextLook& next_look) {
  if (looks.size() < looks_min || looks.size() > looks_max) {
    throw std::invalid_argument(
        base::text("%zu looks; %zu to %zu can be used", looks.size(), looks_min, looks_max));
  }
  if (features.size() > features_max) {
    throw std::invalid_argument(
        base::text("%zu features; at most %zu can be used", features.size(), features_max));
  }
  Estimation estimation(rig, looks, gate);
  Estimate out = estimation.estimate(features);
  if (!next_look) return out;
  const auto next = next_look(out);
  if (next && out.looks_used > 0 && looks.size() < looks_max) {
    out.expected_sigma_per_m = estimation.expected_sigma_per_m(*next, features);
  }
  return out;
}

}  // namespace gazed::triangulation::all_looks
