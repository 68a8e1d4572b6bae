#include "agent/tracking/matcher.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::tracking {

namespace {

// Prior of the warp. A surface is rarely seen at less than 30 degrees, so the slopes of its inverse
// depth are about 0.6 of the inverse depth itself, or of 1/m where angle errors hide the depth. A
// relative angle error of 28 mrad, 20 in each look, changes the size by up to 3 % and rolls the
// picture by less than 10 mrad.
constexpr double slope_sigma = 0.6;
constexpr double inverse_depth_floor_per_m = 1.0;
constexpr double log_scale_sigma = 0.03;

// Coarse fits with less correlation are not pursued.
constexpr double coarse_correlation_min = 0.4;
// A second place counts as equally good when its misfit, 1 - correlation, is below twice the best
// one's plus noise. A few samples of a reduced image fit almost anything, so the check is repeated
// at full resolution.
constexpr double misfit_noise = 0.03;

// The rotated camera may see the patch this much larger.
constexpr double support_growth = 1.4;

bool as_good(double correlation, double best_correlation) {
  return 1.0 - correlation < 2.0 * (1.0 - best_correlation) + misfit_noise;
}

WarpPrior prior_for(const PatchWarp& warp, double radius_rad) {
  const double inverse_depth = std::hypot(warp.inverse_depth_per_m, inverse_depth_floor_per_m);
  return {slope_sigma * inverse_depth, log_scale_sigma, radius_rad * inverse_depth};
}

}  // namespace

void PatchMatcher::reserve(const geometry::CameraModel& camera) {
  const int beyond_px = 2 * static_cast<int>(support_growth * patch_half_size_max_px +
                                             4 * (1 << PlanePyramid::max_levels));
  planes_2_.reserve_full(camera.width_px, camera.height_px);
  planes_2_.reserve_reduced(camera.width_px + beyond_px, camera.height_px + beyond_px);
  search_.reserve(camera.width_px, camera.height_px);
  refinement_.reserve(PatchLevel::samples_max);
}

PatchMatcher::Outcome PatchMatcher::run(const base::ImageView& image_2, const Patch& patch,
                                        const ObjectMask& object, const PatchMotion& motion,
                                        const geometry::CameraModel& camera,
                                        const EpipolarSegment& segment, double margin_px) {
  const Problem problem{patch, motion, camera, segment};
  const int level = coarsest_useful_level(patch);
  build_planes(image_2, problem, margin_px, level + 1);
  const double separation_px = std::max(0.5 * patch.half_size_px, 2.0 * (1 << level));
  const int candidates = search_.run(patch, level, object, motion, camera, segment, margin_px,
                                     separation_px, planes_2_.level(level));
  Place best, second;
  for (int i = 0; i < candidates; ++i) {
    Place place;
    place.pixel = search_.candidate(i).pixel;
    place = refine(problem, level, place);
    if (place.fit.correlation > best.fit.correlation) std::swap(place, best);
    const bool elsewhere = (place.pixel - best.pixel).norm() > separation_px;
    if (elsewhere && place.fit.correlation > second.fit.correlation) second = place;
  }
  if (best.fit.correlation < coarse_correlation_min) {
    const geometry::Pixel &far = segment.knot(0), &near = segment.knot(EpipolarSegment::knots - 1);
    return {std::nullopt, geometry::Pixel::Zero(),
            base::text("nothing like the target within %.0f px of the line from (%.0f, %.0f) to "
                       "(%.0f, %.0f): best correlation %.2f",
                       margin_px, near.x(), near.y(), far.x(), far.y(), best.fit.correlation)};
  }
  const bool rivals = as_good(second.fit.correlation, best.fit.correlation);
  if (rivals) second = refine_to_full(problem, level, second);
  best = refine_to_full(problem, level, best);
  if (rivals && second.fit.correlation > best.fit.correlation) std::swap(best, second);
  if (rivals && (second.pixel - best.pixel).norm() > separation_px &&
      as_good(second.fit.correlation, best.fit.correlation)) {
    return {std::nullopt, geometry::Pixel::Zero(),
            base::text("ambiguous: correlation %.3f at (%.0f, %.0f) and %.3f at (%.0f, %.0f)",
                       best.fit.correlation, best.pixel.x(), best.pixel.y(), second.fit.correlation,
                       second.pixel.x(), second.pixel.y())};
  }
  return {best.fit, best.pixel, {}};
}

// Builds view 2's planes wherever the patch may lie with its reference point in the frame and near
// the segment.
void PatchMatcher::build_planes(const base::ImageView& image_2, const Problem& problem,
                                double margin_px, int levels) {
  geometry::Pixel low = problem.segment.knot(0), high = low;
  for (int i = 1; i < EpipolarSegment::knots; ++i) {
    low = low.cwiseMin(problem.segment.knot(i));
    high = high.cwiseMax(problem.segment.knot(i));
  }
  const Eigen::Array2d last(problem.camera.width_px - 1, problem.camera.height_px - 1);
  const double support_px = support_growth * problem.patch.half_size_px + 4.0 * (1 << (levels - 1));
  const Eigen::Array2i begin =
      ((low.array() - margin_px).max(0.0).min(last) - support_px).floor().cast<int>();
  const Eigen::Array2i end =
      ((high.array() + margin_px).max(0.0).min(last) + support_px).ceil().cast<int>() + 1;
  planes_2_.build(image_2, problem.patch.axis, {begin.x(), begin.y(), end.x(), end.y()}, levels);
}

// Refines on one level, starting from the inverse depth that the current place implies. A fit that
// fails has correlation 0.
PatchMatcher::Place PatchMatcher::refine(const Problem& problem, int level, const Place& start) {
  const auto& [patch, motion, camera, segment] = problem;
  Place place{{}, start.pixel};
  auto warp = warp_to(motion, camera, segment, start.pixel);
  if (!warp) return place;
  warp->slope_per_m = start.fit.warp.slope_per_m;
  warp->log_scale = start.fit.warp.log_scale;
  warp->relief_per_m = start.fit.warp.relief_per_m;
  place.fit = refinement_.run(patch.levels[static_cast<std::size_t>(level)], planes_2_.level(level),
                              motion, camera, prior_for(*warp, patch.relief.radius_rad()), *warp);
  const auto pixel = motion.reference_in_view_2(camera, place.fit.warp);
  if (!pixel) return {{}, start.pixel};
  place.pixel = *pixel;
  return place;
}

PatchMatcher::Place PatchMatcher::refine_to_full(const Problem& problem, int from_level,
                                                 Place place) {
  for (int level = from_level - 1; level >= 0; --level) place = refine(problem, level, place);
  return place;
}

}  // namespace gazed::tracking
