#include "agent/triangulation/all_looks/locate.hpp"

#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/triangulation/all_looks/estimation.hpp"

namespace gazed::triangulation::all_looks {

Estimate locate(const geometry::Rig& rig, std::span<const Look> looks,
                std::span<const FeatureObservations> features, const Gate& gate) {
  if (looks.size() < looks_min || looks.size() > looks_max) {
    throw std::invalid_argument(
        base::text("%zu looks; %zu to %zu can be used", looks.size(), looks_min, looks_max));
  }
  if (features.size() > features_max) {
    throw std::invalid_argument(
        base::text("%zu features; at most %zu can be used", features.size(), features_max));
  }
  return Estimation(rig, looks, gate).estimate(features);
}

}  // namespace gazed::triangulation::all_looks
