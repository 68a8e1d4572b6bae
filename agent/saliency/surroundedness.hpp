// Saliency by surroundedness: what is enclosed by something else, at whatever level, is an object
// (Zhang and Sclaroff, "Saliency detection: a Boolean map approach", ICCV 2013; "Exploiting
// surroundedness for saliency detection: a Boolean map approach", PAMI 38(5), 2016).
//
// There a plane is cut at thresholds, and what of the cut the border of the image does not reach is
// surrounded. Here all thresholds are taken at once, in intervals: what of an interval lies between
// the border's reach and the height of a sample (reliefs.hpp) is the share of its thresholds at
// which the sample is surrounded. A boolean map has another island when noise moves one sample past
// its threshold; a share changes by as little as the noise. With 10 single thresholds noise of 4
// grey levels moved the winner by more than a cell in 8 % of pictures, now in 2 %.
//
// Dilated by a sample, the shares of an interval, whose sum is its area A, add 1 / sqrt(A) of
// themselves to the map (the map divided by its L2 norm, section 3.2 of 2013), so that few small
// things are worth more than many or large ones. Other than there: intensity, two opponents and
// texture at level 3, no whitening, no opening (at 8 pixels a sample it takes the objects away: NSS
// on OSIE 1.42 with, 1.58 without), and the blur is that of the pyramid's step to level 4 and one
// pass of its filter more, without which the winner is often a detail beside the object.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "agent/saliency/feature_maps.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/reliefs.hpp"

namespace gazed::saliency {

inline constexpr int surroundedness_level = 3;

/// How much of the planes is surrounded, in absolute measure: 1 / sqrt(A) for each interval of unit
/// weight whose surrounded area A covers a sample; A in samples of a frame whose longer side
/// is 640 pixels.
struct Attention {
  double peak = 0.0;  // of the map, after its blur
  double mean = 0.0;

  /// [0, 1): half for a place as salient as a single sample in one interval would be.
  [[nodiscard]] double peak_share() const { return peak / (1.0 + peak); }
};

class Surroundedness {
 public:
  /// NSS on OSIE: 1.64 with 8 intervals a plane, as with 6, 10 and 15.
  static constexpr int most_intervals = 8;
  static constexpr int most_planes = Reliefs::most_planes;

  Surroundedness(int frame_width, int frame_height);

  /// Forgets the planes of the frame before.
  void begin();
  /// Level 3 of a plane, borrowed until saliency(). Intervals divide its range evenly and are at
  /// least `noise_floor` long;
  /// a plane of less range has no say. `weight` is at most 1.
  void add(const ConstPlane& plane, std::int32_t noise_floor, double weight);
  /// S of the planes that were added, in Q16, its maximum 255; 0 where nothing is surrounded.
  /// Borrowed from this object.
  PlaneView<std::int32_t> saliency();
  /// Of the last saliency().
  [[nodiscard]] Attention attention() const { return attention_; }

 private:
  /// One interval of all reliefs, what of it is surrounded, dilated along rows: the row before, and
  /// the larger of it and the one before that.
  struct Interval {
    explicit Interval(int width);

    void add_to_area(lanes::I16x8 sum);

    AlignedSamples<std::int16_t> row_before, two_rows_before;
    alignas(16) std::array<std::int32_t, lane_count> area{};
    alignas(16) std::array<std::int16_t,
                           lane_count> value{};  // Q15, of a sample that is surrounded altogether
  };

  void find_areas();
  void sum_up();
  template <typename Share, typename Done>
  void surrounded_in_row(int y, Share&& share, Done&& done);
  void blur_map();

  int width_;
  int height_;
  Reliefs reliefs_;
  std::array<double, most_planes> weights_{};
  Reach reach_;
  std::vector<Interval> intervals_;
  int in_use_ = 0;                        // of them
  AlignedSamples<std::int16_t> row_sum_;  // Q10, a lane a relief
  MapReduction reduction_;                // of the sum of its lanes
  OwnedPlane<std::int32_t> scratch_;
  OwnedPlane<std::int32_t> saliency_;
  Attention attention_;
};

}  // namespace gazed::saliency
