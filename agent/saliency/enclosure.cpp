#include "agent/saliency/enclosure.hpp"

#include <algorithm>

namespace gazed {

namespace {

// Only the values matter: the pass is the same in whatever order equal samples are taken.
constexpr auto lower = [](const auto& a, const auto& b) { return a.value < b.value; };

}  // namespace

Enclosure::Enclosure(int width, int height)
    : seen_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  frontier_.reserve(seen_.size());
}

std::int32_t Enclosure::height_at(const ConstPlane& plane, int x, int y) {
  return std::max(summit_height(plane, 1, x, y), summit_height(plane, -1, x, y));
}

void Enclosure::consider(const ConstPlane& plane, std::int32_t sign, int index) {
  std::uint8_t& seen = seen_[static_cast<std::size_t>(index)];
  if (seen != 0) return;
  seen = 1;
  frontier_.push_back({sign * plane.data[index], index});
  std::push_heap(frontier_.begin(), frontier_.end(), lower);
}

// Grows a region from the summit, always by the highest sample next to it, until it meets the
// border: the lowest sample taken on the way is the pass.
std::int32_t Enclosure::summit_height(const ConstPlane& plane, std::int32_t sign, int x, int y) {
  std::fill(seen_.begin(), seen_.end(), std::uint8_t{0});
  frontier_.clear();
  int summit = y * plane.width + x;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, plane.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, plane.width - 1); ++u)
      if (sign * plane.row(v)[u] > sign * plane.data[summit]) summit = v * plane.width + u;

  consider(plane, sign, summit);
  std::int32_t pass = sign * plane.data[summit];
  while (true) {
    std::pop_heap(frontier_.begin(), frontier_.end(), lower);
    const Candidate taken = frontier_.back();
    frontier_.pop_back();
    pass = std::min(pass, taken.value);
    const int column = taken.index % plane.width, row = taken.index / plane.width;
    if (column == 0 || row == 0 || column == plane.width - 1 || row == plane.height - 1) break;
    for (int step : {-plane.width, -1, 1, plane.width}) consider(plane, sign, taken.index + step);
  }
  return sign * plane.data[summit] - pass;
}

}  // namespace gazed
