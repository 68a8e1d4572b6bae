// Tracks one corner from view 1 to view 2: half size, full size, and back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/flow.hpp"
#include "agent/tracking/luma.hpp"

namespace gazed::tracking {

/// A corner in view 2.
struct TrackedCorner {
  geometry::Pixel pixel_2 = geometry::Pixel::Zero();
  double variance_px2 = 0.0;  // per axis
  float misfit = 0.0F;        // variance of the difference between the patches, grey levels squared
  float steepness = 0.0F;     // mean square of the patch's slopes, (grey levels per px)^2
};

/// Owns its working buffers.
class CornerTracker {
 public:
  /// Finds the patch around pixel_1 near one of `starts` (pixels of view 2, good to about 4 px).
  /// `shape` is d pixel_2 / d pixel_1. Returns nothing if no place matches, if two places do, or if
  /// tracking back does not return to pixel_1.
  [[nodiscard]] std::optional<TrackedCorner> track(const LumaPyramid& view_1,
                                                   const LumaPyramid& view_2,
                                                   const geometry::Pixel& pixel_1,
                                                   const Eigen::Matrix2d& shape,
                                                   std::span<const geometry::Pixel> starts);

 private:
  [[nodiscard]] std::optional<geometry::Pixel> best_at_half_size(
      const LumaLevel& view_1, const LumaLevel& view_2, const geometry::Pixel& pixel_1,
      const Eigen::Matrix2f& back, std::span<const geometry::Pixel> starts);

  FlowTemplate<8> half_size_;
  FlowTemplate<12> full_size_;
};

}  // namespace gazed::tracking
