// Saliency by surroundedness: what is enclosed by something else, at whatever level, is an object
// (Zhang and Sclaroff, "Saliency detection: a Boolean map approach", ICCV 2013; "Exploiting
// surroundedness for saliency detection: a Boolean map approach", PAMI 38(5), 2016).
//
// A boolean map is a plane cut at a threshold, or the inverse of that. What of it the border of the
// image does not reach is surrounded. Dilated by a sample, each surrounded area A adds 1 / sqrt(A)
// to its samples (the map divided by its L2 norm, section 3.2 of 2013), so that few small things
// are worth more than many or large ones. Other than there: intensity, two opponents and texture at
// level 3, no whitening, no opening (at 8 pixels a sample it takes the objects away: NSS on OSIE
// 1.42 with, 1.58 without), and the blur is that of the pyramid's step to level 4 and one pass of
// its filter more, without which the winner is often a detail beside the object.
#pragma once

#include <array>
#include <cstdint>

#include "agent/saliency/bit_plane.hpp"
#include "agent/saliency/feature_maps.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

inline constexpr int surroundedness_level = 3;

/// How much of the planes is surrounded, in absolute measure: 1 / sqrt(A) for each boolean map of
/// unit weight whose surrounded area A covers a sample; A in samples of a frame whose longer side
/// is 640 pixels.
struct Attention {
  double peak = 0.0;  // of the map, after its blur
  double mean = 0.0;

  /// [0, 1): half for a place as salient as a single sample in one boolean map would be.
  [[nodiscard]] double peak_share() const { return peak / (1.0 + peak); }
};

class Surroundedness {
 public:
  /// NSS on OSIE: 1.64 with 10 thresholds a plane, as much with 15, 0.03 less with 7.
  static constexpr int most_thresholds = 10;
  static constexpr int most_planes = 4;

  Surroundedness(int frame_width, int frame_height);

  /// Forgets the planes of the frame before.
  void begin();
  /// Level 3 of a plane. Thresholds divide its range evenly and lie at least `noise_floor` apart;
  /// a plane of less range has no say. `weight` is at most 1.
  void add(const ConstPlane& plane, std::int32_t noise_floor, double weight);
  /// S of the planes that were added, in Q16, its maximum 255; 0 where nothing is surrounded.
  /// Borrowed from this object.
  PlaneView<std::int32_t> saliency();
  /// Of the last saliency().
  [[nodiscard]] Attention attention() const { return attention_; }

 private:
  static constexpr int slice_count = 4;  // bits of a count of thresholds

  void slice(const ConstPlane& plane, std::int32_t lowest, std::int32_t levels_per_sample);
  void cut(int threshold);
  void add_surrounded(double weight);
  void accumulate(const BitPlane& area, std::int16_t value);
  void blur_map();

  int width_;
  int height_;
  std::array<BitPlane, slice_count> slices_;  // of the number of thresholds that a sample exceeds
  BitPlane map_;                              // the boolean map
  BitPlane reached_;                          // by the border; then what is surrounded
  BitPlane dilated_;
  OwnedPlane<std::int16_t> sum_;  // Q10
  MapReduction reduction_;
  OwnedPlane<std::int32_t> row_blurred_;  // the map filtered along its rows
  OwnedPlane<std::int32_t> saliency_;
  Attention attention_;
};

}  // namespace gazed::saliency
