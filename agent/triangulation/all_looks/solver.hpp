// Solves the all-looks problem by Gauss-Newton, with Levenberg-Marquardt damping when a step does
// not help.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "agent/triangulation/all_looks/normal_equations.hpp"
#include "agent/triangulation/all_looks/problem.hpp"

namespace gazed::triangulation::all_looks {

/// Owns all working memory; create it once, then nothing is allocated.
class Solver {
 public:
  /// Works on both objects from now on.
  Solver(Problem& problem, State& state);

  /// Solves, starting from the current state. If a feature's point is behind a look at the start,
  /// its pixel is removed from `kept`. A step that would put a point behind a look is not taken, so
  /// costs always compare the same pixels. Returns false if no step leads anywhere: the looks
  /// determine nothing.
  ///
  /// If no pixel has been added or removed since the last solution, the features' information is
  /// reused: it hardly changes, and it is most of the work. The solution is the same.
  [[nodiscard]] bool solve(Loss loss);

  /// Changes the torso's level: moves the state to where the quadratic of the last solution puts it
  /// under the new level. `pull` is how that level pulls the torso's unknowns back
  /// (LikeliestTorso).
  void tighten_torso(TorsoSigma torso, const Vector& pull);
  /// Makes information and covariance for the state as it is, after something else was solved.
  /// Returns false if a point is behind its look, or if the looks determine nothing.
  [[nodiscard]] bool make_information() {
    return linearise(Loss::squares, Renew::all) && factorised_;
  }

  /// -2 log of how likely the observations are when every value of the unknowns is counted
  /// (Laplace's method), up to a constant: how well the features' own depths are determined counts
  /// as the same in all solutions that are compared. Only for squared loss.
  [[nodiscard]] double badness();
  /// Covariance of the robot's unknowns and the target's at the last solution: the inverse
  /// information, computed on first use. Only for squared loss.
  [[nodiscard]] const Matrix& covariance();
  /// Only its last part, of the torso's unknowns and the target's, in a tenth of the time.
  [[nodiscard]] Matrix torso_covariance();
  /// Information of the robot's unknowns at the last solution, without the target's pixels.
  [[nodiscard]] Matrix information_without_target();
  /// Derivatives of the target's pixel in a kept look by the unknowns, in standard deviations, as
  /// used for the covariance.
  [[nodiscard]] Matrix target_row(std::size_t look) const;
  /// Sigma of a feature's inverse depth near the last solution, 1/m. The feature must have been
  /// part of it.
  [[nodiscard]] double inverse_depth_sigma_per_m(std::size_t feature) const;
  /// Cholesky factors of the information, as from geometry::factorise().
  [[nodiscard]] const Matrix& factors() const { return factors_; }

 private:
  enum class Renew : std::uint8_t {
    gradient,  // the information and its factors stay those of an earlier state
    target,    // also the target's part of the information and the priors
    all
  };

  void drop_pixels_behind();
  /// Returns false if a point that counts is behind its look, or a number is not finite.
  bool linearise(Loss loss, Renew renew);
  bool raise_damping(Loss loss);
  [[nodiscard]] bool information_serves(double last_decrement) const;
  void be_within(double squared_distance);
  [[nodiscard]] bool step(State& next);
  void take(const Vector& step, State& state) const;

  Problem& problem_;
  State& state_;
  double damping_ = 0.0;

  // At the current state.
  NormalEquations equations_;
  double cost_ = 0.0;
  Vector gradient_;
  // At the state where the information was last renewed.
  std::optional<Robot> robot_;
  Matrix factors_;           // of the information
  bool factorised_ = false;  // true if it was positive definite

  double decrement_ = 0.0;  // squared length of the last step, in standard deviations
  double moved_ = 0.0;      // sum of those since the features' information was made
  Matrix covariance_;
  bool covariance_is_made_ = false;
};

}  // namespace gazed::triangulation::all_looks
