#include "agent/saliency/distinctness.hpp"

#include <algorithm>

namespace gazed {

float distinctness(const SaliencyPlane& map, const Winner& winner) {
  const double peak = map.row(winner.y)[winner.x];
  if (peak <= 0.0) return 0.0F;
  return 1.0F;
}

}  // namespace gazed
