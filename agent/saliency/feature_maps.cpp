#include "agent/saliency/feature_maps.hpp"

#include <algorithm>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/normalization.hpp"

namespace gazed::saliency {

namespace {

void copy_row(const std::int16_t* from, int samples, std::int16_t* to) {
  along_row(samples, [=](int x) { store(to + x, lanes::load(from + x)); });
}

}  // namespace

MapReduction::MapReduction(int frame_width, int frame_height)
    : width2_(length_at_level(frame_width, 2)),
      width3_(length_at_level(frame_width, 3)),
      to_level3_(width3_, length_at_level(frame_height, 2)),
      to_level4_(length_at_level(frame_width, map_level), length_at_level(frame_height, 3)),
      row_(padded_size(width2_, 1)),
      level3_row_(padded_size(width3_, 1)),
      level4_(length_at_level(frame_width, map_level), length_at_level(frame_height, map_level)) {}

std::int16_t* MapReduction::row_for(int level) {
  return level == map_level ? level4_.view().row(next_row_) : row_.data();
}

void MapReduction::finish_row() {
  ++next_row_;
  if (next_row_ == level4_.view().height) next_row_ = 0;
}

void MapReduction::push(int level, const std::int16_t* row) {
  const int width4 = level4_.view().width;
  switch (level) {
    case 2:
      decimate_row(row, width2_, to_level3_.next_row());
      to_level3_.advance([&](const FiveRows<std::int32_t>& rows) {
        decimate_columns(rows, width3_, level3_row_.data());
        push(3, level3_row_.data());
      });
      break;
    case 3:
      decimate_row(row, width3_, to_level4_.next_row());
      to_level4_.advance([&](const FiveRows<std::int32_t>& rows) {
        decimate_columns(rows, width4, row_for(map_level));
        finish_row();
      });
      break;
    default:
      if (row != row_for(map_level)) copy_row(row, width4, row_for(map_level));
      finish_row();
  }
}

FeatureMaps::FeatureMaps(SaliencyProfile profile, int frame_width, int frame_height)
    : profile_(profile),
      reduction_(frame_width, frame_height),
      rows_(length_at_level(frame_width, first_centre)),
      map_(profile == SaliencyProfile::report
               ? padded_size(length_at_level(frame_width, first_centre),
                             length_at_level(frame_height, first_centre))
               : 0) {
  for (int level = first_centre; level <= last_centre; ++level)
    ramps_.emplace_back(length_at_level(frame_width, level), length_at_level(frame_height, level));
}

std::uint32_t FeatureMaps::reduce_whole(const Pyramid& pyramid, int level, int ratio_log2,
                                        CentreSurround mode, std::int32_t noise_floor) {
  const ConstPlane centre = pyramid.level(level);
  const Plane map{map_.data(), centre.width, centre.height, centre.stride};
  rows_.begin(mode, centre, pyramid.level(level + ratio_log2), ratio_log2);
  for (int y = 0; y < map.height; ++y) rows_.next(map.row(y));
  const std::uint32_t weight = promotion_weight(find_peaks(map), noise_floor);
  if (weight == 0) return 0;
  for (int y = 0; y < map.height; ++y) reduction_.push(level, map.row(y));
  return weight;
}

std::uint32_t FeatureMaps::reduce_streamed(const Pyramid& pyramid, int level, int ratio_log2,
                                           CentreSurround mode, std::int32_t noise_floor) {
  const ConstPlane centre = pyramid.level(level);
  const BorderRamp& ramp = ramps_[static_cast<std::size_t>(level - first_centre)];
  rows_.begin(mode, centre, pyramid.level(level + ratio_log2), ratio_log2);
  for (int y = 0; y < centre.height; ++y) {
    std::int16_t* row = reduction_.row_for(level);
    rows_.next(row);
    ramp.apply(y, row);
    reduction_.push(level, row);
  }
  return promotion_weight(find_peaks(reduction_.map()), noise_floor);
}

void FeatureMaps::add(const Pyramid& pyramid, CentreSurround mode, std::int32_t noise_floor,
                      const ConspicuityMap& conspicuity) {
  for (int level = first_centre; level <= last_centre; ++level) {
    for (int ratio_log2 : {near_surround, far_surround}) {
      const std::uint32_t weight =
          profile_ == SaliencyProfile::report
              ? reduce_whole(pyramid, level, ratio_log2, mode, noise_floor)
              : reduce_streamed(pyramid, level, ratio_log2, mode, noise_floor);
      add_weighted(reduction_.map(), weight, weight_fraction_bits, conspicuity);
    }
  }
}

}  // namespace gazed::saliency
