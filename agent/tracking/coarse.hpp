// Where a small patch may be in a reduced view, by normalised correlation at every place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "agent/tracking/luma.hpp"

namespace gazed::tracking {

/// Samples per side of a patch.
inline constexpr int coarse_side = 8;
inline constexpr float coarse_centre = 0.5F * (coarse_side - 1);  // from its first sample
inline constexpr std::size_t coarse_area = static_cast<std::size_t>(coarse_side * coarse_side);

/// A patch to look for: mean removed, sum of squares 1.
struct CoarsePatch {
  std::array<float, coarse_area> value;
};

/// Scales to a mean of 0 and a sum of squares of 1. False for a patch with so little contrast that
/// camera noise may have made it.
[[nodiscard]] bool normalise(CoarsePatch& patch);

/// A view's level, prepared for the search. A place is the sample of the level on which a patch's
/// first sample lies.
class CoarseView {
 public:
  CoarseView(int width, int height);

  void set(const LumaLevel& level);

  [[nodiscard]] int places_x() const { return width_ - coarse_side + 1; }
  [[nodiscard]] int places_y() const { return height_ - coarse_side + 1; }

  /// Squares of the normalised correlation, with its sign, at `count` places of row y from x on.
  /// Places outside the view give 0.
  void correlate(const CoarsePatch& patch, int x, int y, int count, float* out) const;

 private:
  int width_, height_;
  std::vector<float> samples_;         // grey levels
  std::vector<float> inverse_energy_;  // of the patch that begins there, mean removed
  std::vector<std::int32_t> sums_, squares_;
};

}  // namespace gazed::tracking
