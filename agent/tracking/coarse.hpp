// Normalised correlation of a small patch with every place of a reduced view.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "agent/tracking/luma.hpp"

namespace gazed::tracking {

/// Samples per side of a patch.
inline constexpr int coarse_side = 8;
inline constexpr float coarse_centre = 0.5F * (coarse_side - 1);  // measured from the first sample
inline constexpr std::size_t coarse_area = static_cast<std::size_t>(coarse_side * coarse_side);

/// The template: mean 0, sum of squares 1.
struct CoarsePatch {
  std::array<float, coarse_area> value;
};

/// Scales to mean 0 and sum of squares 1. Returns false if the patch has so little contrast that it
/// may be camera noise.
[[nodiscard]] bool normalise(CoarsePatch& patch);

/// One level of a view, prepared for the search. A place is named by the sample of the level under
/// the patch's first sample.
class CoarseView {
 public:
  CoarseView(int width, int height);

  void set(const LumaLevel& level);

  [[nodiscard]] int places_x() const { return width_ - coarse_side + 1; }
  [[nodiscard]] int places_y() const { return height_ - coarse_side + 1; }

  /// Signed squares of the normalised correlation at `count` places of row y, starting at x. Places
  /// outside the view give 0.
  void correlate(const CoarsePatch& patch, int x, int y, int count, float* out) const;

 private:
  int width_, height_;
  std::vector<float> samples_;  // grey levels
  // of the patch that begins there, mean removed, for each sample
  std::vector<float> inverse_energy_;
  std::vector<std::int32_t> sums_, squares_;
};

}  // namespace gazed::tracking
