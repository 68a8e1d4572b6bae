#include "agent/triangulation/joint.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "agent/text.hpp"
#include "agent/triangulation/chi_square.hpp"
#include "agent/triangulation/degeneracy.hpp"
#include "agent/triangulation/joint_features.hpp"
#include "agent/triangulation/joint_problem.hpp"
#include "agent/triangulation/joint_solver.hpp"
#include "agent/triangulation/joint_target.hpp"
#include "agent/triangulation/judgement.hpp"
#include "agent/triangulation/pairs.hpp"

namespace gazed {

namespace {

/// Fewer features cannot outvote a wrong one.
constexpr std::size_t features_min = 8;
/// Of the features' pixels in later looks; when less agrees, it is not known what does.
constexpr double kept_share_min = 0.5;
/// Residuals so many times their sigmas are no noise.
constexpr double feature_scale_max = 3.0;
/// No registration is better than this.
constexpr double target_sigma_min_px = 1e-3;

/// Of all that is done for one answer.
class JointEstimation {
 public:
  JointEstimation(const HeadGeometry& head, const CameraModel& camera,
                  const Uncertainty& uncertainty, std::span<const Look> looks, const Gate& gate)
      : gate_(gate), looks_(looks) {
    problem_.head = head;
    problem_.camera = camera;
    problem_.uncertainty = uncertainty;
    problem_.looks = looks.size();
    for (std::size_t k = 0; k < looks.size(); ++k) problem_.measured[k] = looks[k].head;
    out_.head = problem_.measured;
  }

  /// What every pair says by itself. False when no look can be used: the answer says why.
  bool judge_pairs();
  /// Angles from the features too, and then the answer. False when they are not to be trusted.
  bool estimate_with(std::span<const FeatureTrack> features);
  void estimate_without_features();

  JointEstimate take() { return std::move(out_); }

 private:
  Eigen::Matrix2d noise_px2(std::size_t k) const;
  void set_target(std::size_t k);
  bool add_look(std::size_t k, const PointEstimate& estimate);
  void start();
  bool solve_with_features();
  void leave_out_features_behind();
  [[nodiscard]] bool features_are_plausible() const;
  bool settle();
  void answer();
  [[nodiscard]] std::optional<std::string> what_is_degenerate(const JointRobot& robot) const;
  void fill_seen(const JointRobot& robot);
  void refuse(Status status, std::string reason);

  Gate gate_;
  std::span<const Look> looks_;
  JointEstimate out_;
  std::string left_out_;
  LookSet finite_looks_ = 0;  // whose angles are numbers
  LookSet target_looks_ = 0;  // whose pairs have nothing against them
  int contradicting_pairs_ = 0;
  InverseDepthPoint target_start_{Eigen::Vector2d::Zero(), 0.0};
  JointProblem problem_;
  JointState state_;
  JointSolver solver_{problem_, state_};
  FeatureAgreement features_;
};

void JointEstimation::refuse(Status status, std::string reason) {
  out_.fused.estimate.status = status;
  out_.fused.estimate.reason = std::move(reason) + left_out_;
}

Eigen::Matrix2d JointEstimation::noise_px2(std::size_t k) const {
  // Look 1's pixel defines the point. What it takes to find the point again is the later look's.
  if (k == 0) return target_sigma_min_px * target_sigma_min_px * Eigen::Matrix2d::Identity();
  const double sigma_px = std::max(target_sigma_min_px, problem_.uncertainty.pixel_sigma_px);
  return sigma_px * sigma_px * Eigen::Matrix2d::Identity() + looks_[k].covariance_px2;
}

void JointEstimation::set_target(std::size_t k) {
  const Eigen::Matrix2d root = noise_px2(k).llt().matrixL();
  problem_.target[k] = {looks_[k].pixel, root.inverse()};
}

bool JointEstimation::judge_pairs() {
  std::array<Pair, pairs_max> pairs;
  std::size_t count = 0;
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    const TwoLooks pair{looks_[0].head, looks_[k].head, looks_[0].pixel, looks_[k].pixel,
                        looks_[k].covariance_px2};
    const PointEstimate estimate =
        estimate_point(problem_.head, problem_.camera, problem_.uncertainty, pair, gate_);
    LookVerdict& verdict = out_.fused.looks[k];
    verdict.status = estimate.status;
    verdict.inverse_range_per_m = estimate.inverse_range_per_m;
    verdict.inverse_range_sigma_per_m = estimate.inverse_range_sigma_per_m;
    if (std::isfinite(looks_[k].head.yaw_rad) && std::isfinite(looks_[k].head.pitch_rad)) {
      finite_looks_ |= only_look(k);
    }
    if (estimate.status != Status::invalid_input && estimate.status != Status::target_lost) {
      const auto observation = observe(problem_.head, problem_.camera, problem_.uncertainty, pair);
      if (const auto comparable = comparable_pair(*observation, k, estimate)) {
        pairs[count++] = *comparable;
      }
      target_looks_ |= only_look(k);
      continue;
    }
    contradicting_pairs_ += estimate.status == Status::target_lost ? 1 : 0;
    left_out_ += text("; look %zu left out: %s", k + 1, estimate.reason.c_str());
    if (k == 1 || came_further(estimate.status, out_.fused.estimate.status)) {
      out_.fused.estimate = estimate;
    }
  }
  if (target_looks_ == 0) return false;
  out_.fused.estimate = {};
  target_looks_ |= only_look(0);
  finite_looks_ |= only_look(0);
  if (count > 0) target_start_ = mean_by_information({pairs.data(), count});
  target_start_.direction = normalise(problem_.camera, looks_[0].pixel).value();
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    if (contains(target_looks_, k)) set_target(k);
  }
  return true;
}

