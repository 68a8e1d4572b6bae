// From a camera frame to level 2 of the intensity, red-green and blue-yellow pyramids.
//
// The frame is read once, a row at a time; levels 0 and 1 never exist whole: each is the five rows
// that the filter needs. Three planes run side by side, as three parts of one row.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/image.hpp"
#include "agent/saliency/opponents.hpp"
#include "agent/saliency/pyramid.hpp"

namespace gazed {

inline constexpr int plane_count = 3;

/// Level 2 of the three pyramids.
struct LevelTwo {
  Plane intensity;
  Plane red_green;
  Plane blue_yellow;

  [[nodiscard]] OpponentRows row(int y) const {
    return {intensity.row(y), red_green.row(y), blue_yellow.row(y)};
  }
};

/// Report profile: opponents per pixel, low-passed in 16 bits signed.
class PixelOpponents {
 public:
  PixelOpponents(int width_px, int height_px, bool clamp_negative);
  void read(const ImageView& frame, const LevelTwo& out);

 private:
  const std::uint8_t* rgb_row(const ImageView& frame, int y);

  int width_px_;
  bool clamp_negative_;
  std::vector<std::uint8_t> rgb_;     // a row of a frame that is not rgb24
  std::vector<std::int16_t> level0_;  // a row of three planes, likewise below
  std::vector<std::int16_t> level1_;
  std::vector<std::int16_t> level2_;
  RowRing<std::int16_t> to_level1_;
  RowRing<std::int16_t> to_level2_;
};

/// Robust profile: the camera's own planes low-passed in 16 bits unsigned, opponents at level 2
/// ("late colour").
class LateOpponents {
 public:
  LateOpponents(int width_px, int height_px);
  void read(const ImageView& frame, const LevelTwo& out);

 private:
  void filter_frame_row(const ImageView& frame, int y);

  int width_px_;
  std::vector<std::uint16_t> level1_;
  std::vector<std::uint16_t> level2_;
  RowRing<std::uint16_t> to_level1_;
  RowRing<std::uint16_t> to_level2_;
};

}  // namespace gazed
