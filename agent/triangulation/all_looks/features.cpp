#include "agent/triangulation/all_looks/features.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

#include "agent/triangulation/chi_square.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// Looks in which the feature has a pixel that the camera can have.
LookSet seen_in(const FeatureObservations& observed, LookSet looks,
                const geometry::CameraModel& camera) {
  LookSet out = 0;
  for (std::size_t k = 0; k < looks_max; ++k) {
    if (contains(looks, k) && camera.contains(observed.pixel[k])) out |= only_look(k);
  }
  return out;
}

bool is_usable(LookSet seen) {
  return contains(seen, 0) && std::popcount(seen) >= 2;
}

/// The inverse depth along the ray that fits the later looks' pixels, by two steps from infinity:
/// the pixels depend on it almost linearly.
double triangulate(const Problem::Feature& feature, const Robot& robot,
                   geometry::InverseDepthPoint point) {
  for (int step = 0; step < 2; ++step) {
    double information = 0.0, gradient = 0.0;
    for (std::size_t k = 1; k < looks_max; ++k) {
      PointInLook seen;
      if (!contains(feature.seen, k) ||
          !robot.see(k, point, feature.observed->pixel[k].y(), seen)) {
        continue;
      }
      const Eigen::Vector2d by_depth = seen.by_point.col(2);
      information += by_depth.squaredNorm();
      gradient += by_depth.dot(seen.pixel - feature.observed->pixel[k]);
    }
    if (!(information > 0.0)) break;
    // At least 5 cm away.
    point.inverse_depth_per_m =
        std::clamp(point.inverse_depth_per_m - gradient / information, 0.0, 20.0);
  }
  return point.inverse_depth_per_m;
}

/// One feature's pixels, linearised at its current place, in standard deviations.
class Pixels {
 public:
  Pixels(const Problem& problem, const Robot& robot, std::size_t index,
         const geometry::InverseDepthPoint& point) {
    const Problem::Feature& feature = problem.features[index];
    const double per_px = 1.0 / (feature.sigma_px * problem.feature_scale);
    for (std::size_t k = 0; k < problem.looks; ++k) {
      PointInLook seen;
      if (!contains(feature.seen, k) ||
          !robot.see(k, point, feature.observed->pixel[k].y(), seen)) {
        continue;
      }
      set_ |= only_look(k);
      residual_[k] = per_px * (seen.pixel - feature.observed->pixel[k]);
      by_point_[k] = per_px * seen.by_point;
    }
  }

  [[nodiscard]] LookSet set() const { return set_; }

  /// The smallest chi-square that any point gives these pixels.
  [[nodiscard]] double chi2(LookSet set) const {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    information(2, 2) = std::pow(feature_inverse_depth_sigma_per_m, -2);
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    double sum = 0.0;
    for (std::size_t k = 0; k < looks_max; ++k) {
      if (!contains(set, k)) continue;
      information += by_point_[k].transpose() * by_point_[k];
      gradient += by_point_[k].transpose() * residual_[k];
      sum += residual_[k].squaredNorm();
    }
    return sum - gradient.dot(information.inverse() * gradient);
  }

 private:
  LookSet set_ = 0;
  std::array<Eigen::Vector2d, looks_max> residual_;
  std::array<Eigen::Matrix<double, 2, 3>, looks_max> by_point_;
};

/// Two coordinates per pixel, three unknowns per point.
int degrees_of_freedom(LookSet set) {
  return 2 * std::popcount(set) - 3;
}

struct Agreeing {
  LookSet set = 0;
  double chi2 = 0.0;
};

Agreeing agreeing(const Pixels& pixels) {
  Agreeing out{pixels.set(), pixels.chi2(pixels.set())};
  const int later = std::popcount(out.set) - 1;
  while (!(out.chi2 <= chi2_999_of(degrees_of_freedom(out.set)))) {
    const int left = std::popcount(out.set) - 2, gone = later - left;
    if (left <= gone) return {};
    Agreeing best;
    for (std::size_t k = 1; k < looks_max; ++k) {
      if (!contains(out.set, k)) continue;
      const auto without = static_cast<LookSet>(out.set & ~only_look(k));
      const double chi2 = pixels.chi2(without);
      if (best.set == 0 || chi2 < best.chi2) best = {without, chi2};
    }
    out = best;
  }
  return out;
}

}  // namespace

void add_features(std::span<const FeatureObservations> features, LookSet looks, Problem& problem,
                  State& state) {
  const Robot robot(problem, state.robot);
  for (const FeatureObservations& observed : features) {
    const LookSet seen = seen_in(observed, looks, problem.rig.camera);
    if (!is_usable(seen) || !(observed.sigma_px >= 0.0) || !std::isfinite(observed.sigma_px))
      continue;
    const auto direction = geometry::normalise(problem.rig.camera, observed.pixel[0]);
    if (!direction) continue;
    // A later pixel compared with the first has the noise of both.
    const double sigma_px = std::max(registration_sigma_min_px, observed.sigma_px / std::sqrt(2.0));
    const std::size_t index = problem.feature_count++;
    problem.features[index] = {
        .observed = &observed, .sigma_px = sigma_px, .seen = seen, .kept = seen};
    state.features[index] = {*direction, 0.0};
    state.features[index].inverse_depth_per_m =
        triangulate(problem.features[index], robot, state.features[index]);
  }
}

double typical_scale(const Problem& problem, const State& state) {
  const Robot robot(problem, state.robot);
  std::array<double, features_max> ratios;
  std::size_t count = 0;
  for (std::size_t i = 0; i < problem.feature_count; ++i) {
    const Pixels pixels(problem, robot, i, state.features[i]);
    const double degrees = degrees_of_freedom(pixels.set());
    if (degrees < 1.0) continue;
    // Median of chi-square (Wilson and Hilferty 1931).
    const double median = degrees * std::pow(1.0 - 2.0 / (9.0 * degrees), 3);
    ratios[count++] = pixels.chi2(pixels.set()) / median;
  }
  if (count == 0) return 1.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(ratios.begin(), middle, ratios.begin() + static_cast<std::ptrdiff_t>(count));
  return problem.feature_scale * std::sqrt(std::max(1.0, *middle));
}

FeatureAgreement keep_agreeing(Problem& problem, const State& state) {
  const Robot robot(problem, state.robot);
  FeatureAgreement out;
  double chi2 = 0.0;
  int degrees = 0;
  for (std::size_t i = 0; i < problem.feature_count; ++i) {
    Problem::Feature& feature = problem.features[i];
    const Agreeing kept = agreeing(Pixels(problem, robot, i, state.features[i]));
    const LookSet set = !feature.behind && is_usable(kept.set) ? kept.set : LookSet{0};
    out.changed = out.changed || set != feature.kept;
    feature.kept = set;
    out.pixels_seen += std::popcount(feature.seen) - 1;
    if (set == 0) continue;
    out.pixels_kept += std::popcount(set) - 1;
    chi2 += kept.chi2;
    degrees += degrees_of_freedom(set);
  }
  const double scale_2 = chi2 * problem.feature_scale * problem.feature_scale;
  if (degrees > 0) out.scale = std::sqrt(std::max(1.0, scale_2 / degrees));
  return out;
}

}  // namespace gazed::triangulation::all_looks
