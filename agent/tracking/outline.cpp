#include "agent/tracking/outline.hpp"

#include <cmath>
#include <numbers>

namespace gazed::tracking {

Outline outline_of(const ObjectMask& object, const geometry::Pixel& inside, double radius_px) {
  Outline out;
  for (std::size_t i = 0; i < Outline::points_max; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(Outline::points_max);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    for (int away_px = static_cast<int>(std::ceil(radius_px)); away_px >= 0; --away_px) {
      const Eigen::Vector2d place = inside + away_px * direction;
      const auto x = static_cast<int>(std::lround(place.x())),
                 y = static_cast<int>(std::lround(place.y()));
      if (object.distance_px(x, y) > 0.0F) continue;
      out.points_px[out.count++] = place.cast<float>();
      break;
    }
  }
  return out;
}

}  // namespace gazed::tracking
