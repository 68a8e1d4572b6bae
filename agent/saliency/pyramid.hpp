// Gaussian pyramids: [1 4 6 4 1]/16 in both directions and every second sample, borders reflected
// without repeating the last sample, sizes (n + 1)/2. That is cv::pyrDown (Burt and Adelson, "The
// Laplacian pyramid as a compact image code", IEEE Trans. Comm. 31(4), 1983, with a = 3/8).
//
// From level 2 on, a step is exact until its one rounding at the end: rows first, in 32 bits, then
// columns over the last five filtered rows, which a `RowRing` keeps. Levels 0 and 1 have their own
// way (low_levels.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/row_ring.hpp"

namespace gazed::saliency {

inline constexpr int first_stored_level = 2;
inline constexpr int last_level = 8;
inline constexpr int map_level = 4;  // one sample of the map is 16 pixels of the frame

/// Filters and decimates one row to 16 times its halved(width) samples. Eight samples before and
/// after the row are read.
void decimate_row(const std::int16_t* in, int width, std::int32_t* out);

/// Filters five such rows to one and takes both gains of 16 away, rounding once. All padded.
void decimate_columns(const FiveRows<std::int32_t>& rows, int width, std::int16_t* out);

/// One plane's levels 2 to 8.
class Pyramid {
 public:
  Pyramid(int frame_width, int frame_height);
  Pyramid(const Pyramid&) = delete;  // levels_ point into samples_
  Pyramid& operator=(const Pyramid&) = delete;

  [[nodiscard]] Plane level(int k) const { return levels_[index(k)]; }

  /// Makes levels 3 and up from level 2.
  void build();

 private:
  static std::size_t index(int level) {
    return static_cast<std::size_t>(level - first_stored_level);
  }

  AlignedSamples<std::int16_t> samples_;
  std::array<Plane, last_level - first_stored_level + 1> levels_;
  std::vector<RowRing<std::int32_t>> rings_;  // one for each level that is made here
};

}  // namespace gazed::saliency
