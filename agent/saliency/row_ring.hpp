// Decimates an image row by row: which input rows make which output row, and a ring with the last
// five input rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

[[nodiscard]] constexpr int halved(int length) {
  return (length + 1) / 2;
}

[[nodiscard]] constexpr int length_at_level(int length, int level) {
  for (int k = 0; k < level; ++k) length = halved(length);
  return length;
}

/// Reflects an index into [0, length), like cv::BORDER_REFLECT_101.
[[nodiscard]] constexpr int reflect_101(int index, int length) {
  if (length == 1) return 0;
  while (index < 0 || index >= length) index = index < 0 ? -index : 2 * (length - 1) - index;
  return index;
}

template <typename Sample>
using FiveRows = std::array<const Sample*, 5>;

/// The last five rows of an image, and the output rows that they complete.
template <typename Sample>
class RowRing {
 public:
  /// For images of `height` rows of `width` samples.
  RowRing(int width, int height)
      : stride_(padded_to_lanes(width)),
        height_(height),
        samples_(static_cast<std::size_t>(ring_rows) * static_cast<std::size_t>(stride_)) {}

  /// Where to write the image's next row.
  [[nodiscard]] Sample* next_row() { return slot(next_slot_); }

  /// Takes the row written there. Calls emit(FiveRows), in order, for each output row that is now
  /// complete. After the image's last row, the ring is ready for the next image.
  template <typename Emit>
  void advance(Emit&& emit) {
    ++taken_;
    next_slot_ = next_slot_ + 1 == ring_rows ? 0 : next_slot_ + 1;
    while (2 * given_ < height_ && std::min(2 * given_ + 2, height_ - 1) < taken_) {
      emit(2 * given_ + 2 < height_ && given_ > 0 ? last_five() : reflected_five());
      ++given_;
    }
    if (taken_ == height_) taken_ = given_ = next_slot_ = 0;
  }

 private:
  static constexpr int ring_rows = 5;
  Sample* slot(int i) { return samples_.data() + static_cast<std::ptrdiff_t>(i) * stride_; }

  /// Inside the image, the row just taken is the last of the five, and the oldest follows it in the
  /// ring.
  FiveRows<Sample> last_five() {
    FiveRows<Sample> rows;
    int from = next_slot_;
    for (const Sample*& row : rows) {
      row = slot(from);
      from = from + 1 == ring_rows ? 0 : from + 1;
    }
    return rows;
  }
  FiveRows<Sample> reflected_five() {
    FiveRows<Sample> rows;
    int y = 2 * given_ - 2;
    for (const Sample*& row : rows) row = slot(reflect_101(y++, height_) % ring_rows);
    return rows;
  }

  int stride_;
  int height_;
  int taken_ = 0;
  int given_ = 0;
  int next_slot_ = 0;  // taken_ modulo ring_rows
  AlignedSamples<Sample> samples_;
};

}  // namespace gazed::saliency
