#include "agent/triangulation/fusion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "agent/base/text.hpp"
#include "agent/triangulation/chi_square.hpp"
#include "agent/triangulation/estimate.hpp"
#include "agent/triangulation/judgement.hpp"
#include "agent/triangulation/pair_errors.hpp"
#include "agent/triangulation/pairs.hpp"
#include "agent/triangulation/solution.hpp"

namespace gazed::triangulation {

namespace {

/// Noise that is one and the same in all pairs has a singular covariance.
PairMatrix regular(PairMatrix covariance) {
  constexpr double share = 1e-9;
  covariance.diagonal().array() += share * covariance.diagonal().mean();
  return covariance;
}

/// Weights of the mean with the least variance, which sum to one.
PairVector best_weights(const PairMatrix& covariance) {
  const PairVector ones = PairVector::Ones(covariance.rows());
  const PairVector information = regular(covariance).ldlt().solve(ones);
  const double total = information.sum();
  // Without any noise the pairs agree, and every weight will do.
  if (!information.allFinite() || !(total > 0.0)) return ones / static_cast<double>(ones.size());
  return information / total;
}

/// Chi-square of `values` about their own best mean; `without` is left out.
double chi2_about_the_mean(const PairVector& values, const PairMatrix& covariance,
                           std::optional<Eigen::Index> without) {
  const Eigen::Index size = values.size() - (without ? 1 : 0);
  const auto original = [&](Eigen::Index i) { return without && i >= *without ? i + 1 : i; };
  PairVector kept(size);
  PairMatrix kept_covariance(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    kept(i) = values(original(i));
    for (Eigen::Index j = 0; j < size; ++j) {
      kept_covariance(i, j) = covariance(original(i), original(j));
    }
  }
  const PairVector off = kept.array() - best_weights(kept_covariance).dot(kept);
  return off.dot(regular(kept_covariance).ldlt().solve(off));
}

class Fusion {
 public:
  explicit Fusion(const Gate& gate) : gate_(gate) {}

  void add(const Pair& pair) { pairs_[count_++] = pair; }
  [[nodiscard]] std::span<const Pair> pairs() const { return {pairs_.data(), count_}; }

  /// Everything is linearised at one point, the mean by information: the pairs' own points would
  /// make the weights depend on the noise.
  void linearise() {
    const geometry::InverseDepthPoint mean = mean_by_information(pairs());
    for (std::size_t k = 0; k < count_; ++k) {
      const TwoViews& views = pairs_[k].observation.views;
      errors_[k] = PairErrors(views, pairs_[k].observation.errors,
                              solution_at(mean, methods::Method::optimal, views).value());
    }
    covariance_ = joint_covariance({errors_.data(), count_});
  }

  /// Of the inverse ranges about their mean, with the errors of calibration, which the pairs need
  /// not feel alike.
  [[nodiscard]] double chi2(std::optional<Eigen::Index> without = {}) const {
    PairVector inverse_ranges(static_cast<Eigen::Index>(count_));
    for (std::size_t k = 0; k < count_; ++k) {
      inverse_ranges(static_cast<Eigen::Index>(k)) = inverse_range(pairs_[k].point);
    }
    return chi2_about_the_mean(inverse_ranges, covariance_.noise + covariance_.calibration,
                               without);
  }
  [[nodiscard]] bool agree() const {
    return count_ < 2 || !(chi2() > chi2_999_of(static_cast<int>(count_) - 1));
  }

  /// Removes the pair without which the others agree best. Returns its look and what it added to
  /// the chi-square.
  struct Dropped {
    std::size_t look;
    double chi2;
  };
  Dropped drop_worst() {
    std::size_t worst = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k) {
      const double rest = chi2(static_cast<Eigen::Index>(k));
      if (rest < least) {
        least = rest;
        worst = k;
      }
    }
    const Dropped out{pairs_[worst].look, chi2() - least};
    for (std::size_t k = worst + 1; k < count_; ++k) pairs_[k - 1] = pairs_[k];
    --count_;
    return out;
  }

  /// What is known without a position.
  [[nodiscard]] PointEstimate seen() const {
    PointEstimate out;
    double squared_px2 = 0.0;
    out.parallax_rad = 0.0;
    for (const Pair& pair : pairs()) {
      out.parallax_rad = std::max(out.parallax_rad, pair.estimate.parallax_rad);
      squared_px2 += pair.estimate.residual_px * pair.estimate.residual_px;
    }
    out.residual_px = std::sqrt(squared_px2 / static_cast<double>(count_));
    return out;
  }

