// Planes as landscapes, and up to what height the border of the picture reaches into them.
//
// A plane is a relief; turned upside down it is another one, whose hills were hollows. Up to eight
// reliefs of one size are looked at together, one in each lane of an I16x8: a sample is eight
// heights, in units of 1/interval_heights of the interval between two thresholds.
//
// The reach of a sample is the largest, over all ways from the border, of the lowest height on the
// way (greyscale reconstruction; Vincent, "Morphological grayscale reconstruction in image
// analysis", IEEE Trans. Image Processing 2(2), 1993). Cut at a threshold between its reach and its
// height, the relief has the sample on an island that the border does not touch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

/// Heights from one threshold to the next.
inline constexpr std::int16_t interval_heights = 1024;

class Reliefs {
 public:
  static constexpr int most_planes = lane_count / 2;
  static constexpr int most_intervals = 15;  // heights stay below 2^14

  /// For planes of this size.
  Reliefs(int width, int height);

  void clear();
  /// A plane whose samples are lowest to highest, which differ by less than 2^15, as heights from 0
  /// to `intervals` intervals. It is borrowed.
  void add(const ConstPlane& plane, std::int16_t lowest, std::int16_t highest, int intervals);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int count() const { return count_; }
  /// Row y, `width` samples of lane_count heights: plane i in lane i, upside down in lane i + 4; 0
  /// where there is none. Borrowed until the next call.
  [[nodiscard]] const std::int16_t* row(int y);

 private:
  struct Scale {
    ConstPlane plane;
    std::int16_t lowest = 0;
    int shift = 0;             // to the left, so that the range has 15 bits
    std::int16_t factor = 0;   // Q15, of what was shifted
    std::int16_t highest = 0;  // as a height
  };

  int width_;
  int height_;
  int count_ = 0;
  std::array<Scale, most_planes> scales_;
  AlignedSamples<std::int16_t> nothing_;  // a row of 0
  AlignedSamples<std::int16_t> row_;
};

class Reach {
 public:
  /// For reliefs of this size.
  Reach(int width, int height);

  void find(Reliefs& reliefs);
  /// Of the last find(); row y as that of the reliefs.
  [[nodiscard]] const std::int16_t* row(int y) const;

 private:
  /// A row has risen since the row below, or above, looked at it.
  struct Fresh {
    bool downwards = true, upwards = true;
  };

  [[nodiscard]] std::int16_t* reach_row(int y);
  void start_at_border(Reliefs& reliefs);
  bool spread(int from, int to, Reliefs& reliefs);
  bool spread_right(const std::int16_t* heights, const std::int16_t* beside,
                    std::int16_t* reach) const;
  void spread_left(const std::int16_t* heights, std::int16_t* reach) const;

  int width_;
  int height_;
  AlignedSamples<std::int16_t> reach_;
  std::vector<Fresh> fresh_;
};

}  // namespace gazed::saliency
