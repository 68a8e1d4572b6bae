// The normal equations of all looks at a state, in raw columns, with the features eliminated (Schur
// complement: Triggs et al. 2000). Sums are made in a fixed order.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "agent/triangulation/all_looks/problem.hpp"

namespace gazed::triangulation::all_looks {

/// How residuals of features count. Huber's loss (1964) is convex, so from any start it finds the
/// angles that most features agree on. Squares are for the features that are then kept.
enum class Loss : std::uint8_t { huber, squares };

/// The equations of the features and the target.
class NormalEquations {
 public:
  explicit NormalEquations(const Problem& problem) : problem_(problem) {}

  /// Linearises everything at a state. The damping is Levenberg and Marquardt's, on each feature's
  /// own information. Returns false if a point that counts is behind its look.
  [[nodiscard]] bool linearise(const Robot& robot, const State& state, Loss loss, double damping);
  /// Only renews the cost and the gradient, with squared loss. The information stays that of an
  /// earlier state; Gauss-Newton still converges while that state is near.
  [[nodiscard]] bool renew_gradient(const Robot& robot, const State& state);
  /// Also renews the target's part of the information.
  [[nodiscard]] bool renew_target(const Robot& robot, const State& state);
  /// True if the information is for these features and squared loss: no pixel has been added or
  /// removed.
  [[nodiscard]] bool is_of_the_same_pixels() const;

  [[nodiscard]] double cost() const { return cost_; }  // without the robot's priors
  [[nodiscard]] const Vector& gradient() const { return gradient_; }
  /// Information of everything, and of the features alone; both triangles are filled.
  [[nodiscard]] const Matrix& information() const { return information_; }
  [[nodiscard]] const Matrix& features_information() const { return features_information_; }

  /// Derivatives of the target's pixel in a kept look, in standard deviations, as used in the
  /// information.
  [[nodiscard]] Matrix target_row(std::size_t look) const;

  /// Moves the features along with a step of the raw columns.
  void step_features(const Vector& raw_step, State& next) const;
  /// Variance of a feature's inverse depth with everything else fixed, and its derivative by the
  /// raw columns.
  [[nodiscard]] double inverse_depth_variance(std::size_t index, Vector& by_raw) const;

 private:
  /// A pixel at the state, in standard deviations and weighted by the loss.
  struct Pixel {
    Eigen::Matrix<double, robot_columns, 2> by_robot;
    Eigen::Matrix<double, 2, 3> by_point;
    Eigen::Vector2d residual;
  };
  struct Feature {
    LookSet kept = 0;
    Eigen::Matrix3d inverse_information;
    Eigen::Vector3d gradient;
    std::array<Pixel, looks_max> pixels;  // one per look
  };

  enum class Renewed : std::uint8_t { gradient, target, all };
  using TargetRow = Eigen::Matrix<double, 2, robot_columns + 3>;
  [[nodiscard]] bool add_everything(const Robot& robot, const State& state, Loss loss,
                                    Renewed renewed);
  [[nodiscard]] bool add_target(const Robot& robot, const State& state, Renewed renewed);
  [[nodiscard]] int place_of(std::size_t look, int column) const;
  [[nodiscard]] bool add_pixel(const Robot& robot, const State& state, Loss loss, std::size_t index,
                               std::size_t look, Eigen::Matrix3d& information);
  [[nodiscard]] bool add_feature(const Robot& robot, const State& state, Loss loss,
                                 std::size_t index, Renewed renewed);
  void add_information(const Feature& feature);
  void add_gradient(const Feature& feature);

  const Problem& problem_;
  double damping_ = 0.0;
  double cost_ = 0.0;
  int camera_at_ = 0;
  Vector gradient_;
  Matrix information_, features_information_;
  std::array<TargetRow, looks_max> target_rows_;
  // What the features' information was made with.
  bool of_squares_ = false;  // undamped
  double scale_ = 0.0;       // Problem::feature_scale
  std::size_t feature_count_ = 0;
  std::array<Feature, features_max> features_;
};

}  // namespace gazed::triangulation::all_looks