  [[nodiscard]] PointEstimate fused() const {
    const PairVector weights = best_weights(covariance_.noise);
    const geometry::InverseDepthPoint point = weighted_mean(pairs(), weights);
    const auto& torso_from_cam1 = pairs_.front().observation.views.torso_from_cam1;
    CovarianceSum sum(point, torso_from_cam1);
    add_fused({errors_.data(), count_}, weights, sum);
    const Propagated propagated = sum.result();
    PointEstimate out = seen();
    out.inverse_range_per_m = propagated.inverse_range_per_m;
    out.inverse_range_sigma_per_m = propagated.inverse_range_sigma_per_m;
    if (out.inverse_range_per_m < -out.inverse_range_sigma_per_m) {
      out.status = Status::behind_camera;
      out.reason = base::text("the rays meet behind camera 1: inverse range %.3f +- %.3f 1/m",
                              out.inverse_range_per_m, out.inverse_range_sigma_per_m);
    } else {
      judge_sigma(point, propagated, torso_from_cam1, gate_, out);
    }
    return out;
  }

 private:
  Gate gate_;
  std::array<Pair, pairs_max> pairs_;
  std::array<PairErrors, pairs_max> errors_;
  std::size_t count_ = 0;
  JointCovariance covariance_;
};

/// Drops looks until the others agree; false when too few would be left to know who is right.
bool settle(Fusion& fusion, FusedEstimate& out, std::string& left_out) {
  std::size_t dropped = 0;
  for (fusion.linearise(); !fusion.agree(); fusion.linearise()) {
    if (fusion.pairs().size() <= dropped + 2) return false;
    const auto [look, chi2] = fusion.drop_worst();
    ++dropped;
    out.looks[look].used = false;
    out.looks[look].status = Status::target_lost;
    out.looks[look].chi2 = chi2;
    left_out += base::text("; look %zu left out: the others contradict it, chi-square %.1f",
                           look + 1, chi2);
  }
  return true;
}

}  // namespace

FusedEstimate fuse_looks(const geometry::HeadGeometry& head, const geometry::CameraModel& camera,
                         const geometry::Uncertainty& uncertainty, std::span<const Look> looks,
                         const Gate& gate) {
  if (looks.size() < 2 || looks.size() > looks_max) {
    throw std::invalid_argument(
        base::text("%zu looks; 2 to %zu can be fused", looks.size(), looks_max));
  }
  FusedEstimate out;
  Fusion fusion(gate);
  std::string left_out;
  for (std::size_t k = 1; k < looks.size(); ++k) {
    const TwoLooks pair{looks[0].head, looks[k].head, looks[0].pixel, looks[k].pixel,
                        looks[k].covariance_px2};
    const PointEstimate estimate = estimate_point(head, camera, uncertainty, pair, gate);
    LookVerdict& verdict = out.looks[k];
    verdict.status = estimate.status;
    verdict.inverse_range_per_m = estimate.inverse_range_per_m;
    verdict.inverse_range_sigma_per_m = estimate.inverse_range_sigma_per_m;
    const auto observation = observe(head, camera, uncertainty, pair);
    const auto comparable = observation ? comparable_pair(*observation, k, estimate) : std::nullopt;
    if (comparable) {
      verdict.used = true;
      fusion.add(*comparable);
      continue;
    }
    left_out += base::text("; look %zu left out: %s", k + 1, estimate.reason.c_str());
    if (k == 1 || came_further(estimate.status, out.estimate.status)) out.estimate = estimate;
  }
  if (fusion.pairs().empty()) return out;

  if (!settle(fusion, out, left_out)) {
    out.estimate = fusion.seen();
    out.estimate.status = Status::target_lost;
    out.estimate.reason =
        base::text("%zu pairs of looks contradict each other, chi-square %.1f: not one point",
                   fusion.pairs().size(), fusion.chi2()) +
        left_out;
    out.chi2 = fusion.chi2();
    for (const Pair& pair : fusion.pairs()) out.looks[pair.look].used = false;
    return out;
  }
  // A single pair needs no weights, and its own answer is exact to the last bit.
  const bool one_pair = fusion.pairs().size() == 1;
  out.estimate = one_pair ? fusion.pairs().front().estimate : fusion.fused();
  out.estimate.reason += left_out;
  out.looks[0].used = true;
  out.looks[0].status = out.estimate.status;
  out.looks_used = fusion.pairs().size() + 1;
  out.degrees_of_freedom = static_cast<int>(fusion.pairs().size()) - 1;
  out.chi2 = one_pair ? 0.0 : fusion.chi2();
  return out;
}

}  // namespace gazed::triangulation
