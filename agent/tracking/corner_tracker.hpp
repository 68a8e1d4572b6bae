// One corner from view 1 to view 2: half size, full size, and back.
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
  float misfit = 0.0F;        // between the patches, variance in grey levels
  float steepness = 0.0F;     // of the patch, mean square of the slopes, (grey levels per px)^2
};

/// Keeps its working buffers.
class CornerTracker {
 public:
  /// Finds the patch around pixel_1 near one of `starts` (pixels of view 2, good to about 4 px).
  /// `shape` is d pixel_2 / d pixel_1. None when nothing there is like it, when two places are, or
  /// when following back does not lead to pixel_1.
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
