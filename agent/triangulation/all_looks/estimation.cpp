#include "agent/triangulation/all_looks/estimation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/geometry/cholesky.hpp"
#include "agent/triangulation/all_looks/features.hpp"
#include "agent/triangulation/all_looks/refinement.hpp"
#include "agent/triangulation/all_looks/torso_level.hpp"

namespace gazed::triangulation::all_looks {

namespace {

// If the features' residuals exceed their sigmas by this factor overall and the target's looks
// contradict each other, the model behind both is wrong, most likely that of the lens: the features
// are then left out. Rooms seen through a correctly modelled lens give 1.0, a lens that is off by
// 1.6 px in the corners gives 1.2 and more.
constexpr double misfit_scale = 1.1;
// -2 log of how likely a wrong pixel is, relative to a right one: 3 % of the pixels are wrong, and
// anywhere within some 10 px, where right ones have a sigma of 0.1 px.
constexpr double badness_of_wrong_pixel = 25.0;

}  // namespace

Estimation::Estimation(const geometry::Rig& rig, std::span<const Look> looks, const Gate& gate)
    : gate_(gate), looks_(looks) {
  problem_.rig = rig;
  problem_.looks = looks.size();
  for (std::size_t k = 0; k < looks.size(); ++k) {
    problem_.measured[k] = looks[k].head;
    problem_.sweep[k] = looks[k].sweep;
    problem_.sweep_sigma_rad[k] = looks[k].sweep_sigma_rad;
    const double row_px = looks[k].pixel.y();
    const double middle_px = 0.5 * (rig.camera.height_px - 1);  // for a look without the target
    problem_.row_px[k] = std::isfinite(row_px) ? row_px : middle_px;
  }
  for (std::size_t k = 1; k < looks.size(); ++k) judge_pair(k);
  if (later_looks(valid_) == 0) return;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    if (contains(valid_, k)) problem_.target[k] = target_observation(k);
  }
}

void Estimation::judge_pair(std::size_t k) {
  const TwoLooks pair{looks_[0].head, looks_[k].head, looks_[0].pixel, looks_[k].pixel,
                      looks_[k].covariance_px2};
  pair_[k].estimate = estimate_point(problem_.rig, pair, gate_);
  if (std::isfinite(looks_[k].head.yaw_rad) && std::isfinite(looks_[k].head.pitch_rad)) {
    finite_ |= only_look(k);
  }
  if (pair_[k].estimate.status == Status::invalid_input) return;
  valid_ |= only_look(k);
  if (pair_[k].estimate.status == Status::target_lost) return;
  uncontradicted_ |= only_look(k);
  const auto observation = observe(problem_.rig, pair);
  pair_[k].point = comparable_point(observation.value(), pair_[k].estimate);
}

Problem::TargetObservation Estimation::target_observation(std::size_t k) const {
  // Look 1's pixel defines the point. The noise of finding it again belongs to the later look.
  const double sigma_px =
      k == 0 ? registration_sigma_min_px
             : std::max(registration_sigma_min_px, problem_.rig.uncertainty.pixel_sigma_px);
  Eigen::Matrix2d covariance = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  if (k > 0) covariance = target_scale_ * target_scale_ * (covariance + looks_[k].covariance_px2);
  return {looks_[k].pixel, covariance, geometry::whitening(covariance)};
}

TorsoSigma Estimation::loosest_torso() const {
  const geometry::Uncertainty& sigmas = problem_.rig.uncertainty;
  if (!(sigmas.torso_rotation_sigma_rad > 0.0 && sigmas.torso_translation_sigma_m > 0.0)) return {};
  return {sigmas.torso_rotation_sigma_rad, sigmas.torso_translation_sigma_m};
}

/// Starts from the configured robot and from the pairs' estimates of the target.
void Estimation::start(LookSet target_looks, TorsoSigma loosest) {
  widen_target(1.0);
  problem_.target_kept = target_looks;
  problem_.torso = loosest;
  problem_.feature_count = 0;
  problem_.feature_scale = 1.0;
  contradiction_chi2_.fill(not_a_number);
  state_.robot.setZero(problem_.robot_unknowns());
  anchor_sweeps(state_.robot, problem_);
  state_.target.inverse_depth_per_m =
      mean_inverse_depth_per_m(std::span(pair_).subspan(1, looks_.size() - 1));
  state_.target.direction = geometry::normalise(problem_.rig.camera, looks_[0].pixel).value();
}

Estimate Estimation::estimate(std::span<const FeatureObservations> features) {
  Estimate out;
  out.head = out.reading = problem_.measured;
  out.robot = believed_before(problem_.rig);
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    out.looks[k].status = pair_[k].estimate.status;
    out.looks[k].inverse_range_per_m = pair_[k].estimate.inverse_range_per_m;
    out.looks[k].inverse_range_sigma_per_m = pair_[k].estimate.inverse_range_sigma_per_m;
  }
  if (later_looks(valid_) == 0 || !estimate_with(features, out)) estimate_without_features(out);
  return out;
}

