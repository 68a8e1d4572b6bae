#include "agent/saliency/overexposed.hpp"

#include <algorithm>
#include <cmath>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/inhibition.hpp"

namespace gazed::saliency {

namespace {

// Grey levels, of a low-passed sample: 19 pixels in 20 at 255 and one at 155, or all of them at
// 250.
constexpr double saturated_level = 250.0;
constexpr auto saturated_sample =
    static_cast<std::int16_t>(saturated_level * plane_samples_per_grey_level[0]);

}  // namespace

Overexposed::Overexposed(double weight, int map_width, int map_height)
    : kept_(static_cast<std::uint16_t>(std::lround(weight * all_kept))),
      saturated_(map_width, map_height),
      beside_(map_width, map_height) {}

// The S of an edge spreads over one more sample.
void Overexposed::weaken(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity) {
  bool any = false;
  std::ranges::fill(saturated_.words(), BitPlane::Word{0});
  for (int y = 0; y < intensity.height; ++y) {
    const std::int16_t* row = intensity.row(y);
    for (int x = 0; x < intensity.width; ++x) {
      if (row[x] < saturated_sample) continue;
      saturated_.set(x, y);
      any = true;
    }
  }
  if (!any) return;
  dilate(saturated_, beside_);
  for (int y = 0; y < saliency.height; ++y) {
    std::int32_t* row = saliency.row(y);
    for (int x = 0; x < saliency.width; ++x)
      if (beside_.at(x, y))
        row[x] = static_cast<std::int32_t>((std::int64_t{row[x]} * kept_) >> kept_fraction_bits);
  }
}

}  // namespace gazed::saliency
