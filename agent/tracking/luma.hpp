// A frame's luma at full size and reduced by 2 and 4, in integers.
//
// Samples are Q12.4: a grey level is 16, white 4080, so that sixteen of them still fit in 16 bits
// and every filter below is exact up to its one rounding. A level is half as large as floats.
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
  static constexpr int padding = 8;  // samples after the last one that may be read: vector loads

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

/// Three levels of a frame; all memory is taken at construction.
class LumaPyramid {
 public:
  static constexpr int level_count = 3;

  LumaPyramid(int width_px, int height_px);

  /// The image has the size given at construction. Level 0 is smoothed by [1 2 1]/4, so that
  /// reading between its samples does not depend on where between; each further level by
  /// [1 4 6 4 1]/16. Border samples are repeated.
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
