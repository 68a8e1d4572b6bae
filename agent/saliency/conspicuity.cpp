#include "agent/saliency/conspicuity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/normalization.hpp"

namespace gazed {

namespace {

constexpr int share_bits = 16;
constexpr int scaled_bits = 15;  // of the largest sample, so that it fits in 16 bits signed

}  // namespace

SaliencySum::SaliencySum(double intensity_weight, double colour_weight, int map_width,
                         int map_height)
    : width_(map_width),
      height_(map_height),
      intensity_share_(static_cast<std::int32_t>(std::lround(
          (1 << share_bits) * (intensity_weight / (intensity_weight + colour_weight))))),
      scaled_(static_cast<std::size_t>(map_width) * static_cast<std::size_t>(map_height)),
      saliency_(scaled_.size()) {}

void SaliencySum::add_promoted(const ConspicuityMap& map, std::int32_t share) {
  const auto largest = static_cast<std::uint32_t>(*std::max_element(map.begin(), map.end()));
  const int shift = std::max(static_cast<int>(std::bit_width(largest)) - scaled_bits, 0);
  for (std::size_t i = 0; i < map.size(); ++i)
    scaled_[i] = static_cast<std::int16_t>(map[i] >> shift);
  const std::uint64_t weight =
      promotion_weight(find_peaks({scaled_.data(), width_, height_}), /*noise_floor=*/0);
  constexpr int weight_shift = weight_fraction_bits - conspicuity_fraction_bits;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const std::uint64_t promoted =
        (static_cast<std::uint64_t>(scaled_[i]) * weight) >> weight_shift;
    saliency_[i] +=
        static_cast<std::int32_t>((promoted * static_cast<std::uint64_t>(share)) >> share_bits);
  }
}

PlaneView<std::int32_t> SaliencySum::add(const ConspicuityMap& intensity,
                                         const ConspicuityMap& colour) {
  std::fill(saliency_.begin(), saliency_.end(), 0);
  add_promoted(intensity, intensity_share_);
  add_promoted(colour, (1 << share_bits) - intensity_share_);
  return {saliency_.data(), width_, height_};
}

}  // namespace gazed
