#include "agent/tracking/highlight.hpp"

#include <algorithm>
#include <limits>

namespace gazed::tracking {

namespace {

// Share of the colour change across the outline that happens between the last cell inside and the
// first outside. It is 0.3 to 0.4 at an edge that the camera and the smoothing of cells blur a
// little, and a sixth on a slope.
constexpr float edge_share_max = 0.27F;
// A saturated channel no longer shows how much light was added.
constexpr float overflowing = 245.0F;
// Growth of the least growing channel over that of the most growing one: lamps are nearly white.
constexpr float white_share_min = 0.6F;
// A fainter highlight would not be taken for an object.
constexpr float light_min = 12.0F;

}  // namespace

void HighlightJudge::add(const Across& across) {
  inside_ += across.far_inside;
  near_ += across.near_inside - across.near_outside;
  far_ += across.far_inside - across.far_outside;
  count_ += 1.0F;
}

bool HighlightJudge::is_highlight() const {
  if (!(count_ > 0.0F) || near_.norm() > edge_share_max * far_.norm()) return false;
  float least = std::numeric_limits<float>::infinity(), most = 0.0F;
  for (int channel = 0; channel < 3; ++channel) {
    const float added = far_[channel] / count_;
    most = std::max(most, added);
    if (inside_[channel] < overflowing * count_ || added < 0.0F) least = std::min(least, added);
  }
  return most > light_min && least > white_share_min * most;
}

}  // namespace gazed::tracking
