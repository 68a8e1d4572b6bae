#include "agent/tracking/coarse.hpp"

#include <algorithm>
#include <cmath>

#include "agent/tracking/float4.hpp"

namespace gazed::tracking {

namespace {

// A patch whose squared contrast sums to less than this is blank: a standard deviation of 0.6 grey
// levels, where camera noise of 2 grey levels leaves 0.2.
constexpr float energy_min = 0.6F * 0.6F * static_cast<float>(coarse_area);

}  // namespace

bool normalise(CoarsePatch& patch) {
  Float4 sum{}, squares{};
  for (std::size_t i = 0; i < coarse_area; i += 4) sum += load4(&patch.value[i]);
  const float mean = sum4(sum) / static_cast<float>(coarse_area);
  for (std::size_t i = 0; i < coarse_area; i += 4) {
    const Float4 value = load4(&patch.value[i]) - mean;
    squares += value * value;
    store4(&patch.value[i], value);
  }
  const float energy = sum4(squares);
  if (!(energy > energy_min)) return false;
  const float scale = 1.0F / std::sqrt(energy);
  for (float& value : patch.value) value *= scale;
  return true;
}

CoarseView::CoarseView(int width, int height) : width_(width), height_(height) {
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  samples_.resize(size + 8);
  inverse_energy_.resize(size + 8);
  sums_.resize(static_cast<std::size_t>(width));
  squares_.resize(static_cast<std::size_t>(width));
}

void CoarseView::set(const LumaLevel& level) {
  constexpr float to_grey = 1.0F / luma_one;
  for (std::size_t i = 0; i < level.samples.size() - LumaLevel::padding; ++i) {
    samples_[i] = to_grey * static_cast<float>(level.samples[i]);
  }
  // Column sums over the patch's rows, exact in 32 bits.
  std::fill(sums_.begin(), sums_.end(), 0);
  std::fill(squares_.begin(), squares_.end(), 0);
  const auto add = [&](int y) {
    const std::uint16_t* row = level.row(y);
    for (std::size_t x = 0; x < sums_.size(); ++x) {
      const auto value = static_cast<std::int16_t>(row[x]);  // 12 bits
      sums_[x] += value;
      squares_[x] += value * value;
    }
  };
  const auto move_on_to = [&](int y) {
    const std::uint16_t *row = level.row(y), *row_before = level.row(y - coarse_side);
    for (std::size_t x = 0; x < sums_.size(); ++x) {
      const auto value = static_cast<std::int16_t>(row[x]);
      const auto before = static_cast<std::int16_t>(row_before[x]);
      sums_[x] += value - before;
      squares_[x] += value * value - before * before;
    }
  };
  for (int y = 0; y < height_; ++y) {
    if (y < coarse_side) {
      add(y);
    } else {
      move_on_to(y);
    }
    const int top = y - coarse_side + 1;
    if (top < 0) continue;
    float* out = inverse_energy_.data() + static_cast<std::ptrdiff_t>(width_) * top;
    for (int x = 0; x < places_x(); ++x) {
      const std::int32_t *s = sums_.data() + x, *q = squares_.data() + x;
      const std::int32_t sum = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
      const std::int32_t square = ((q[0] + q[1]) + (q[2] + q[3])) + ((q[4] + q[5]) + (q[6] + q[7]));
      const float mean = static_cast<float>(sum) * to_grey;
      const float energy = static_cast<float>(square) * (to_grey * to_grey) -
                           mean * mean / static_cast<float>(coarse_area);
      out[x] = 1.0F / std::max(energy, energy_min);
    }
  }
}

void CoarseView::correlate(const CoarsePatch& patch, int x, int y, int count, float* out) const {
  std::fill(out, out + count, 0.0F);
  if (y < 0 || y >= places_y()) return;
  const int begin = std::max(x, 0), end = std::min(x + count, places_x());
  for (int at = begin; at < end; at += 4) {
    // The last four places may overlap the four before them.
    const int place = std::max(std::min(at, end - 4), 0);
    const float* from = samples_.data() + static_cast<std::ptrdiff_t>(width_) * y + place;
    const float* value = patch.value.data();
    Float4 sum{};
    for (int j = 0; j < coarse_side; ++j, from += width_) {
      for (int i = 0; i < coarse_side; ++i) sum += splat4(*value++) * load4(from + i);
    }
    const Float4 magnitude = sum < 0.0F ? -sum : sum;
    const Float4 scores =
        sum * magnitude *
        load4(inverse_energy_.data() + static_cast<std::ptrdiff_t>(width_) * y + place);
    for (int i = 0; i < 4; ++i) {
      const int to = place + i;
      if (to >= begin && to < end) out[to - x] = scores[static_cast<std::size_t>(i)];
    }
  }
}

}  // namespace gazed::tracking
