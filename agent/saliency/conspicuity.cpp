#include "agent/saliency/conspicuity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/normalization.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

constexpr int share_bits = 16;
constexpr int scaled_bits = 15;  // of the largest sample, so that it fits in signed 16 bits

std::int32_t largest_of(const ConspicuityMap& map) {
  std::int32_t largest = 0;
  for (int y = 0; y < map.height; ++y)
    largest = std::max(largest, *std::max_element(map.row(y), map.row(y) + map.width));
  return largest;
}

}  // namespace

SaliencySum::SaliencySum(double intensity_weight, double colour_weight, int map_width,
                         int map_height)
    : intensity_share_(static_cast<std::int32_t>(std::lround(
          (1 << share_bits) * (intensity_weight / (intensity_weight + colour_weight))))),
      scaled_(map_width, map_height),
      saliency_(map_width, map_height) {}

void SaliencySum::add_promoted(const ConspicuityMap& map, std::int32_t share) {
  const auto largest = static_cast<std::uint32_t>(largest_of(map));
  const int shift = std::max(static_cast<int>(std::bit_width(largest)) - scaled_bits, 0);
  const Plane scaled = scaled_.view();
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; x += lane_count) {
      const std::int32_t* from = map.row(y) + x;
      store(scaled.row(y) + x, packed(shifted_right_by(load(from), shift),
                                      shifted_right_by(load(from + lane_count / 2), shift)));
    }
  }
  const std::uint64_t weight = promotion_weight(find_peaks(scaled), /*noise_floor=*/0);
  add_weighted(scaled, weight * static_cast<std::uint64_t>(share),
               weight_fraction_bits + share_bits, saliency_.view());
}

PlaneView<std::int32_t> SaliencySum::add(const ConspicuityMap& intensity,
                                         const ConspicuityMap& colour) {
  fill(saliency_.view(), 0);
  add_promoted(intensity, intensity_share_);
  add_promoted(colour, (1 << share_bits) - intensity_share_);
  return saliency_.view();
}

}  // namespace gazed::saliency
