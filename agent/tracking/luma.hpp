// A frame's luma at full size and reduced by 2 and 4, in integers.
//
// Samples are Q12.4: one grey level is 16 and white is 4080, so sixteen of them fit in 16 bits and
// every filter below is exact up to a single rounding. A level takes half the memory of floats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"

namespace gazed::tracking {

/// Q12.4.
inline constexpr float luma_one = 16.0F;

/// Sample (column, row) is centred on pixel step_px (column, row).
struct LumaLevel {
  static constexpr int padding = 8;  // readable samples after the last one, for vector loads

  int step_px = 1;
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> samples;

  void resize(int new_width, int new_height, int new_step_px);
  [[nodiscard]] const std::uint16_t* row(int y) const {
    return samples.data() + static_cast<std::ptrdiff_t>(width) * y;
  }
  [[nodiscard]] std::uint16_t* row(int y) {
    return samples.data() + static_cast<std::ptrdiff_t>(width) * y;
  }
};

/// Three levels of a frame; all memory is allocated at construction.
class LumaPyramid {
 public:
  static constexpr int level_count = 3;

  LumaPyramid(int width_px, int height_px);

  /// `image` must have the size given at construction. Level 0 is smoothed by [1 2 1]/4, so that
  /// the blur of interpolation does not depend on the fraction; each further level by [1 4 6 4
  /// 1]/16. Border samples are repeated.
  void build(const base::ImageView& image);

  [[nodiscard]] const LumaLevel& level(int index) const {
    return levels_[static_cast<std::size_t>(index)];
  }

 private:
  void smooth(const base::ImageView& image);
  void reduce(const LumaLevel& fine, LumaLevel& coarse);

  std::array<LumaLevel, level_count> levels_;
  std::array<std::vector<std::uint16_t>, 3> rows_;
  std::vector<std::uint16_t> sums_;
};

}  // namespace gazed::tracking
