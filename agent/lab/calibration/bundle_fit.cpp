#include "agent/lab/calibration/bundle_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>
#include <ceres/ordered_groups.h>
#include <ceres/solver.h>
#include <cmath>

#include "agent/lab/calibration/observability.hpp"
#include "agent/lab/calibration/prior_errors.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr double first_inverse_range_per_m = 1.0;  // rooms are some metres wide
constexpr double rejected_beyond_sigmas = 5.0;
constexpr double least_pixel_sigma_px = 0.01;  // of perfect data

/// The normal equations of a Jacobian whose first `common` columns all rows share; of the others
/// each row has those of one thing that was seen, `size` of them. These are eliminated.
Eigen::MatrixXd without_seen(const ceres::CRSMatrix& jacobian, Eigen::Index common,
                             Eigen::Index size) {
  struct Seen {
    Eigen::MatrixXd own, cross;
  };
  std::vector<Seen> seen(static_cast<std::size_t>((jacobian.num_cols - common) / size),
                         {Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(common, size)});
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(common, common);
  const auto add = [&](Eigen::Index i, Eigen::Index j, double product) {
    if (j < common) {
      if (i < common) reduced(i, j) += product;
      return;
    }
    Seen& thing = seen[static_cast<std::size_t>((j - common) / size)];
    (i < common ? thing.cross(i, (j - common) % size)
                : thing.own((i - common) % size, (j - common) % size)) += product;
  };
  for (std::size_t row = 0; row + 1 < jacobian.rows.size(); ++row) {
    const auto begin = static_cast<std::size_t>(jacobian.rows[row]);
    const auto end = static_cast<std::size_t>(jacobian.rows[row + 1]);
    for (std::size_t a = begin; a < end; ++a) {
      for (std::size_t b = begin; b < end; ++b) {
        add(jacobian.cols[a], jacobian.cols[b], jacobian.values[a] * jacobian.values[b]);
      }
    }
  }
  for (const Seen& thing : seen) {
    const Eigen::MatrixXd gain = thing.cross.lazyProduct(pseudo_inverse(thing.own));
    reduced -= gain.lazyProduct(thing.cross.transpose());
  }
  return reduced;
}

}  // namespace

BundleFit::BundleFit(const BundleInput& input)
    : parameters(input.prior.mean),
      pixel_sigma_px(input.pixel_sigma_px),
      encoder_sigma_rad(input.encoder_sigma_rad),
      in_(input),
      free_(input.prior.free_indices()),
      used_(input.sightings.size(), true) {
  put_looks_back();
  for (std::size_t i = 0; i < looks_.size(); ++i) places_.push_back(std::make_shared<LookPlace>());
  if (is_scene()) {
    start_scene();
  } else {
    targets_.push_back({});
    std::ranges::copy(in_.neck_from_pattern.translation, targets_[0].begin() + 3);
  }
  // What the first guess puts behind the camera waits until a better one is judged.
  for (std::size_t i = 0; i < used_.size(); ++i) {
    used_[i] = std::isfinite(error_px(in_.sightings[i]));
  }
}

void BundleFit::start_scene() {
  targets_.assign(static_cast<std::size_t>(in_.point_count), {0.0, 0.0, first_inverse_range_per_m});
  tangents_.assign(targets_.size(), Eigen::Matrix3d::Identity());
  std::vector<bool> started(targets_.size(), false);
  const geometry::CameraModel camera = with_parameters({}, parameters).camera;
  for (const PointSighting& s : in_.sightings) {
    const auto point = static_cast<std::size_t>(s.point);
    if (started[point]) continue;
    const auto ray = geometry::normalise(camera, s.pixel);
    if (!ray) continue;
    started[point] = true;
    const auto place =
        camera_place(parameters.data(), looks_[static_cast<std::size_t>(s.look)].data());
    const Eigen::Vector3d direction = place.neck_from_cam * ray->homogeneous().normalized();
    Eigen::Matrix3d& tangents = tangents_[point];
    tangents.col(0) = direction;
    tangents.col(1) = direction.unitOrthogonal();
    tangents.col(2) = direction.cross(tangents.col(1));
  }
}

void BundleFit::put_looks_back() {
  looks_.clear();
  for (const geometry::HeadAngles& look : in_.looks)
    looks_.push_back({look.yaw_rad, look.pitch_rad});
}

