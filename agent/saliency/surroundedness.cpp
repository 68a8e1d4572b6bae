#include "agent/saliency/surroundedness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/low_pass.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

constexpr int sum_fraction_bits = 10;
constexpr std::int32_t one_in_sum = 1 << sum_fraction_bits;
static_assert(one_in_sum == interval_heights);

// A sample that is surrounded lies inside the frame and is dilated to 9, so the area is 9 times its
// own share s at least, and s / sqrt(max(9 s, 1)) at most a third.
static_assert(2 * Surroundedness::most_planes * Surroundedness::most_intervals *
                  (one_in_sum / 3 + 1) <=
              std::numeric_limits<std::int16_t>::max());

constexpr int blurred_more_bits = 8;  // after which |sample| < 2^23

constexpr double unit_side = 80.0;  // of level 3 of 640 pixels, for the units of Attention

// So many samples of 2^10 fit in 16 bits.
constexpr int summed_in_16_bits = 16;
static_assert((summed_in_16_bits + 1) * interval_heights <=
              std::numeric_limits<std::int16_t>::max());

// weight / sqrt(area), Q15. IEEE 754 fixes both operations: the same everywhere. An area of less
// than a sample counts as one.
std::int16_t over_root(double weight, std::int32_t area) {
  constexpr double one = std::numeric_limits<std::int16_t>::max();
  const double samples = std::max(static_cast<double>(area) / interval_heights, 1.0);
  return static_cast<std::int16_t>(std::lround(one * weight / std::sqrt(samples)));
}

std::pair<std::int16_t, std::int16_t> extremes(const ConstPlane& plane) {
  std::int16_t lowest = plane.row(0)[0], highest = lowest;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      lowest = std::min(lowest, plane.row(y)[x]);
      highest = std::max(highest, plane.row(y)[x]);
    }
  }
  return {lowest, highest};
}

}  // namespace

Surroundedness::Interval::Interval(int width)
    : row_before(static_cast<std::size_t>(width) * lane_count),
      two_rows_before(static_cast<std::size_t>(width) * lane_count) {}

Surroundedness::Surroundedness(int frame_width, int frame_height)
    : width_(length_at_level(frame_width, surroundedness_level)),
      height_(length_at_level(frame_height, surroundedness_level)),
      reliefs_(width_, height_),
      reach_(width_, height_),
      intervals_(most_intervals, Interval(width_)),
      row_sum_(static_cast<std::size_t>(width_) * lane_count),
      reduction_(frame_width, frame_height),
      scratch_(halved(width_), halved(height_)),
      saliency_(halved(width_), halved(height_)) {}

void Surroundedness::Interval::add_to_area(I16x8 sum) {
  const I16x8 zero = splat(0), one = splat(1);
  std::int32_t *low = area.data(), *high = low + lane_count / 2;
  store(low, load(low) + pair_sums(interleaved_low(sum, zero), one));
  store(high, load(high) + pair_sums(interleaved_high(sum, zero), one));
}

void Surroundedness::begin() {
  reliefs_.clear();
  in_use_ = 0;
}

void Surroundedness::add(const ConstPlane& plane, std::int32_t noise_floor, double weight) {
  const auto [lowest, highest] = extremes(plane);
  const int intervals = std::min(most_intervals, (highest - lowest) / std::max(noise_floor, 1));
  if (intervals == 0 || weight <= 0.0) return;
  weights_[static_cast<std::size_t>(reliefs_.count())] = weight;
  reliefs_.add(plane, lowest, highest, intervals);
  in_use_ = std::max(in_use_, intervals);
}

// Of row y - 1, once row y is known, what of each interval lies between reach and height, the
// largest of a sample and its 8 neighbours: share(x, s) for each sample, of so many at a time that
// their sum fits in 16 bits; then done(interval). On the border reach and height are one.
template <typename Share, typename Done>
void Surroundedness::surrounded_in_row(int y, Share&& share, Done&& done) {
  const std::int16_t* reach = reach_.row(y < height_ ? y : 0);
  const std::int16_t* heights = y < height_ ? reliefs_.row(y) : reach;
  const I16x8 none = splat(0);
  std::int16_t from = 0;
  for (Interval& interval : std::span(intervals_).first(static_cast<std::size_t>(in_use_))) {
    const I16x8 lower = splat(from);
    from = static_cast<std::int16_t>(from + interval_heights);
    const I16x8 upper = splat(from);
    std::int16_t* row_before = interval.row_before.data();
    std::int16_t* two_rows_before = interval.two_rows_before.data();
    I16x8 here = none, here_and_left = none;
    const auto take = [&](int x, I16x8 right) {
      const std::ptrdiff_t i = std::ptrdiff_t{x} * lane_count;
      const I16x8 along_row = larger(here_and_left, right);
      here_and_left = larger(here, right);
      here = right;
      share(interval, x, larger(load(two_rows_before + i), along_row));
      store(two_rows_before + i, larger(load(row_before + i), along_row));
      store(row_before + i, along_row);
    };
    for (int x = 0; x < width_ - 1;) {
      for (const int end = std::min(x + summed_in_16_bits, width_ - 1); x < end; ++x) {
        const std::ptrdiff_t right = std::ptrdiff_t{x + 1} * lane_count;
        take(x, larger(smaller(load(heights + right), upper) - larger(load(reach + right), lower),
                       none));
      }
      if (x == width_ - 1) take(x, none);
      done(interval);
    }
  }
}