void JointEstimation::start() {
  problem_.target_kept = target_looks_;
  problem_.feature_count = 0;
  problem_.feature_scale = 1.0;
  state_.robot.setZero(problem_.robot_unknowns());
  state_.target = target_start_;
}

bool JointEstimation::features_are_plausible() const {
  std::size_t used = 0;
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    used += problem_.features[i].kept != 0 ? 1 : 0;
  }
  const auto angles = 2 * static_cast<Eigen::Index>(problem_.looks);
  return used >= features_min && features_.pixels_kept >= kept_share_min * features_.pixels_seen &&
         features_.scale <= feature_scale_max &&
         state_.robot.head(angles).squaredNorm() <= chi2_999_of(static_cast<int>(angles));
}

bool JointEstimation::solve_with_features() {
  constexpr int rounds = 4;  // of choosing and solving; two are enough but for close calls
  if (!solver_.solve(Loss::huber)) return false;
  problem_.feature_scale = typical_scale(problem_, state_);
  for (int round = 0; round < rounds; ++round) {
    features_ = keep_agreeing(problem_, state_);
    problem_.feature_scale = features_.scale;
    if (round > 0 && !features_.changed) return true;
    if (!solver_.solve(Loss::squares)) return false;
    leave_out_features_behind();
  }
  return true;
}

/// Tracks that agree on a point behind the camera are of no point.
void JointEstimation::leave_out_features_behind() {
  constexpr double sigmas = 3.090232;  // 99.9 % of the standard normal, one side
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    const double inverse_depth = state_.features[i].inverse_depth_per_m;
    if (problem_.features[i].kept == 0 || inverse_depth >= 0.0) continue;
    if (inverse_depth < -sigmas * solver_.inverse_depth_sigma_per_m(i)) {
      problem_.features[i].seen = 0;
    }
  }
}

bool JointEstimation::estimate_with(std::span<const FeatureTrack> features) {
  start();
  add_features(features, finite_looks_, problem_, state_);
  if (problem_.feature_count < features_min) {
    out_.refinement = Refinement::none;
    return false;
  }
  out_.refinement = Refinement::distrusted;
  out_.features_rejected = problem_.feature_count;
  const JointEstimate before = out_;
  const std::string left_out_before = left_out_;
  if (!solve_with_features()) return false;
  const bool agree = settle();
  if (!features_are_plausible()) {
    out_ = before;
    left_out_ = left_out_before;
    return false;
  }
  out_.refinement = Refinement::used;
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    out_.features_used += problem_.features[i].kept != 0 ? 1 : 0;
  }
  out_.features_rejected = problem_.feature_count - out_.features_used;
  if (agree) answer();
  return true;
}

void JointEstimation::estimate_without_features() {
  start();
  if (!solver_.solve(Loss::squares)) {
    refuse(Status::degenerate, "the looks do not determine a point");
  } else if (settle()) {
    answer();
  }
}

/// Drops looks until the others agree on the target. False when too few would be left to know who
/// is right.
bool JointEstimation::settle() {
  int dropped = contradicting_pairs_;
  for (;;) {
    const TargetAgreement found =
        target_agreement(problem_, state_, solver_.information(), solver_.covariance());
    out_.fused.chi2 = found.chi2;
    out_.fused.degrees_of_freedom = found.degrees_of_freedom;
    // The gate's limit is for one degree of freedom: of a pair.
    const double wider = gate_.epipolar_chi2_max / chi2_999;
    const bool agree = found.chi2 <= wider * chi2_999_of(found.degrees_of_freedom) &&
                       found.worst_chi2 <= wider * chi2_999_of(2);
    const int later_looks = std::popcount(problem_.target_kept) - 1;
    if (agree && later_looks > dropped) return true;
    if (agree || later_looks <= dropped + 2) {
      refuse(Status::target_lost, text("%zu looks contradict each other, chi-square %.1f: not one "
                                       "point",
                                       looks_.size(), found.chi2));
      fill_seen(JointRobot(problem_, state_.robot));
      return false;
    }
    ++dropped;
    const std::size_t look = found.worst_look;
    problem_.target_kept = static_cast<LookSet>(problem_.target_kept & ~only_look(look));
    out_.fused.looks[look].status = Status::target_lost;
    out_.fused.looks[look].chi2 = found.worst_chi2;
    left_out_ += text("; look %zu left out: the others contradict it, chi-square %.1f", look + 1,
                      found.worst_chi2);
    if (!solver_.solve(Loss::squares)) {
      refuse(Status::degenerate, "the looks that agree do not determine a point");
      return false;
    }
  }
}