BundleFit::Problem BundleFit::problem(Freedom freedom, ceres::LossFunction* loss, bool with_prior) {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  auto problem = std::make_unique<ceres::Problem>(options);
  for (std::size_t i = 0; i < in_.sightings.size(); ++i) {
    if (!used_[i]) continue;
    const PointSighting& s = in_.sightings[i];
    ceres::CostFunction* cost = error_of(s, pixel_sigma_px).release();
    problem->AddResidualBlock(cost, loss, parameters.data(),
                              looks_[static_cast<std::size_t>(s.look)].data(), target(s.point));
  }
  if (with_prior && !free_.empty()) {
    std::vector<Belief> beliefs;
    for (const int at : free_) beliefs.push_back({at, in_.prior.mean[at], in_.prior.sigma[at]});
    problem->AddResidualBlock(new PriorError(parameter_count, std::move(beliefs)), nullptr,
                              parameters.data());
  }
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    double* look = looks_[i].data();
    if (!problem->HasParameterBlock(look)) continue;
    if (encoder_sigma_rad > 0.0) {
      std::vector<Belief> beliefs{{0, in_.looks[i].yaw_rad, encoder_sigma_rad},
                                  {1, in_.looks[i].pitch_rad, encoder_sigma_rad}};
      problem->AddResidualBlock(new PriorError(angle_count, std::move(beliefs)), nullptr, look);
    }
    if (!freedom.looks || !(encoder_sigma_rad > 0.0)) problem->SetParameterBlockConstant(look);
  }
  if (!freedom.parameters || free_.empty()) {
    problem->SetParameterBlockConstant(parameters.data());
  } else if (free_.size() < parameter_count) {
    problem->SetManifold(parameters.data(),
                         new ceres::SubsetManifold(parameter_count, in_.prior.held_indices()));
  }
  if (in_.pattern_held && problem->HasParameterBlock(target(0))) {
    problem->SetParameterBlockConstant(target(0));
  }
  return problem;
}

bool BundleFit::solve(Freedom freedom, Effort effort) {
  // Fewer than half of the sightings before the camera is no start that a solution is near to.
  if (2 * used() < used_.size()) return false;
  // Beyond 3 sigma an error counts linearly (Huber 1964).
  ceres::HuberLoss loss(3.0);
  const Problem problem = this->problem(freedom, &loss, true);
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = effort.iterations;
  options.function_tolerance = effort.tolerance;
  options.linear_solver_type = is_scene() ? ceres::DENSE_SCHUR : ceres::DENSE_NORMAL_CHOLESKY;
  if (is_scene()) {
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    std::vector<double*> blocks;
    problem->GetParameterBlocks(&blocks);
    const std::vector<double*> points = free_targets();
    for (double* block : blocks) {
      const bool is_point = std::ranges::binary_search(points, block);
      options.linear_solver_ordering->AddElementToGroup(block, is_point ? 0 : 1);
    }
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem.get(), &summary);
  return summary.IsSolutionUsable();
}

std::vector<double*> BundleFit::free_targets() {
  std::vector<double*> blocks;
  if (in_.pattern_held) return blocks;
  std::vector<bool> seen(targets_.size(), false);
  for (std::size_t i = 0; i < in_.sightings.size(); ++i) {
    if (used_[i]) seen[is_scene() ? static_cast<std::size_t>(in_.sightings[i].point) : 0] = true;
  }
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (seen[i]) blocks.push_back(targets_[i].data());
  }
  return blocks;  // ascending addresses
}

std::unique_ptr<ceres::CostFunction> BundleFit::error_of(const PointSighting& s,
                                                         double sigma_px) const {
  const auto point = static_cast<std::size_t>(s.point);
  const auto& place = places_[static_cast<std::size_t>(s.look)];
  if (is_scene()) {
    return std::make_unique<ReprojectionError<ScenePoint>>(ScenePoint{tangents_[point]}, place,
                                                           s.pixel, sigma_px);
  }
  return std::make_unique<ReprojectionError<PatternPoint>>(
      PatternPoint{in_.pattern_m[point], in_.neck_from_pattern.rotation}, place, s.pixel, sigma_px);
}

double BundleFit::error_px(const PointSighting& s) const {
  const std::array<const double*, 3> blocks{
      parameters.data(), looks_[static_cast<std::size_t>(s.look)].data(),
      targets_[is_scene() ? static_cast<std::size_t>(s.point) : 0].data()};
  std::array<double, 2> error{};
  const bool seen = error_of(s, 1.0)->Evaluate(blocks.data(), error.data(), nullptr);
  return seen ? std::hypot(error[0], error[1]) : HUGE_VAL;
}

