#include "agent/triangulation/all_looks/normal_equations.hpp"

#include <Eigen/LU>
#include <cmath>

namespace gazed::triangulation::all_looks {

namespace {

/// Residuals beyond this many standard deviations count linearly, not quadratically.
constexpr double huber_sigmas = 1.5;

struct Weighted {
  double cost, weight;
};
Weighted weigh(Loss loss, double chi2) {
  constexpr double limit = huber_sigmas * huber_sigmas;
  if (loss == Loss::squares || chi2 <= limit) return {chi2, 1.0};
  const double sigmas = std::sqrt(chi2);
  return {2.0 * huber_sigmas * sigmas - limit, huber_sigmas / sigmas};
}

/// Look 1's pose defines the frame and cannot move: only its sweep has columns.
constexpr int first_column(std::size_t look) {
  return look == 0 ? column_sweep : column_pose;
}

int columns_at(std::size_t look) {
  return look_columns * static_cast<int>(look);
}

using ByRobot = Eigen::Matrix<double, robot_columns, 2>;

/// Adds a M b^T, where `rows` and `columns` belong to two looks.
template <int count>
void add_pair(const ByRobot& rows, const Eigen::Matrix2d& middle, const ByRobot& columns, int row,
              int column, int first, Matrix& information) {
  const auto x = rows.col(0).segment<count>(look_columns - count);
  const auto y = rows.col(1).segment<count>(look_columns - count);
  for (int j = first; j < look_columns; ++j) {
    const double along_x = middle(0, 0) * columns(j, 0) + middle(0, 1) * columns(j, 1);
    const double along_y = middle(1, 0) * columns(j, 0) + middle(1, 1) * columns(j, 1);
    information.col(column + j).segment<count>(row + look_columns - count) +=
        along_x * x + along_y * y;
  }
}

}  // namespace

bool NormalEquations::linearise(const Robot& robot, const State& state, Loss loss, double damping) {
  of_squares_ = false;
  damping_ = damping;
  // Sums go into the lower triangle; a look's own diagonal block is filled completely.
  const int columns = robot.raw_columns();
  features_information_.resize(columns, columns);
  for (int j = 0; j < columns; ++j) {
    features_information_.col(j).tail(columns - j / look_columns * look_columns).setZero();
  }
  if (!add_everything(robot, state, loss, Renewed::all)) return false;
  of_squares_ = loss == Loss::squares && damping == 0.0;
  scale_ = problem_.feature_scale;
  feature_count_ = problem_.feature_count;
  return true;
}

bool NormalEquations::renew_gradient(const Robot& robot, const State& state) {
  damping_ = 0.0;
  return add_everything(robot, state, Loss::squares, Renewed::gradient);
}

bool NormalEquations::renew_target(const Robot& robot, const State& state) {
  damping_ = 0.0;
  return add_everything(robot, state, Loss::squares, Renewed::target);
}

bool NormalEquations::is_of_the_same_pixels() const {
  if (!of_squares_ || scale_ != problem_.feature_scale || feature_count_ != problem_.feature_count)
    return false;
  for (std::size_t i = 0; i < feature_count_; ++i) {
    if (features_[i].kept != problem_.features[i].kept) return false;
  }
  return true;
}

bool NormalEquations::add_everything(const Robot& robot, const State& state, Loss loss,
                                     Renewed renewed) {
  const int columns = robot.raw_columns();
  camera_at_ = robot.raw_camera_at();
  cost_ = 0.0;
  gradient_.setZero(columns + 3);
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    if (!add_feature(robot, state, loss, i, renewed)) return false;
  }
  if (renewed == Renewed::all) {
    features_information_.triangularView<Eigen::StrictlyUpper>() =
        features_information_.transpose();
  }
  if (renewed != Renewed::gradient) {
    information_.resize(columns + 3, columns + 3);
    information_.topLeftCorner(columns, columns) = features_information_;
    information_.rightCols<3>().setZero();
    information_.bottomRows<3>().setZero();
  }
  return add_target(robot, state, renewed);
}

