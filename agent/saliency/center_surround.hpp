// Centre-surround maps: a fine level of a pyramid against a coarse one (Itti, Koch, Niebur, PAMI
// 20(11), 1998, eqs. 1 to 3).
#pragma once

#include <cstdint>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

inline constexpr int first_centre = 2;
inline constexpr int last_centre = 4;
inline constexpr int near_surround = 3;  // surround level - centre level
inline constexpr int far_surround = 4;

enum class CentreSurround : std::uint8_t {
  difference,  // |centre - surround|
  sum,         // |centre + surround|: the report's RG and BY as printed, eqs. 2 and 3 of 1998
};

/// Makes maps row by row. The surround, 2^ratio_log2 times coarser, is interpolated bilinearly:
/// centre sample i looks at surround position i / 2^ratio_log2, clamped at the last sample.
class CentreSurroundRows {
 public:
  /// For centres of up to `widest` samples a row.
  explicit CentreSurroundRows(int widest);

  /// Begins a map. `ratio_log2`: 3 or 4. The planes are borrowed until its last row.
  void begin(CentreSurround mode, const ConstPlane& centre, const ConstPlane& surround,
             int ratio_log2);

  /// Writes the map's next row, padded.
  void next(std::int16_t* out);

 private:
  void widen_next_surround_row();

  CentreSurround mode_ = CentreSurround::difference;
  ConstPlane centre_;
  ConstPlane surround_;
  int ratio_log2_ = 0;
  int y_ = 0;
  // The surround between two of its rows, at the centre's width: above + step x fraction.
  AlignedSamples<std::int16_t> above_;
  AlignedSamples<std::int16_t> step_;
};

/// A linear ramp over the outer max(width, height)/20 samples of a map, which mutes artefacts of
/// the reflected border: sample i from the border is multiplied by (i + 1)/(max/20 + 1), on both
/// axes (iNVT's and SaliencyToolbox's attenuateBorders).
class BorderRamp {
 public:
  BorderRamp(int width, int height);

  /// Row `y` of the map, padded.
  void apply(int y, std::int16_t* row) const;

 private:
  int width_;
  int height_;
  int length_;
  int left_end_;  // columns before this and from the next one on are attenuated, in whole I16x8
  int right_begin_;
  AlignedSamples<std::int16_t> loss_;  // 1 - factor in Q15, of each column
};

}  // namespace gazed::saliency
