// Saliency by surroundedness: whatever is enclosed by something else, at any level, is an object
// (Zhang and Sclaroff, "Saliency detection: a Boolean map approach", ICCV 2013; "Exploiting
// surroundedness for saliency detection: a Boolean map approach", PAMI 38(5), 2016).
//
// The papers cut a plane at thresholds; the parts of a cut that do not touch the image's border are
// surrounded. Here all thresholds are taken at once, in intervals: the share of an interval's
// thresholds at which a sample is surrounded is the part of the interval between the border's reach
// and the sample's height (reliefs.hpp). In a boolean map, noise that moves one sample past a
// threshold can create an island; a share changes no more than the noise does. With 10 single
// thresholds, noise of 4 grey levels moved the winner by more than a cell in 8 % of pictures; now
// it does in 2 %.
//
// The shares of an interval are dilated by one sample; let A be their sum, the surrounded area.
// Each is added to the map with the weight 1 / sqrt(A) (the papers divide the map by its L2 norm,
// section 3.2 of 2013), so few small things count more than many or large ones. Other differences:
// the planes are intensity, two opponents and texture at level 3; there is no whitening and no
// opening (at 8 pixels per sample it removes the objects: NSS on OSIE 1.42 with, 1.58 without); and
// the blur is that of the pyramid's step to level 4 plus one more pass of its filter, without which
// the winner is often a detail beside the object.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "agent/saliency/feature_maps.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/reliefs.hpp"

namespace gazed::saliency {

inline constexpr int surroundedness_level = 3;

/// How much of the planes is surrounded, on an absolute scale: 1 / sqrt(A) for each interval of
/// unit weight whose surrounded area A covers a sample. A is in samples of a frame whose longer
/// side is 640 pixels.
struct Attention {
  double peak = 0.0;  // of the map, after its blur
  double mean = 0.0;

  /// [0, 1): one half for a place as salient as a single surrounded sample in one interval.
  [[nodiscard]] double peak_share() const { return peak / (1.0 + peak); }
};

class Surroundedness {
 public:
  /// NSS on OSIE: 1.64 with 8 intervals a plane, as with 6, 10 and 15.
  static constexpr int most_intervals = 8;
  static constexpr int most_planes = Reliefs::most_planes;

  Surroundedness(int frame_width, int frame_height);

  /// Forgets the planes of the previous frame.
  void begin();
  /// Adds level 3 of a plane, which must stay valid until saliency(). Intervals divide its range
  /// evenly and are at least `noise_floor` long; a plane with less range is ignored. `weight` is at
  /// most 1.
  void add(const ConstPlane& plane, std::int32_t noise_floor, double weight);
  /// S of the planes that were added, in Q16, with a maximum of 255; 0 if nothing is surrounded.
  /// Owned by this object.
  PlaneView<std::int32_t> saliency();
  /// Of the last call of saliency().
  [[nodiscard]] Attention attention() const { return attention_; }

 private:
  /// One interval of all reliefs. Holds the surrounded part, dilated along rows: of the previous
  /// row, and the larger of it and the one before.
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
