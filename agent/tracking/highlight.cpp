#include "agent/tracking/highlight.hpp"

#include <algorithm>
#include <limits>

namespace gazed::tracking {

namespace {

// Of the change of colour across the outline, what happens from the last cell inside to the first
// outside: 0.3 to 0.4 at an edge that the camera blurs a little and cells are smoothed over, a
// sixth on a slope.
constexpr float edge_share_max = 0.27F;
// A channel that overflows tells no more how much light was added.
constexpr float overflowing = 245.0F;
// Of the channel that grows most, the one that grows least grows by this: lamps are nearly white.
constexpr float white_share_min = 0.6F;
// Less light is no highlight that anybody would take for an object.
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
