// Gaussian pyramids: [1 4 6 4 1]/16 in both directions and every second sample, borders reflected
// without repeating the last sample, sizes (n + 1)/2. That is cv::pyrDown (Burt and Adelson, "The
// Laplacian pyramid as a compact image code", IEEE Trans. Comm. 31(4), 1983, with a = 3/8).
//
// From level 2 on, a step is exact until its one rounding at the end: rows first, in 32 bits, then
// columns over the last five filtered rows, which a `RowRing` keeps. Levels 0 and 1 have their own
// way (low_levels.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed {

inline constexpr int first_stored_level = 2;
inline constexpr int last_level = 8;
inline constexpr int map_level = 4;  // one sample of the map is 16 pixels of the frame

[[nodiscard]] constexpr int halved(int length) {
  return (length + 1) / 2;
}

[[nodiscard]] constexpr int length_at_level(int length, int level) {
  for (int k = 0; k < level; ++k) length = halved(length);
  return length;
}

/// The index inside [0, length) that stands for `index`, as cv::BORDER_REFLECT_101.
[[nodiscard]] constexpr int reflect_101(int index, int length) {
  if (length == 1) return 0;
  while (index < 0 || index >= length) index = index < 0 ? -index : 2 * (length - 1) - index;
  return index;
}

/// Filters and decimates one row to 16 times its halved(width) samples. Eight samples before and
/// after the row are read.
void decimate_row(const std::int16_t* in, int width, std::int32_t* out);

template <typename Sample>
using FiveRows = std::array<const Sample*, 5>;

/// Filters five such rows to one and takes both gains of 16 away, rounding once. All padded.
void decimate_columns(const FiveRows<std::int32_t>& rows, int width, std::int16_t* out);

/// The last five rows of an image, and which output rows they suffice for.
template <typename Sample>
class RowRing {
 public:
  /// For images of `height` rows of `width` samples.
  RowRing(int width, int height)
      : stride_(padded_to_lanes(width)),
        height_(height),
        samples_(static_cast<std::size_t>(ring_rows) * static_cast<std::size_t>(stride_)) {}

  /// Where the image's next row goes.
  [[nodiscard]] Sample* next_row() { return row(taken_); }

  /// Takes the row that was written there. Calls emit(FiveRows) for each output row, in order, that
  /// it completes; after the image's last row the ring is ready for the next image.
  template <typename Emit>
  void advance(Emit&& emit) {
    ++taken_;
    while (given_ < halved(height_) && std::min(2 * given_ + 2, height_ - 1) < taken_) {
      FiveRows<Sample> rows;
      for (int k = 0; k < ring_rows; ++k)
        rows[static_cast<std::size_t>(k)] = row(reflect_101(2 * given_ + k - 2, height_));
      emit(rows);
      ++given_;
    }
    if (taken_ == height_) taken_ = given_ = 0;
  }

 private:
  static constexpr int ring_rows = 5;
  Sample* row(int y) {
    return samples_.data() + static_cast<std::ptrdiff_t>(y % ring_rows) * stride_;
  }

  int stride_;
  int height_;
  int taken_ = 0;
  int given_ = 0;
  AlignedSamples<Sample> samples_;
};

/// One plane's levels 2 to 8.
class Pyramid {
 public:
  Pyramid(int frame_width, int frame_height);

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

}  // namespace gazed
