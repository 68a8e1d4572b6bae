// One channel's centre-surround maps, each through N, at the map's level: what a conspicuity map is
// the sum of.
//
//   report: centre-surround -> N's weight from the whole map -> reduced to level 4
//   robust: centre-surround -> border ramp -> reduced to level 4 -> N's weight from that
//
// N multiplies a whole map by one number, so multiplying after the reduction changes nothing and
// takes fewer multiplications.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/saliency/center_surround.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/pyramid.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

/// Takes a map of level 2, 3 or 4 row by row and reduces it to level 4 with the pyramid's filter.
/// Eight samples before and after each row are read.
class MapReduction {
 public:
  MapReduction(int frame_width, int frame_height);

  /// Where the map's next row can be written, so that push() need not copy it.
  [[nodiscard]] std::int16_t* row_for(int level);

  /// Takes the map's next row. After the last row, map() is the reduced map.
  void push(int level, const std::int16_t* row);
  [[nodiscard]] ConstPlane map() { return level4_.view(); }

 private:
  void finish_row();

  int width2_;
  int width3_;
  int next_row_ = 0;
  RowRing<std::int32_t> to_level3_;
  RowRing<std::int32_t> to_level4_;
  AlignedSamples<std::int16_t> row_;  // of a map of level 2 or 3
  AlignedSamples<std::int16_t> level3_row_;
  OwnedPlane<std::int16_t> level4_;
};

/// The sum of feature maps of one channel, Q16.
using ConspicuityMap = PlaneView<std::int32_t>;

class FeatureMaps {
 public:
  FeatureMaps(SaliencyProfile profile, int frame_width, int frame_height);

  /// Adds the six maps of `pyramid` to `conspicuity`, except those whose maximum is below
  /// `noise_floor`.
  void add(const Pyramid& pyramid, CentreSurround mode, std::int32_t noise_floor,
           const ConspicuityMap& conspicuity);

 private:
  /// Leaves one map in reduction_ and returns its weight by N.
  std::uint32_t reduce_whole(const Pyramid& pyramid, int level, int ratio_log2, CentreSurround mode,
                             std::int32_t noise_floor);
  std::uint32_t reduce_streamed(const Pyramid& pyramid, int level, int ratio_log2,
                                CentreSurround mode, std::int32_t noise_floor);

  SaliencyProfile profile_;
  MapReduction reduction_;
  std::vector<BorderRamp> ramps_;  // for profile robust, from the finest centre level on
  CentreSurroundRows rows_;
  AlignedSamples<std::int16_t> map_;  // for profile report: the finest map
};

}  // namespace gazed::saliency