bool Estimation::estimate_with(std::span<const FeatureObservations> features, Estimate& out) {
  const auto agreement = solve_likeliest(features);
  if (problem_.feature_count < features_min) return false;
  out.refinement = Refinement::distrusted;
  out.features_rejected = problem_.feature_count;
  if (!agreement) return false;
  Estimate with = out;
  settle_and_answer(0, with);
  if (with.point.status == Status::target_lost && believe_that_it_moves()) {
    with = out;
    settle_and_answer(0, with);
    with.point.reason += base::text(
        "; the looks differ by %.1f times what was expected: the object may move", target_scale_);
  }
  const bool misfit =
      problem_.feature_scale > misfit_scale && with.point.status == Status::target_lost;
  if (misfit || !is_plausible(problem_, state_, *agreement)) return false;
  out = std::move(with);
  out.refinement = Refinement::used;
  out.features_used = problem_.features_kept();
  out.features_rejected = problem_.feature_count - out.features_used;
  for (const Problem::Feature& feature : std::span(problem_.features).first(problem_.feature_count))
    out.feature_used_in[static_cast<std::size_t>(feature.observed - features.data())] =
        feature.kept;
  return true;
}

void Estimation::widen_target(double scale) {
  target_scale_ = scale;
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    if (contains(valid_, k)) problem_.target[k] = target_observation(k);
  }
}

/// Solves with a torso that moves by at most `loosest`, and chooses its level.
std::optional<Estimation::Solved> Estimation::solve_with(
    std::span<const FeatureObservations> features, TorsoSigma loosest) {
  start(valid_, loosest);
  add_features(features, finite_, problem_, state_);
  if (problem_.feature_count < features_min) return std::nullopt;
  const auto agreement = solve_with_features(problem_, state_, solver_);
  // Once more at the end: the features' scale has changed since, and costs are compared.
  if (!agreement || !choose_torso() || !solver_.solve(Loss::squares)) return std::nullopt;
  const int wrong = agreement->pixels_seen - agreement->pixels_kept;
  const double of_scale = 4.0 * agreement->pixels_kept * std::log(problem_.feature_scale);
  const double badness = solver_.badness() + of_scale + badness_of_wrong_pixel * wrong;
  return Solved{keep_agreeing(problem_, state_), badness};
}

/// A torso that may move explains a few wrong pixels, too, and the level that it needs for that is
/// a loose one. So where the torso seems to move, the looks are solved twice more, from the start
/// and leaving out other pixels: with a torso that stands still, and with one that moves by no more
/// than was found. The likeliest of the three is taken.
std::optional<FeatureAgreement> Estimation::solve_likeliest(
    std::span<const FeatureObservations> features) {
  auto best = solve_with(features, loosest_torso());
  if (!best) return std::nullopt;
  const TorsoSigma stillest = stillest_torso(problem_);
  if (problem_.torso == stillest) return best->agreement;
  Problem best_problem = problem_;
  State best_state = state_;
  for (const TorsoSigma loosest : {stillest, below_loosest(problem_)}) {
    const auto other = solve_with(features, loosest);
    if (!other || other->badness >= best->badness) continue;
    best = other;
    best_problem = problem_;
    best_state = state_;
    if (problem_.torso == stillest) break;
  }
  problem_ = best_problem;
  state_ = best_state;
  return solver_.make_information() ? std::optional(best->agreement) : std::nullopt;
}

/// Goes from the loosest level to the likeliest. Returns false if there is no solution.
bool Estimation::choose_torso() {
  if (!problem_.torso.may_move()) return true;
  const auto torso = likeliest_torso(problem_, state_, solver_.torso_covariance());
  if (!torso) return false;
  solver_.tighten_torso(torso->sigma, torso->pull);
  return solver_.solve(Loss::squares);
}

void Estimation::estimate_without_features(Estimate& out) {
  if (later_looks(uncontradicted_) == 0) {
    std::size_t furthest = 1;
    for (std::size_t k = 2; k < looks_.size(); ++k) {
      if (came_further(pair_[k].estimate.status, pair_[furthest].estimate.status)) furthest = k;
    }
    out.point = pair_[furthest].estimate;
    return;
  }
  start(uncontradicted_, loosest_torso());
  if (solver_.solve(Loss::squares) && choose_torso()) {
    settle_and_answer(later_looks(valid_) - later_looks(uncontradicted_), out);
  } else {
    out.point.status = Status::degenerate;
    out.point.reason = "the looks do not determine a point" + left_out();
  }
}

}  // namespace gazed::triangulation::all_looks