// In samples, of each interval and relief, and with them what a sample is worth.
void Surroundedness::find_areas() {
  for (Interval& interval : intervals_) interval.area = {};
  I16x8 sum = splat(0);
  for (int y = 0; y <= height_; ++y) {
    surrounded_in_row(
        y, [&](const Interval&, int, I16x8 share) { sum = sum + share; },
        [&](Interval& interval) {
          interval.add_to_area(sum);
          sum = splat(0);
        });
  }
  for (Interval& interval : intervals_)
    for (std::size_t i = 0; i < interval.value.size(); ++i)
      interval.value[i] = over_root(weights_[i % most_planes], interval.area[i]);
}

void Surroundedness::sum_up() {
  find_areas();
  std::int16_t* row_sum = row_sum_.data();
  for (int y = 0; y <= height_; ++y) {
    std::fill_n(row_sum, width_ * lane_count, std::int16_t{0});
    surrounded_in_row(
        y,
        [&](const Interval& interval, int x, I16x8 share) {
          std::int16_t* sum = row_sum + std::ptrdiff_t{x} * lane_count;
          store(sum, load(sum) + times_q15(share, load(interval.value.data())));
        },
        [](const Interval&) {});
    if (y == 0) continue;
    std::int16_t* row = reduction_.row_for(surroundedness_level);
    for (int x = 0; x < width_; ++x) {
      const std::int16_t* reliefs = row_sum + std::ptrdiff_t{x} * lane_count;
      row[x] = std::accumulate(reliefs, reliefs + lane_count, std::int16_t{0});
    }
    reduction_.push(surroundedness_level, row);
  }
}

// The reduced sum, once more low-passed, into saliency_.
void Surroundedness::blur_map() {
  const ConstPlane map = reduction_.map();
  const PlaneView<std::int32_t> blurred = saliency_.view();
  for (int y = 0; y < map.height; ++y)
    std::transform(map.row(y), map.row(y) + map.width, blurred.row(y),
                   [](std::int16_t sample) { return std::int32_t{sample} << blurred_more_bits; });
  low_pass(blurred, scratch_.view());
}

PlaneView<std::int32_t> Surroundedness::saliency() {
  reach_.find(reliefs_);
  sum_up();
  blur_map();
  const PlaneView<std::int32_t> saliency = saliency_.view();
  std::int64_t largest = 0, sum = 0;
  for (int y = 0; y < saliency.height; ++y) {
    for (int x = 0; x < saliency.width; ++x) {
      largest = std::max<std::int64_t>(largest, saliency.row(y)[x]);
      sum += saliency.row(y)[x];
    }
  }
  // In a frame of twice the longer side the same things have four times the samples.
  constexpr std::int32_t one_in_map = one_in_sum << blurred_more_bits;
  const double one = one_in_map * unit_side / std::max(width_, height_);
  attention_ = {static_cast<double>(largest) / one,
                static_cast<double>(sum) / one / (saliency.width * saliency.height)};
  if (largest == 0) return saliency;
  // s (s + 1) / 2 of each share s of the largest: NSS on OSIE 0.02 more than of the share itself.
  constexpr std::int64_t half_scale = (std::int64_t{map_maximum} << conspicuity_fraction_bits) / 2;
  for (int y = 0; y < saliency.height; ++y) {
    for (int x = 0; x < saliency.width; ++x) {
      const std::int64_t sample = saliency.row(y)[x];
      saliency.row(y)[x] =
          static_cast<std::int32_t>(half_scale * sample / largest * (sample + largest) / largest);
    }
  }
  return saliency;
}

}  // namespace gazed::saliency
