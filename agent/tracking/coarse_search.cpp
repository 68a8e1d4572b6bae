#include "agent/tracking/coarse_search.hpp"

#include <algorithm>
#include <cmath>

namespace gazed::tracking {

namespace {

// More voters would not change the shift.
constexpr std::size_t voters_max = 20;
// Squared correlations below this occur by chance.
constexpr float vote_score_min = 0.36F;
constexpr float peak_score_min = 0.3F;
// What a shift of the full reach costs, as a share of the largest vote. Depths are unknown, so a
// shift along the epipolar lines is as good as another depth of everything, and in a room of equal
// tiles every tile fits: prefer small shifts.
constexpr float shift_cost = 0.35F;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}
int rounded(float value) {
  return static_cast<int>(std::lround(value));
}

}  // namespace

CoarseSearch::CoarseSearch(int width, int height) : view_(width, height) {
  // Lines reach at most this far outside the view, at either end.
  const int around = 4 * reach_max + 8;
  scores_.resize(index((width + around) * (height + around)));
  const int shifts = 2 * reach_max + 1;
  best_.resize(index(shifts * shifts));
  votes_.resize(index(shifts * shifts));
}

Eigen::Vector2f CoarseSearch::common_shift(std::span<const CoarseQuery> queries, int reach) {
  reach = std::clamp(reach, 1, reach_max);
  const int side = 2 * reach + 1;
  std::fill(votes_.begin(), votes_.end(), 0.0F);
  const std::size_t step = std::max<std::size_t>(1, queries.size() / voters_max);
  for (std::size_t i = step / 2; i < queries.size(); i += step) vote(queries[i], reach);

  const auto shifts = static_cast<std::ptrdiff_t>(side * side);
  const float full = *std::max_element(votes_.begin(), votes_.begin() + shifts);
  Eigen::Vector2f best_shift = Eigen::Vector2f::Zero();
  float best = votes_[index(reach * side + reach)];
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const auto cost =
          shift_cost * full * static_cast<float>(u * u + v * v) / static_cast<float>(reach * reach);
      const float total = votes_[index((v + reach) * side + u + reach)] - cost;
      if (total > best) {
        best = total;
        best_shift = {static_cast<float>(u), static_cast<float>(v)};
      }
    }
  }
  return best_shift;
}

