// From a camera frame to level 2 of the intensity, red-green and blue-yellow pyramids.
//
// The frame is read once, row by row; levels 0 and 1 never exist whole. Both profiles filter down
// the columns first, twice, since there a row's samples may stand in any order: as the camera sends
// them (robust) or as phases, the order in which the report's opponents are made. Only the 120 rows
// that are left of 480 are filtered along the row (phases.hpp).
//
// Four passes, each of gain 16 and each rounded to the format of its input, but the last, which
// keeps three bits more; the first pass over bytes needs no rounding (fixed.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/saliency/columns.hpp"
#include "agent/saliency/opponents.hpp"
#include "agent/saliency/phases.hpp"
#include "agent/saliency/pyramid.hpp"

namespace gazed::saliency {

inline constexpr int plane_count = 3;

/// Level 2 of the three pyramids: intensity, red-green, blue-yellow.
using LevelTwo = std::array<Plane, plane_count>;

/// Report profile: opponents per pixel.
class PixelOpponents {
 public:
  PixelOpponents(int width_px, int height_px, bool clamp_negative);
  void read(const base::ImageView& frame, const LevelTwo& out);

 private:
  const std::uint8_t* rgb_row(const base::ImageView& frame, int y);
  void convert_row(const std::uint8_t* rgb, std::int16_t* out) const;
  void finish_row(const FiveRows<std::int16_t>& rows, const LevelTwo& out, int y);

  int width_px_;
  bool clamp_negative_;
  int phase_length_;
  std::vector<std::uint8_t> rgb_;  // a row of a frame that is not rgb24
  RowRing<std::int16_t> level0_;   // rows of four phases of three planes, likewise below
  RowRing<std::int16_t> level1_;
  std::vector<PhaseRow<4>> planes_;
  PhaseRow<2> half_;
};

/// Robust profile: the camera's own samples low-passed, opponents at level 2 ("late colour").
class LateOpponents {
 public:
  LateOpponents(int width_px, int height_px);
  void read(const base::ImageView& frame, const LevelTwo& out);

 private:
  const std::uint8_t* row_of(const base::ImageView& frame, int y);
  [[nodiscard]] ThreeRows smooth_rows() const;
  void finish_rgb_row(const LevelTwo& out, int y);
  void finish_yuyv_row(const LevelTwo& out, int y);

  int width_px_;
  int phase_length_;
  std::vector<std::uint8_t> rgb_;  // two rows of a grey frame
  ByteColumns columns_;
  RowRing<std::int16_t> level1_;
  AlignedSamples<std::int16_t> filtered_;  // down the columns twice, as the camera sends it
  std::vector<PhaseRow<4>> planes_;        // r, g, b or y
  std::vector<PhaseRow<2>> half_;          // one for each plane
  std::vector<AlignedSamples<std::int16_t>> smooth_;
};

}  // namespace gazed::saliency