/// What is known without a position.
void JointEstimation::fill_seen(const JointRobot& robot) {
  PointEstimate& estimate = out_.fused.estimate;
  const Eigen::Vector3d ray_1 = state_.target.direction.homogeneous();
  double squared_px2 = 0.0;
  PointInLook seen;
  see_in_look_1(robot.camera(), state_.target, seen);
  squared_px2 += (seen.pixel - looks_[0].pixel).squaredNorm();
  estimate.parallax_rad = 0.0;
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    if (!contains(problem_.target_kept, k)) continue;
    const Pose cam_from_cam1 = robot.look(k).cam_from_cam1();
    const Eigen::Vector3d rotated = cam_from_cam1.rotation * ray_1;
    const Eigen::Vector3d ray =
        rotated + state_.target.inverse_depth_per_m * cam_from_cam1.translation;
    estimate.parallax_rad =
        std::max(estimate.parallax_rad, std::atan2(rotated.cross(ray).norm(), rotated.dot(ray)));
    if (robot.look(k).see(robot.camera(), state_.target, seen)) {
      squared_px2 += (seen.pixel - looks_[k].pixel).squaredNorm();
    }
  }
  estimate.residual_px = std::sqrt(squared_px2 / (std::popcount(problem_.target_kept) - 1));
}

/// Why no look is anywhere else than look 1, in the words of the one that is farthest from it.
std::optional<std::string> JointEstimation::what_is_degenerate(const JointRobot& robot) const {
  std::optional<std::string> out;
  double widest_m = -1.0;
  const auto point_1 = image_point(robot.camera(), looks_[0].pixel, noise_px2(0));
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    if (!contains(problem_.target_kept, k)) continue;
    const auto point_2 = image_point(robot.camera(), looks_[k].pixel, noise_px2(k));
    if (!point_1 || !point_2) continue;
    const TwoViews views{.cam2_from_cam1 = robot.look(k).cam_from_cam1(),
                         .point_1 = *point_1,
                         .point_2 = *point_2,
                         .torso_from_cam1 = std::nullopt};
    auto reason =
        gazed::what_is_degenerate(views, baseline_sigma_m(robot, k, solver_.covariance()), gate_);
    if (!reason) return std::nullopt;
    const double baseline_m = views.cam2_from_cam1.translation.norm();
    if (baseline_m > widest_m) {
      widest_m = baseline_m;
      out = std::move(reason);
    }
  }
  return out ? out : "the looks have no rays";
}

void JointEstimation::answer() {
  const JointRobot robot(problem_, state_.robot);
  PointEstimate& estimate = out_.fused.estimate;
  estimate = {};
  // Their zeros are those that are believed, not those that came out.
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    if (k == 0 || contains(finite_looks_, k)) {
      out_.head[k] = robot.reading(k) + robot.head().zero - problem_.head.zero;
    }
  }
  if (auto reason = what_is_degenerate(robot)) {
    refuse(Status::degenerate, *std::move(reason));
    return;
  }
  fill_seen(robot);
  const Propagated propagated = target_uncertainty(robot, state_, solver_.covariance());
  estimate.inverse_range_per_m = propagated.inverse_range_per_m;
  estimate.inverse_range_sigma_per_m = propagated.inverse_range_sigma_per_m;
  if (estimate.inverse_range_per_m < -estimate.inverse_range_sigma_per_m) {
    refuse(Status::behind_camera,
           text("the rays meet behind camera 1: inverse range %.3f +- %.3f 1/m",
                estimate.inverse_range_per_m, estimate.inverse_range_sigma_per_m));
  } else {
    judge_sigma(state_.target, propagated, cam_from_torso(robot.head(), robot.reading(0)).inverse(),
                gate_, estimate);
    estimate.reason += left_out_;
  }
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    out_.fused.looks[k].used = contains(problem_.target_kept, k);
  }
  out_.fused.looks[0].status = estimate.status;
  out_.fused.looks_used = static_cast<std::size_t>(std::popcount(problem_.target_kept));
}

}  // namespace

JointEstimate locate_jointly(const HeadGeometry& head, const CameraModel& camera,
                             const Uncertainty& uncertainty, std::span<const Look> looks,
                             std::span<const FeatureTrack> features, const Gate& gate) {
  if (looks.size() < 2 || looks.size() > looks_max) {
    throw std::invalid_argument(text("%zu looks; 2 to %zu can be used", looks.size(), looks_max));
  }
  if (features.size() > features_max) {
    throw std::invalid_argument(
        text("%zu features; at most %zu can be used", features.size(), features_max));
  }
  JointEstimation estimation(head, camera, uncertainty, looks, gate);
  if (estimation.judge_pairs() && !estimation.estimate_with(features)) {
    estimation.estimate_without_features();
  }
  return estimation.take();
}

}  // namespace gazed
