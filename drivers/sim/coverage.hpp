// How much of a pixel a shape covers: the exact area of the unit square cut by a straight edge.
#pragma once

#include <algorithm>
#include <cmath>

namespace gazed::sim {

/// The share of a pixel on the inner side of an edge. `distance_px` from the pixel's centre to the
/// edge, positive inside; (normal_x, normal_y) is the edge's unit normal. The area is the
/// distribution function of the sum of two uniform variables of widths |normal_x| and |normal_y|.
[[nodiscard]] inline double half_plane_coverage(double distance_px, double normal_x,
                                                double normal_y) {
  const double wide = std::max(std::abs(normal_x), std::abs(normal_y));
  const double narrow = std::min(std::abs(normal_x), std::abs(normal_y));
  const double reach = 0.5 * (wide + narrow);
  const double distance = std::abs(distance_px);
  double outside = 0.0;  // the share beyond the edge, for a centre inside
  if (distance < reach) {
    if (distance <= 0.5 * (wide - narrow)) {
      outside = 0.5 - distance / wide;
    } else {
      const double corner = reach - distance;
      outside = corner * corner / (2.0 * wide * narrow);
    }
  }
  return distance_px >= 0.0 ? 1.0 - outside : outside;
}

}  // namespace gazed::sim
