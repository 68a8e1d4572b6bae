#include "agent/saliency/reliefs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace gazed::saliency {

using namespace lanes;

namespace {

constexpr int largest_16 = std::numeric_limits<std::int16_t>::max();
static_assert(Reliefs::most_intervals * interval_heights < (largest_16 + 1) / 2);

}  // namespace

Reliefs::Reliefs(int width, int height)
    : width_(width),
      height_(height),
      nothing_(padded_size(width, 1)),
      row_(static_cast<std::size_t>(padded_to_lanes(width)) * lane_count) {
  clear();
}

void Reliefs::clear() {
  count_ = 0;
  for (Scale& scale : scales_) scale = {.plane = {nothing_.data(), width_, height_, 0}};
}

// The range that was shifted has at least 2^14 levels and so more than the heights: the factor is
// below 1.
void Reliefs::add(const ConstPlane& plane, std::int16_t lowest, std::int16_t highest,
                  int intervals) {
  Scale& scale = scales_[static_cast<std::size_t>(count_++)];
  scale = {.plane = plane,
           .lowest = lowest,
           .highest = static_cast<std::int16_t>(intervals * interval_heights)};
  int range = highest - lowest;
  for (; 2 * range <= largest_16; range *= 2) ++scale.shift;
  scale.factor = static_cast<std::int16_t>(
      std::lround(std::ldexp(static_cast<double>(scale.highest) / range, 15)));
}

const std::int16_t* Reliefs::row(int y) {
  const I16x8 highest = interleaved_pairs_low(alternating(scales_[0].highest, scales_[1].highest),
                                              alternating(scales_[2].highest, scales_[3].highest));
  std::int16_t* to = row_.data();
  const auto put = [&](I16x8 two_samples) {
    const I16x8 upside_down = highest - two_samples;
    store(to, low_halves(two_samples, upside_down));
    store(to + lane_count, high_halves(two_samples, upside_down));
    to += 2 * lane_count;
  };
  const auto heights = [&](const Scale& scale, int x) {
    const I16x8 above_lowest = load(scale.plane.row(y) + x) - splat(scale.lowest);
    return times_q15(shifted_left_by(above_lowest, scale.shift), splat(scale.factor));
  };
  for (int x = 0; x < width_; x += lane_count) {
    const I16x8 a = heights(scales_[0], x), b = heights(scales_[1], x);
    const I16x8 c = heights(scales_[2], x), d = heights(scales_[3], x);
    const I16x8 ab_low = interleaved_low(a, b), cd_low = interleaved_low(c, d);
    put(interleaved_pairs_low(ab_low, cd_low));
    put(interleaved_pairs_high(ab_low, cd_low));
    const I16x8 ab_high = interleaved_high(a, b), cd_high = interleaved_high(c, d);
    put(interleaved_pairs_low(ab_high, cd_high));
    put(interleaved_pairs_high(ab_high, cd_high));
  }
  return row_.data();
}

Reach::Reach(int width, int height)
    : width_(width),
      height_(height),
      reach_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * lane_count),
      fresh_(static_cast<std::size_t>(height)) {}

std::int16_t* Reach::reach_row(int y) {
  return reach_.data() + std::ptrdiff_t{y} * width_ * lane_count;
}

const std::int16_t* Reach::row(int y) const {
  return reach_.data() + std::ptrdiff_t{y} * width_ * lane_count;
}

void Reach::start_at_border(Reliefs& reliefs) {
  const int length = width_ * lane_count;
  for (int y = 0; y < height_; ++y) {
    const std::int16_t* heights = reliefs.row(y);
    std::int16_t* reach = reach_row(y);
    if (y == 0 || y == height_ - 1) {
      std::copy_n(heights, length, reach);
      continue;
    }
    std::fill_n(reach, length, std::int16_t{0});
    std::copy_n(heights, lane_count, reach);
    std::copy_n(heights + length - lane_count, lane_count, reach + length - lane_count);
    spread_right(heights, reach, reach);
    spread_left(heights, reach);
  }
}

// From the row beside, then along the row both ways. False when nothing rose: along itself, no row
// has more to spread then.
bool Reach::spread(int from, int to, Reliefs& reliefs) {
  const std::int16_t* heights = reliefs.row(to);
  if (!spread_right(heights, reach_row(from), reach_row(to))) return false;
  spread_left(heights, reach_row(to));
  return true;
}

bool Reach::spread_right(const std::int16_t* heights, const std::int16_t* beside,
                         std::int16_t* reach) const {
  I16x8 rise = splat(0), before = load(reach);
  const int last = (width_ - 1) * lane_count;
  for (int i = lane_count; i < last; i += lane_count) {
    const I16x8 was = load(reach + i);
    before = larger(was, smaller(load(heights + i), larger(before, load(beside + i))));
    rise = larger(rise, before - was);
    store(reach + i, before);
  }
  return any(is_greater(rise, splat(0)));
}

void Reach::spread_left(const std::int16_t* heights, std::int16_t* reach) const {
  const int last = (width_ - 1) * lane_count;
  I16x8 before = load(reach + last);
  for (int i = last - lane_count; i > 0; i -= lane_count) {
    before = larger(load(reach + i), smaller(load(heights + i), before));
    store(reach + i, before);
  }
}

// Sweeps down and up until one raises nothing.
void Reach::find(Reliefs& reliefs) {
  start_at_border(reliefs);
  std::ranges::fill(fresh_, Fresh{true, true});
  bool rose = true;
  while (rose) {
    rose = false;
    const auto spread_if_fresh = [&](bool& fresh, int from, int to) {
      if (!std::exchange(fresh, false) || !spread(from, to, reliefs)) return;
      fresh_[static_cast<std::size_t>(to)] = {true, true};
      rose = true;
    };
    for (int y = 1; y < height_ - 1; ++y)
      spread_if_fresh(fresh_[static_cast<std::size_t>(y - 1)].downwards, y - 1, y);
    for (int y = height_ - 2; y > 0; --y)
      spread_if_fresh(fresh_[static_cast<std::size_t>(y + 1)].upwards, y + 1, y);
  }
}

}  // namespace gazed::saliency
