#include "agent/saliency/appearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace gazed::saliency {

namespace {

constexpr float noise_square = 2.0F * 2.0F;  // grey levels, of each sample

float interpolated(const FramePlane& plane, double x, double y) {
  x = std::clamp(x, 0.0, plane.width - 1.0);
  y = std::clamp(y, 0.0, plane.height - 1.0);
  const int left = std::min(static_cast<int>(x), std::max(plane.width - 2, 0));
  const int top = std::min(static_cast<int>(y), std::max(plane.height - 2, 0));
  const int right = std::min(left + 1, plane.width - 1);
  const int bottom = std::min(top + 1, plane.height - 1);
  const auto at = [&](int u, int v) { return static_cast<float>(plane.row(v)[u]); };
  const auto across = static_cast<float>(x - left), down = static_cast<float>(y - top);
  const float above = at(left, top) + across * (at(right, top) - at(left, top));
  const float below = at(left, bottom) + across * (at(right, bottom) - at(left, bottom));
  return (above + down * (below - above)) / plane.samples_per_grey_level;
}

/// The map's maximum over a pixel's sample and its neighbours, relative to the map's peak.
double share_of_peak(const SaliencyMap& map, const geometry::Pixel& pixel) {
  const int column = static_cast<int>(std::lround(pixel.x() / saliency_cell_px));
  const int row = static_cast<int>(std::lround(pixel.y() / saliency_cell_px));
  int near = 0;
  for (int y = std::max(0, row - 1); y <= std::min(map.height - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(map.width - 1, column + 1); ++x)
      near = std::max<int>(near, map.samples[static_cast<std::size_t>(y * map.width + x)]);
  const int peak = *std::ranges::max_element(map.samples);
  return peak > 0 ? static_cast<double>(near) / peak : 0.0;
}

}  // namespace

Appearance appearance_at(const FramePlanes& planes, const geometry::Pixel& pixel) {
  Appearance result;
  auto to = result.pattern.begin();
  for (const FramePlane& plane : planes) {
    if (plane.samples == nullptr) return {};
    const auto first = to;
    for (int v = -Appearance::side / 2; v <= Appearance::side / 2; ++v)
      for (int u = -Appearance::side / 2; u <= Appearance::side / 2; ++u)
        *to++ =
            interpolated(plane, pixel.x() / saliency_cell_px + u, pixel.y() / saliency_cell_px + v);
    if (&plane != planes.data()) continue;
    const float mean = std::accumulate(first, to, 0.0F) / static_cast<float>(to - first);
    std::for_each(first, to, [mean](float& sample) { sample -= mean; });
  }
  return result;
}

double likeness(const Appearance& a, const Appearance& b) {
  float ab = 0.0F, squares = noise_square * static_cast<float>(Appearance::samples);
  for (std::size_t i = 0; i < Appearance::samples; ++i) {
    ab += a.pattern[i] * b.pattern[i];
    squares += a.pattern[i] * a.pattern[i] + b.pattern[i] * b.pattern[i];
  }
  return static_cast<double>(2.0F * ab / squares);
}

Confirmation confirm(const SaliencyResult& seen, const geometry::Pixel& pixel,
                     const Appearance& before) {
  return {share_of_peak(seen.map, pixel), likeness(before, appearance_at(seen.planes, pixel))};
}

}  // namespace gazed::saliency
