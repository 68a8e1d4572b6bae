// Solves the problem of all looks: Gauss-Newton with Levenberg-Marquardt's damping where a step
// does not help, features eliminated (Triggs et al. 2000). Sums are made in a fixed order.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "agent/triangulation/all_looks/problem.hpp"

namespace gazed::triangulation::all_looks {

/// How a feature's residual counts. Huber's loss (1964) has one minimum, wherever one starts: it
/// finds the angles that most features agree on. Squares are for those that are then kept.
enum class Loss { huber, squares };

/// What a feature's three unknowns share with the raw columns: rows for those alone that its looks
/// have, in ascending order.
class RobotRows {
 public:
  static constexpr int rows_max = look_columns * static_cast<int>(looks_max) + camera_columns;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, rows_max, 3>;

  void start();
  /// Adds a look, in ascending order.
  void add(std::size_t look, const Eigen::Matrix<double, robot_columns, 3>& by_robot);
  void finish(int raw_camera_at);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int place(int row) const { return places_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] auto rows() const { return rows_.topRows(size_); }

 private:
  int size_ = 0;
  Eigen::Matrix<double, rows_max, 3> rows_;
  std::array<int, rows_max> places_;
  Eigen::Matrix<double, camera_columns, 3> camera_;
};

/// Everything that the solver works in; made once, no memory is allocated.
class Solver {
 public:
  /// Works on both from then on.
  Solver(Problem& problem, State& state);

  /// From the state on; information and covariance are made of squares alone. A feature's pixel
  /// goes from `kept` when its point is behind the look there; a step that would put a point behind
  /// a look is not taken: costs are of the same pixels always. False when no step leads anywhere:
  /// the looks determine nothing.
  [[nodiscard]] bool solve(Loss loss);

  /// Of the robot's unknowns and the target's, at the last solution: the inverse information, made
  /// when it is first asked for.
  [[nodiscard]] const Matrix& covariance();
  [[nodiscard]] const Matrix& information() const { return information_; }
  /// Of a feature's inverse depth at the last solution, 1/m. It must have been in it.
  [[nodiscard]] double inverse_depth_sigma_per_m(std::size_t feature);

 private:
  /// What is left of a feature's three unknowns.
  struct Eliminated {
    Eigen::Matrix3d inverse_information;
    Eigen::Vector3d gradient;
    RobotRows shared;  // with the raw columns
  };

  void drop_pixels_behind();
  /// False when a point that counts is behind its look, or a number is none.
  bool linearise(Loss loss);
  bool raise_damping(Loss loss);
  bool factorise_information();
  bool add_target(const Robot& robot);
  void add_to_look(std::size_t look, const Eigen::Matrix<double, 2, robot_columns>& by_robot,
                   const Eigen::Vector2d& residual);
  [[nodiscard]] bool add_pixel(const Robot& robot, Loss loss, std::size_t index, std::size_t look,
                               Eigen::Matrix3d& information);
  [[nodiscard]] bool add_feature(const Robot& robot, Loss loss, std::size_t index);
  void eliminate(const Eliminated& feature);
  void add_look(std::size_t look, int raw_camera_at);
  [[nodiscard]] bool step(State& next);
  void step_features(const Vector& raw_step, State& next) const;

  Problem& problem_;
  State& state_;
  double damping_ = 0.0;

  // At the state.
  double cost_ = 0.0;
  Matrix raw_information_;  // lower triangle until it is complete
  Matrix raw_from_unknowns_;
  Vector raw_gradient_;
  Matrix information_;
  Vector gradient_;
  std::array<Eigen::Matrix<double, robot_columns, robot_columns>, looks_max> look_information_;
  std::array<Eigen::Matrix<double, robot_columns, 1>, looks_max> look_gradient_;
  std::array<Eliminated, features_max> eliminated_;

  double decrement_ = 0.0;  // squared length of the last step, in standard deviations
  Matrix factors_;          // of the information at the last solution
  Matrix covariance_;
  bool covariance_is_made_ = false;
};

}  // namespace gazed::triangulation::all_looks
