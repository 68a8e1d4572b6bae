// Gaussian pyramids: [1 4 6 4 1]/16 in both directions and every second sample, borders reflected
// without repeating the last sample, sizes (n + 1)/2. That is cv::pyrDown (Burt and Adelson, "The
// Laplacian pyramid as a compact image code", IEEE Trans. Comm. 31(4), 1983, with a = 3/8).
//
// A step is done in two passes: rows first, then columns over the last five filtered rows, which a
// `RowRing` keeps. So an image can be decimated while it streams by, without being stored.
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

/// Filters and decimates one row of `width` samples, `stride` apart, to halved(width).
template <int shift, int stride = 1, typename In, typename Out>
void decimate_row(const In* in, int width, Out* out) {
  const auto at = [in](int i) { return static_cast<std::int32_t>(in[stride * i]); };
  const auto edge = [&](int i) {
    const auto reflected = [&](int k) { return at(reflect_101(2 * i + k, width)); };
    const std::int32_t sum =
        reflected(-2) + 4 * (reflected(-1) + reflected(1)) + 6 * reflected(0) + reflected(2);
    out[i] = static_cast<Out>(rounding_shift<shift>(sum));
  };
  const int inside_end = width < 5 ? 1 : (width - 1) / 2;  // first whose 2i + 2 is outside
  edge(0);
  for (int i = 1; i < inside_end; ++i) {
    const int c = 2 * i;
    const std::int32_t sum = at(c - 2) + 4 * (at(c - 1) + at(c + 1)) + 6 * at(c) + at(c + 2);
    out[i] = static_cast<Out>(rounding_shift<shift>(sum));
  }
  for (int i = inside_end; i < halved(width); ++i) edge(i);
}

template <typename Sum>
using FiveRows = std::array<const Sum*, 5>;

/// Filters five rows of `width` samples to one.
template <int shift, typename Sum, typename Out>
void decimate_columns(const FiveRows<Sum>& rows, int width, Out* out) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t sum =
        std::int32_t{rows[0][x]} + 4 * (rows[1][x] + rows[3][x]) + 6 * rows[2][x] + rows[4][x];
    out[x] = static_cast<Out>(rounding_shift<shift>(sum));
  }
}

/// The last five filtered rows of an image, and which output rows they suffice for.
template <typename Sum>
class RowRing {
 public:
  /// For images of `height` rows, each `width` samples after filtering.
  RowRing(int width, int height)
      : width_(width), height_(height), samples_(ring_rows * static_cast<std::size_t>(width)) {}

  /// Where the image's next filtered row goes.
  [[nodiscard]] Sum* next_row() { return row(taken_); }

  /// Takes the row that was written there. Calls emit(FiveRows) for each output row, in order, that
  /// it completes; after the image's last row the ring is ready for the next image.
  template <typename Emit>
  void advance(Emit&& emit) {
    ++taken_;
    while (given_ < halved(height_) && std::min(2 * given_ + 2, height_ - 1) < taken_) {
      FiveRows<Sum> rows;
      for (int k = 0; k < ring_rows; ++k)
        rows[static_cast<std::size_t>(k)] = row(reflect_101(2 * given_ + k - 2, height_));
      emit(rows);
      ++given_;
    }
    if (taken_ == height_) taken_ = given_ = 0;
  }

 private:
  static constexpr int ring_rows = 5;
  Sum* row(int y) { return samples_.data() + static_cast<std::ptrdiff_t>(y % ring_rows) * width_; }

  int width_;
  int height_;
  int taken_ = 0;
  int given_ = 0;
  std::vector<Sum> samples_;
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

  std::vector<std::int16_t> samples_;
  std::array<Plane, last_level - first_stored_level + 1> levels_;
  std::vector<RowRing<std::int32_t>> rings_;  // one for each level that is made here
};

}  // namespace gazed
