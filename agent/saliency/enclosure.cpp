#include "agent/saliency/enclosure.hpp"

#include <algorithm>

namespace gazed::saliency {

namespace {

// Only the values matter: the result does not depend on the order of equal samples.
constexpr auto lower = [](const auto& a, const auto& b) { return a.value < b.value; };

int summit_near(const ConstPlane& plane, std::int32_t sign, int x, int y) {
  int summit = y * plane.stride + x;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, plane.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, plane.width - 1); ++u)
      if (sign * plane.row(v)[u] > sign * plane.data[summit]) summit = v * plane.stride + u;
  return summit;
}

/// The highest of the passes along the four straight ways to the border.
std::int32_t straight_pass(const ConstPlane& plane, std::int32_t sign, int summit) {
  const int column = summit % plane.stride, row = summit / plane.stride;
  const auto lowest_on_way = [&](int step, int count) {
    std::int32_t lowest = sign * plane.data[summit];
    for (int i = 1; i <= count; ++i)
      lowest = std::min(lowest, sign * plane.data[summit + i * step]);
    return lowest;
  };
  return std::max({lowest_on_way(-1, column), lowest_on_way(1, plane.width - 1 - column),
                   lowest_on_way(-plane.stride, row),
                   lowest_on_way(plane.stride, plane.height - 1 - row)});
}

}  // namespace

Enclosure::Enclosure(int width, int height) : seen_(padded_size(width, height)) {
  frontier_.reserve(seen_.size());
}

std::int32_t Enclosure::height_at(const ConstPlane& plane, int x, int y, std::int32_t least) {
  for (const std::int32_t sign : {1, -1}) {
    const int summit = summit_near(plane, sign, x, y);
    const std::int32_t top = sign * plane.data[summit];
    // The best way is at least as high as a straight one; that often decides already.
    if (top - straight_pass(plane, sign, summit) <= least) continue;
    least = std::max(least, top - pass_of(plane, sign, summit));
  }
  return least;
}

void Enclosure::consider(const ConstPlane& plane, std::int32_t sign, int index) {
  std::uint8_t& seen = seen_[static_cast<std::size_t>(index)];
  if (seen != 0) return;
  seen = 1;
  frontier_.push_back({sign * plane.data[index], index});
  std::push_heap(frontier_.begin(), frontier_.end(), lower);
}

// Grows a region from the summit, always by the highest adjacent sample, until it reaches the
// border. The lowest sample taken is the pass.
std::int32_t Enclosure::pass_of(const ConstPlane& plane, std::int32_t sign, int summit) {
  std::fill(seen_.begin(), seen_.end(), std::uint8_t{0});
  frontier_.clear();
  consider(plane, sign, summit);
  std::int32_t pass = sign * plane.data[summit];
  while (true) {
    std::pop_heap(frontier_.begin(), frontier_.end(), lower);
    const Candidate taken = frontier_.back();
    frontier_.pop_back();
    pass = std::min(pass, taken.value);
    const int column = taken.index % plane.stride, row = taken.index / plane.stride;
    if (column == 0 || row == 0 || column == plane.width - 1 || row == plane.height - 1)
      return pass;
    for (int step : {-plane.stride, -1, 1, plane.stride}) consider(plane, sign, taken.index + step);
  }
}

}  // namespace gazed::saliency