// Records, for every shift, the best correlation along the line.
void CoarseSearch::vote(const CoarseQuery& query, int reach) {
  const int side = 2 * reach + 1;
  const Eigen::Vector2f near = query.far + query.span;
  const Eigen::Vector2f low = query.far.cwiseMin(near), high = query.far.cwiseMax(near);
  const int x_begin = rounded(low.x()) - reach, y_begin = rounded(low.y()) - reach;
  const int width = rounded(high.x()) + reach + 1 - x_begin;
  const int height = rounded(high.y()) + reach + 1 - y_begin;
  if (index(width * height) > scores_.size()) return;
  for (int y = 0; y < height; ++y) {
    view_.correlate(query.patch, x_begin, y_begin + y, width, scores_.data() + y * width);
  }
  const auto size = index(side * side);
  std::fill_n(best_.begin(), size, 0.0F);
  const int steps = std::max(1, rounded(query.span.cwiseAbs().maxCoeff()));
  for (int k = 0; k <= steps; ++k) {
    const Eigen::Vector2f place =
        query.far + static_cast<float>(k) / static_cast<float>(steps) * query.span;
    const int x = rounded(place.x()) - reach - x_begin, y = rounded(place.y()) - reach - y_begin;
    for (int v = 0; v < side; ++v) {
      const float* from = scores_.data() + (y + v) * width + x;
      float* best = best_.data() + v * side;
      for (int u = 0; u < side; ++u) best[u] = best[u] > from[u] ? best[u] : from[u];
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    votes_[i] += std::max(best_[i] - vote_score_min, 0.0F);
  }
}

std::span<const CoarsePeak> CoarseSearch::peaks(const CoarseQuery& query,
                                                const Eigen::Vector2f& shift, float half_width) {
  peak_count_ = 0;
  const Eigen::Vector2f from = query.far + shift, to = from + query.span;
  const Eigen::Vector2f low = from.cwiseMin(to), high = from.cwiseMax(to);
  // One extra place on every side, since maxima need neighbours.
  const int x_begin = static_cast<int>(std::floor(low.x() - half_width)) - 1;
  const int y_begin = static_cast<int>(std::floor(low.y() - half_width)) - 1;
  const Box box{x_begin, y_begin, static_cast<int>(std::ceil(high.x() + half_width)) + 2 - x_begin,
                static_cast<int>(std::ceil(high.y() + half_width)) + 2 - y_begin};
  if (index(box.width * box.height) > scores_.size()) return {};
  correlate_strip(query, from, half_width, box);
  collect_peaks(box);
  return {peaks_.data(), peak_count_};
}

// Scores the places near the line; the rest of the box gets 0.
void CoarseSearch::correlate_strip(const CoarseQuery& query, const Eigen::Vector2f& from,
                                   float half_width, const Box& box) {
  const Eigen::Vector2f& span = query.span;
  std::fill_n(scores_.begin(), box.width * box.height, 0.0F);
  for (int y = 1; y + 1 < box.height; ++y) {
    // The part of the line near this row.
    const float offset = static_cast<float>(box.y_begin + y) - from.y();
    float first = 0.0F, last = 1.0F;
    if (std::abs(span.y()) > 1e-3F) {
      const float a = (offset - half_width) / span.y(), b = (offset + half_width) / span.y();
      first = std::clamp(std::min(a, b), 0.0F, 1.0F);
      last = std::clamp(std::max(a, b), 0.0F, 1.0F);
    }
    const float xa = from.x() + first * span.x(), xb = from.x() + last * span.x();
    const int begin = static_cast<int>(std::floor(std::min(xa, xb) - half_width)) - box.x_begin;
    const int end = static_cast<int>(std::ceil(std::max(xa, xb) + half_width)) - box.x_begin + 1;
    view_.correlate(query.patch, box.x_begin + begin, box.y_begin + y, end - begin,
                    scores_.data() + y * box.width + begin);
  }
}

void CoarseSearch::collect_peaks(const Box& box) {
  const int width = box.width;
  // Vertex of the parabola through a maximum and its two neighbours on one axis.
  const auto top = [](float before, float s, float after) {
    return before > 0.0F && after > 0.0F ? 0.5F * (before - after) / (before - 2.0F * s + after)
                                         : 0.0F;
  };
  for (int y = 1; y + 1 < box.height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const float* at = scores_.data() + y * width + x;
      const float s = *at;
      if (s < peak_score_min) continue;
      if (s < at[-1] || s <= at[1] || s < at[-width] || s <= at[width] || s < at[-width - 1] ||
          s < at[-width + 1] || s <= at[width - 1] || s <= at[width + 1]) {
        continue;
      }
      enter({{static_cast<float>(box.x_begin + x) + top(at[-1], s, at[1]),
              static_cast<float>(box.y_begin + y) + top(at[-width], s, at[width])},
             s});
    }
  }
}

// Inserts a peak into the list, best first.
void CoarseSearch::enter(const CoarsePeak& peak) {
  std::size_t place = 0;
  while (place < peak_count_ && peaks_[place].score >= peak.score) ++place;
  if (place == peaks_max) return;
  peak_count_ = std::min(peak_count_ + 1, peaks_max);
  std::move_backward(peaks_.begin() + static_cast<std::ptrdiff_t>(place),
                     peaks_.begin() + static_cast<std::ptrdiff_t>(peak_count_) - 1,
                     peaks_.begin() + static_cast<std::ptrdiff_t>(peak_count_));
  peaks_[place] = peak;
}

}  // namespace gazed::tracking
