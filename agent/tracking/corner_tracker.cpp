#include "agent/tracking/corner_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace gazed::tracking {

namespace {

// How far a level may move from where the coarser level put the patch, samples.
constexpr float half_size_reach = 3.0F, full_size_reach = 2.0F;
constexpr float half_size_correlation_min = 0.7F, correlation_min = 0.8F;
// A corner is ambiguous when another place matches it to within this correlation.
constexpr float ambiguity_margin = 0.04F;
constexpr double same_place_px = 2.0;
// Forward-backward check (Kalal, Mikolajczyk, Matas, ICPR 2010): 98 % of the right matches return
// to within 0.06 px.
constexpr double round_trip_max_px = 0.4;

// Smoothing and interpolation leave correlated noise in both views: see refine.cpp.
constexpr double noise_correlation = 6.0;
// Sampling error.
constexpr double sampling_sigma_px = 0.03;

Eigen::Vector2f samples(const geometry::Pixel& pixel, const LumaLevel& level) {
  return (pixel / level.step_px).cast<float>();
}
geometry::Pixel pixels(const Eigen::Vector2f& at, const LumaLevel& level) {
  return at.cast<double>() * level.step_px;
}

}  // namespace

std::optional<geometry::Pixel> CornerTracker::best_at_half_size(
    const LumaLevel& view_1, const LumaLevel& view_2, const geometry::Pixel& pixel_1,
    const Eigen::Matrix2f& back, std::span<const geometry::Pixel> starts) {
  if (!make_template(view_1, samples(pixel_1, view_1), back, half_size_)) return std::nullopt;
  geometry::Pixel best = geometry::Pixel::Zero();
  float first = 0.0F, second = 0.0F;  // correlations
  for (const geometry::Pixel& start : starts) {
    const auto flow = find_patch(half_size_, view_2, samples(start, view_2), half_size_reach);
    if (!flow) continue;
    const geometry::Pixel place = pixels(flow->at, view_2);
    if (first > 0.0F && (place - best).norm() < same_place_px) continue;
    if (flow->correlation > first) {
      second = first;
      first = flow->correlation;
      best = place;
    } else {
      second = std::max(second, flow->correlation);
    }
  }
  if (first < half_size_correlation_min || second > first - ambiguity_margin) return std::nullopt;
  return best;
}

std::optional<TrackedCorner> CornerTracker::track(const LumaPyramid& view_1,
                                                  const LumaPyramid& view_2,
                                                  const geometry::Pixel& pixel_1,
                                                  const Eigen::Matrix2d& shape,
                                                  std::span<const geometry::Pixel> starts) {
  const Eigen::Matrix2d back = shape.inverse();
  const auto start =
      best_at_half_size(view_1.level(1), view_2.level(1), pixel_1, back.cast<float>(), starts);
  if (!start) return std::nullopt;

  const LumaLevel &full_1 = view_1.level(0), &full_2 = view_2.level(0);
  if (!make_template(full_1, samples(pixel_1, full_1), back.cast<float>(), full_size_)) {
    return std::nullopt;
  }
  const auto forth = find_patch(full_size_, full_2, samples(*start, full_2), full_size_reach);
  if (!forth || forth->correlation < correlation_min) return std::nullopt;
  const geometry::Pixel pixel_2 = pixels(forth->at, full_2);
  const float steepness =
      full_size_.information.trace() / static_cast<float>(FlowTemplate<12>::area);

  // Track back, starting as far off as on the way here.
  if (!make_template(full_2, forth->at, shape.cast<float>(), full_size_)) return std::nullopt;
  const geometry::Pixel back_start = pixel_1 + back * (pixel_2 - *start);
  const auto returned =
      find_patch(full_size_, full_1, samples(back_start, full_1), full_size_reach);
  if (!returned || (pixels(returned->at, full_1) - pixel_1).norm() > round_trip_max_px) {
    return std::nullopt;
  }
  const double variance = noise_correlation * static_cast<double>(forth->variance);
  return TrackedCorner{pixel_2, variance + sampling_sigma_px * sampling_sigma_px, forth->misfit,
                       steepness};
}

}  // namespace gazed::tracking
