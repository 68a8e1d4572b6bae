// Centre-surround maps: a fine level of a pyramid against a coarse one (Itti, Koch, Niebur, PAMI
// 20(11), 1998, eqs. 1 to 3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agent/saliency/plane.hpp"

namespace gazed {

inline constexpr int first_centre = 2;
inline constexpr int last_centre = 4;
inline constexpr int near_surround = 3;  // surround level - centre level
inline constexpr int far_surround = 4;

enum class CentreSurround : std::uint8_t {
  difference,  // |centre - surround|
  sum,         // |centre + surround|: the report's RG and BY as printed, eqs. 2 and 3 of 1998
};

/// Row `y` of the map. The surround, 2^ratio_log2 times coarser, is interpolated bilinearly: centre
/// sample i looks at surround position i / 2^ratio_log2, clamped at the last sample. `scratch`
/// holds one row of the surround and one sample more.
void center_surround_row(CentreSurround mode, const ConstPlane& centre, const ConstPlane& surround,
                         int ratio_log2, int y, std::span<std::int16_t> scratch, std::int16_t* out);

/// A linear ramp over the outer max(width, height)/20 samples of a map, which takes the say from
/// what the reflected border makes up: sample i from the border is multiplied by
/// (i + 1)/(max/20 + 1), on both axes (iNVT's and SaliencyToolbox's attenuateBorders).
class BorderRamp {
 public:
  BorderRamp(int width, int height);
  void apply(int y, std::int16_t* row) const;

 private:
  int width_;
  int height_;
  std::vector<std::int16_t> factors_;  // Q15, from the border inwards
};

}  // namespace gazed
