#include "agent/saliency/feature_maps.hpp"

#include <algorithm>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/normalization.hpp"

namespace gazed {

MapReduction::MapReduction(int frame_width, int frame_height)
    : width2_(length_at_level(frame_width, 2)),
      width3_(length_at_level(frame_width, 3)),
      width4_(length_at_level(frame_width, map_level)),
      height4_(length_at_level(frame_height, map_level)),
      to_level3_(width3_, length_at_level(frame_height, 2)),
      to_level4_(width4_, length_at_level(frame_height, 3)),
      level3_row_(static_cast<std::size_t>(width3_)),
      level4_(static_cast<std::size_t>(width4_) * static_cast<std::size_t>(height4_)) {}

ConstPlane MapReduction::map() const {
  return {level4_.data(), width4_, height4_};
}

void MapReduction::push(int level, const std::int16_t* row) {
  constexpr int shift = 2 * binomial_gain_log2;
  const auto next_row_out = [this] {
    std::int16_t* out = level4_.data() + static_cast<std::ptrdiff_t>(width4_) * next_row_;
    next_row_ = (next_row_ + 1) % height4_;
    return out;
  };
  switch (level) {
    case 2:
      decimate_row<0>(row, width2_, to_level3_.next_row());
      to_level3_.advance([&](const FiveRows<std::int32_t>& rows) {
        decimate_columns<shift>(rows, width3_, level3_row_.data());
        push(3, level3_row_.data());
      });
      break;
    case 3:
      decimate_row<0>(row, width3_, to_level4_.next_row());
      to_level4_.advance([&](const FiveRows<std::int32_t>& rows) {
        decimate_columns<shift>(rows, width4_, next_row_out());
      });
      break;
    default:
      std::copy_n(row, width4_, next_row_out());
  }
}

FeatureMaps::FeatureMaps(SaliencyProfile profile, int frame_width, int frame_height)
    : profile_(profile),
      reduction_(frame_width, frame_height),
      surround_row_(static_cast<std::size_t>(
          length_at_level(frame_width, first_centre + near_surround) + 1)) {
  const int width = length_at_level(frame_width, first_centre);
  const int height = length_at_level(frame_height, first_centre);
  const bool whole = profile == SaliencyProfile::report;
  map_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(whole ? height : 1));
  for (int level = first_centre; level <= last_centre; ++level)
    ramps_.emplace_back(length_at_level(frame_width, level), length_at_level(frame_height, level));
}

std::uint32_t FeatureMaps::reduce_whole(const Pyramid& pyramid, int level, int ratio_log2,
                                        CentreSurround mode, std::int32_t noise_floor) {
  const ConstPlane centre = pyramid.level(level), surround = pyramid.level(level + ratio_log2);
  const Plane map{map_.data(), centre.width, centre.height};
  for (int y = 0; y < map.height; ++y)
    center_surround_row(mode, centre, surround, ratio_log2, y, surround_row_, map.row(y));
  const std::uint32_t weight = promotion_weight(find_peaks(map), noise_floor);
  if (weight == 0) return 0;
  for (int y = 0; y < map.height; ++y) reduction_.push(level, map.row(y));
  return weight;
}

std::uint32_t FeatureMaps::reduce_streamed(const Pyramid& pyramid, int level, int ratio_log2,
                                           CentreSurround mode, std::int32_t noise_floor) {
  const ConstPlane centre = pyramid.level(level), surround = pyramid.level(level + ratio_log2);
  const BorderRamp& ramp = ramps_[static_cast<std::size_t>(level - first_centre)];
  for (int y = 0; y < centre.height; ++y) {
    center_surround_row(mode, centre, surround, ratio_log2, y, surround_row_, map_.data());
    ramp.apply(y, map_.data());
    reduction_.push(level, map_.data());
  }
  return promotion_weight(find_peaks(reduction_.map()), noise_floor);
}

void FeatureMaps::add(const Pyramid& pyramid, CentreSurround mode, std::int32_t noise_floor,
                      ConspicuityMap& conspicuity) {
  constexpr int weight_shift = weight_fraction_bits - conspicuity_fraction_bits;
  for (int level = first_centre; level <= last_centre; ++level) {
    for (int ratio_log2 : {near_surround, far_surround}) {
      const std::uint64_t weight =
          profile_ == SaliencyProfile::report
              ? reduce_whole(pyramid, level, ratio_log2, mode, noise_floor)
              : reduce_streamed(pyramid, level, ratio_log2, mode, noise_floor);
      if (weight == 0) continue;
      const ConstPlane map = reduction_.map();
      for (std::size_t i = 0; i < conspicuity.size(); ++i)
        conspicuity[i] += static_cast<std::int32_t>(
            (static_cast<std::uint64_t>(map.data[i]) * weight) >> weight_shift);
    }
  }
}

}  // namespace gazed
