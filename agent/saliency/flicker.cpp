#include "agent/saliency/flicker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/normalization.hpp"
#include "agent/saliency/pyramid.hpp"

namespace gazed {

namespace {

static_assert(flicker_level == map_level - 1);

constexpr int share_bits = 16;

// The filter [1 2 1] in both directions. Three taps do, the planes are smooth already.
constexpr int filter_gain_log2 = 2;
constexpr std::int32_t largest_intensity = 255 * samples_per_grey_level;
static_assert((largest_intensity << filter_gain_log2) <= std::numeric_limits<std::uint16_t>::max());

struct RowPair {
  const std::int16_t* now;
  const std::int16_t* before;
};

// The one minus the other, whichever is larger: all within 16 bits, so that it is eight at a time.
std::uint16_t change(const RowPair& rows, int x) {
  return static_cast<std::uint16_t>(std::max(rows.now[x], rows.before[x]) -
                                    std::min(rows.now[x], rows.before[x]));
}

void weigh_rows(const RowPair& above, const RowPair& centre, const RowPair& below, int width,
                std::uint16_t* out) {
  for (int x = 0; x < width; ++x)
    out[x] =
        static_cast<std::uint16_t>(change(above, x) + 2 * change(centre, x) + change(below, x));
}

std::uint32_t weight_of(const ConstPlane& map, std::int32_t noise_floor) {
  MapPeaks peaks;
  for (const std::int16_t sample : std::span(map.data, map.size())) {
    peaks.maximum = std::max<std::int32_t>(peaks.maximum, sample);
    peaks.sum_of_others += sample;
  }
  peaks.others = static_cast<int>(map.size());
  return promotion_weight(peaks, noise_floor);
}

}  // namespace

Flicker::Flicker(double share, std::int32_t noise_floor, int frame_width, int frame_height)
    : width_(length_at_level(frame_width, flicker_level)),
      height_(length_at_level(frame_height, flicker_level)),
      map_width_(halved(width_)),
      map_height_(halved(height_)),
      share_(static_cast<std::int32_t>(std::lround((1 << share_bits) * share))),
      noise_floor_(noise_floor),
      before_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
      column_(static_cast<std::size_t>(width_)),
      change_(static_cast<std::size_t>(map_width_) * static_cast<std::size_t>(map_height_)) {}

ConstPlane Flicker::reduced_change(const ConstPlane& intensity) {
  const ConstPlane before{before_.data(), width_, height_};
  const auto rows = [&](int y) {
    const int inside = reflect_101(y, height_);
    return RowPair{intensity.row(inside), before.row(inside)};
  };
  for (int y = 0; y < map_height_; ++y) {
    weigh_rows(rows(2 * y - 1), rows(2 * y), rows(2 * y + 1), width_, column_.data());
    std::int16_t* out = change_.data() + static_cast<std::ptrdiff_t>(map_width_) * y;
    const auto at = [&](int x) {
      return std::int32_t{column_[static_cast<std::size_t>(reflect_101(x, width_))]};
    };
    for (int x = 0; x < map_width_; ++x)
      out[x] = static_cast<std::int16_t>(
          rounding_shift<2 * filter_gain_log2>(at(2 * x - 1) + 2 * at(2 * x) + at(2 * x + 1)));
  }
  return {change_.data(), map_width_, map_height_};
}

void Flicker::add_to(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity,
                     bool still) {
  if (primed_ && still) {
    const ConstPlane map = reduced_change(intensity);
    const std::uint64_t weight = weight_of(map, noise_floor_);
    constexpr int weight_shift = weight_fraction_bits - conspicuity_fraction_bits;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const auto promoted = static_cast<std::int64_t>(
          (static_cast<std::uint64_t>(map.data[i]) * weight) >> weight_shift);
      const std::int64_t step = promoted - saliency.data[i];
      saliency.data[i] += static_cast<std::int32_t>((step * share_) >> share_bits);
    }
  }
  std::copy_n(intensity.data, before_.size(), before_.begin());
  primed_ = true;
}

}  // namespace gazed