double BundleFit::rms_px() const {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (!used_[i]) continue;
    const double error = error_px(in_.sightings[i]);
    sum += error * error;
    count += 2;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

/// What is left of the residuals' degrees of freedom when all unknowns are fitted, as a share.
double BundleFit::freedom_share() const {
  const auto residuals = 2.0 * static_cast<double>(used());
  std::vector<bool> seen(targets_.size(), false);
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i] && is_scene()) seen[static_cast<std::size_t>(in_.sightings[i].point)] = true;
  }
  double unknowns = is_scene() ? point_size * static_cast<double>(std::ranges::count(seen, true))
                               : (in_.pattern_held ? 0.0 : pose_size);
  if (encoder_sigma_rad > 0.0) unknowns += 2.0 * static_cast<double>(looks_.size());
  unknowns += static_cast<double>(free_.size());
  return std::max(0.1, 1.0 - unknowns / residuals);
}

void BundleFit::judge_sightings() {
  std::vector<double> errors;
  for (const PointSighting& s : in_.sightings) errors.push_back(error_px(s));
  std::vector<double> sorted = errors;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  const double rayleigh_median = std::sqrt(2.0 * std::log(2.0));  // of a length, in sigmas
  const double share = std::sqrt(freedom_share());
  const double robust_sigma_px = std::max(least_pixel_sigma_px, *middle / rayleigh_median / share);
  std::vector<int> looks_at(targets_.size(), 0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const PointSighting& s = in_.sightings[i];
    used_[i] = !in_.outliers_rejected || errors[i] <= rejected_beyond_sigmas * robust_sigma_px;
    if (used_[i] && is_scene()) ++looks_at[static_cast<std::size_t>(s.point)];
  }
  for (std::size_t i = 0; i < errors.size() && is_scene(); ++i) {
    constexpr int least_looks = 3;  // two looks fit almost anything
    if (looks_at[static_cast<std::size_t>(in_.sightings[i].point)] < least_looks) used_[i] = false;
  }
  pixel_sigma_px = std::max(least_pixel_sigma_px, rms_px() / std::sqrt(freedom_share()));
}

void BundleFit::judge_looks() {
  if (!(in_.encoder_sigma_rad > 0.0)) return;
  double sum = 0.0;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const double yaw = looks_[i][0] - in_.looks[i].yaw_rad;
    const double pitch = looks_[i][1] - in_.looks[i].pitch_rad;
    sum += yaw * yaw + pitch * pitch;
  }
  // Zero and scale of each axis take four degrees of freedom.
  const double freedoms = std::max(1.0, 2.0 * static_cast<double>(looks_.size()) - 4.0);
  encoder_sigma_rad = std::max(in_.encoder_sigma_rad, std::sqrt(sum / freedoms));
}

Eigen::MatrixXd BundleFit::information() {
  const Problem problem = this->problem({}, nullptr, false);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks.push_back(parameters.data());
  auto common = static_cast<Eigen::Index>(free_.size());
  const Eigen::Index kept = common;
  for (auto& look : looks_) {
    if (!(encoder_sigma_rad > 0.0) || !problem->HasParameterBlock(look.data())) continue;
    options.parameter_blocks.push_back(look.data());
    common += angle_count;
  }
  for (double* block : free_targets()) options.parameter_blocks.push_back(block);
  ceres::CRSMatrix crs;
  problem->Evaluate(options, nullptr, nullptr, nullptr, &crs);
  // What was seen is eliminated first, then the looks.
  const Eigen::MatrixXd reduced = without_seen(crs, common, is_scene() ? point_size : pose_size);
  const Eigen::Index looks = common - kept;
  if (looks == 0) return reduced;
  const Eigen::MatrixXd cross = reduced.topRightCorner(kept, looks);
  const Eigen::MatrixXd own = reduced.bottomRightCorner(looks, looks);
  return reduced.topLeftCorner(kept, kept) -
         cross.lazyProduct(pseudo_inverse(own)).eval().lazyProduct(cross.transpose());
}

std::vector<geometry::HeadAngles> BundleFit::refined_looks() const {
  std::vector<geometry::HeadAngles> looks;
  for (const auto& look : looks_) looks.push_back({look[0], look[1]});
  return looks;
}

geometry::Pose BundleFit::pattern_place() const {
  if (is_scene()) return {};
  const Eigen::Map<const Eigen::Vector3d> turn(targets_[0].data());
  return {in_.neck_from_pattern.rotation * geometry::rotation_by(turn),
          Eigen::Map<const Eigen::Vector3d>(targets_[0].data() + 3)};
}

}  // namespace gazed::lab::calibration