bool NormalEquations::add_target(const Robot& robot, const State& state, Renewed renewed) {
  constexpr double weak =
      1.0 / (target_inverse_depth_sigma_per_m * target_inverse_depth_sigma_per_m);
  const int depth_at = robot.raw_columns() + 2;
  const double inverse_depth = state.target.inverse_depth_per_m;
  gradient_(depth_at) += weak * inverse_depth;
  cost_ += weak * inverse_depth * inverse_depth;
  if (renewed != Renewed::gradient) information_(depth_at, depth_at) += weak;
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (!contains(problem_.target_kept, k)) continue;
    PointInLook seen;
    if (!robot.see_at_target_row(k, state.target, seen)) return false;
    const Problem::TargetObservation& view = problem_.target[k];
    const Eigen::Vector2d residual = view.whitening * (seen.pixel - view.pixel);
    TargetRow row;
    row << view.whitening.lazyProduct(seen.by_robot), view.whitening.lazyProduct(seen.by_point);
    for (int j = first_column(k); j < row.cols(); ++j) {
      gradient_(place_of(k, j)) += row.col(j).dot(residual);
    }
    cost_ += residual.squaredNorm();
    if (renewed == Renewed::gradient) continue;
    target_rows_[k] = row;
    for (int j = first_column(k); j < row.cols(); ++j) {
      for (int i = first_column(k); i < row.cols(); ++i) {
        information_(place_of(k, i), place_of(k, j)) += row.col(i).dot(row.col(j));
      }
    }
  }
  return true;
}

// The place of a look's, the camera's or the target's column.
int NormalEquations::place_of(std::size_t look, int column) const {
  static_assert(column_camera == look_columns);
  return column < look_columns ? columns_at(look) + column : camera_at_ + (column - look_columns);
}

Matrix NormalEquations::target_row(std::size_t look) const {
  Matrix out = Matrix::Zero(2, gradient_.size());
  for (int i = first_column(look); i < target_rows_[look].cols(); ++i) {
    out.col(place_of(look, i)) = target_rows_[look].col(i);
  }
  return out;
}

bool NormalEquations::add_pixel(const Robot& robot, const State& state, Loss loss,
                                std::size_t index, std::size_t k, Eigen::Matrix3d& information) {
  const Problem::Feature& given = problem_.features[index];
  const geometry::Pixel& pixel = given.observed->pixel[k];
  PointInLook seen;
  if (!robot.see(k, state.features[index], pixel.y(), seen)) return false;
  const double per_px =
      1.0 / (given.sigma_px * problem_.feature_scale * problem_.rig.uncertainty.corner_slip);
  const Eigen::Vector2d residual = per_px * (seen.pixel - pixel);
  const Weighted weighted = weigh(loss, residual.squaredNorm());
  cost_ += weighted.cost;
  const double root = std::sqrt(weighted.weight), scale = root * per_px;
  Pixel& out = features_[index].pixels[k];
  out.residual = root * residual;
  out.by_point = scale * seen.by_point;
  out.by_robot = scale * seen.by_robot.transpose();
  information += out.by_point.transpose() * out.by_point;
  features_[index].gradient += out.by_point.transpose() * out.residual;
  return true;
}

bool NormalEquations::add_feature(const Robot& robot, const State& state, Loss loss,
                                  std::size_t index, Renewed renewed) {
  Feature& feature = features_[index];
  feature.kept = problem_.features[index].kept;
  if (feature.kept == 0) return true;
  const double inverse_depth = state.features[index].inverse_depth_per_m;
  constexpr double weak =
      1.0 / (feature_inverse_depth_sigma_per_m * feature_inverse_depth_sigma_per_m);
  Eigen::Matrix3d information = Eigen::Vector3d(0.0, 0.0, weak).asDiagonal();
  feature.gradient = {0.0, 0.0, weak * inverse_depth};
  cost_ += weak * inverse_depth * inverse_depth;
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (contains(feature.kept, k) && !add_pixel(robot, state, loss, index, k, information)) {
      return false;
    }
  }
  information.diagonal() *= 1.0 + damping_;
  feature.inverse_information = information.inverse();
  if (renewed == Renewed::all) add_information(feature);
  add_gradient(feature);
  return true;
}

// Let B_k be a pixel's derivatives by the robot, P_k those by the point, and V the inverse of the
// point's information. The information that looks k and l share is B_k^T M B_l, M = [k = l] - P_k V
// P_l^T.
void NormalEquations::add_information(const Feature& feature) {
  std::array<Eigen::Matrix<double, camera_columns, 2>, looks_max> by_camera;  // sums of M B
  auto camera = features_information_.block<camera_columns, camera_columns>(camera_at_, camera_at_);
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (!contains(feature.kept, k)) continue;
    const Pixel& row = feature.pixels[k];
    const Eigen::Matrix<double, 2, 3> gain = row.by_point * feature.inverse_information;
    by_camera[k].setZero();
    for (std::size_t l = 0; l <= k; ++l) {
      if (!contains(feature.kept, l)) continue;
      const Pixel& column = feature.pixels[l];
      Eigen::Matrix2d middle = -gain * column.by_point.transpose();
      if (k == l) middle.diagonal().array() += 1.0;
      if (k == 0) {
        add_pair<look_columns - column_sweep>(row.by_robot, middle, column.by_robot, columns_at(k),
                                              columns_at(l), first_column(l),
                                              features_information_);
      } else {
        add_pair<look_columns>(row.by_robot, middle, column.by_robot, columns_at(k), columns_at(l),
                               first_column(l), features_information_);
      }
      by_camera[k] += column.by_robot.bottomRows<camera_columns>() * middle.transpose();
      if (k != l) by_camera[l] += row.by_robot.bottomRows<camera_columns>() * middle;
    }
  }
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (!contains(feature.kept, k)) continue;
    const ByRobot& by_robot = feature.pixels[k].by_robot;
    for (int j = first_column(k); j < look_columns; ++j) {
      features_information_.col(columns_at(k) + j).segment<camera_columns>(camera_at_) +=
          by_camera[k].col(0) * by_robot(j, 0) + by_camera[k].col(1) * by_robot(j, 1);
    }
    camera += by_camera[k] * by_robot.bottomRows<camera_columns>().transpose();
  }
}

void NormalEquations::add_gradient(const Feature& feature) {
  const Eigen::Vector3d step = feature.inverse_information * feature.gradient;
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (!contains(feature.kept, k)) continue;
    const Pixel& pixel = feature.pixels[k];
    const Eigen::Vector2d rest = pixel.residual - pixel.by_point * step;
    const Eigen::Matrix<double, robot_columns, 1> by_robot = pixel.by_robot * rest;
    const int first = first_column(k), count = look_columns - first;
    gradient_.segment(columns_at(k) + first, count) += by_robot.segment(first, count);
    gradient_.segment<camera_columns>(camera_at_) += by_robot.tail<camera_columns>();
  }
}

void NormalEquations::step_features(const Vector& raw_step, State& next) const {
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    const Feature& feature = features_[i];
    if (feature.kept == 0) continue;
    Eigen::Vector3d gradient = feature.gradient;
    for (std::size_t k = 0; k < problem_.looks; ++k) {
      if (!contains(feature.kept, k)) continue;
      const Pixel& pixel = feature.pixels[k];
      const Eigen::Vector2d moved = pixel.by_robot.topRows<look_columns>().transpose() *
                                        raw_step.segment<look_columns>(columns_at(k)) +
                                    pixel.by_robot.bottomRows<camera_columns>().transpose() *
                                        raw_step.segment<camera_columns>(camera_at_);
      gradient += pixel.by_point.transpose() * moved;
    }
    const Eigen::Vector3d step = feature.inverse_information * gradient;
    next.features[i].direction -= step.head<2>();
    next.features[i].inverse_depth_per_m -= step.z();
  }
}

double NormalEquations::inverse_depth_variance(std::size_t index, Vector& by_raw) const {
  const Feature& feature = features_[index];
  const Eigen::Vector3d gain = feature.inverse_information.col(2);
  by_raw.setZero(gradient_.size());
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (!contains(feature.kept, k)) continue;
    const Pixel& pixel = feature.pixels[k];
    const Eigen::Vector2d moved = -(pixel.by_point * gain);
    by_raw.segment<look_columns>(columns_at(k)) = pixel.by_robot.topRows<look_columns>() * moved;
    by_raw.segment<camera_columns>(camera_at_) +=
        pixel.by_robot.bottomRows<camera_columns>() * moved;
  }
  return gain.z();
}

}  // namespace gazed::triangulation::all_looks
