// Solves the problem of all looks: Gauss-Newton with Levenberg-Marquardt's damping where a step
// does not help.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "agent/triangulation/all_looks/normal_equations.hpp"
#include "agent/triangulation/all_looks/problem.hpp"

namespace gazed::triangulation::all_looks {

/// Everything that the solver works in; made once, no memory is allocated.
class Solver {
 public:
  /// Works on both from then on.
  Solver(Problem& problem, State& state);

  /// From the state on. A feature's pixel goes from `kept` when its point is behind the look there;
  /// a step that would put a point behind a look is not taken: costs are of the same pixels always.
  /// False when no step leads anywhere: the looks determine nothing.
  ///
  /// Where no pixel has come or gone since the last solution, the features' information is that of
  /// it: it hardly changes, and costs most of the work. The solution is the same.
  [[nodiscard]] bool solve(Loss loss);

  /// Another level of the torso: to where the quadratic of the last solution puts the state with
  /// it. `pull` is what it pulls the torso's unknowns back with (LikeliestTorso).
  void tighten_torso(TorsoSigma torso, const Vector& pull);
  /// Information and covariance of the state as it stands, after a solution of something else.
  /// False when a point is behind its look, or the looks determine nothing.
  [[nodiscard]] bool make_information() {
    return linearise(Loss::squares, Renew::all) && factorised_;
  }

  /// Of the robot's unknowns and the target's, at the last solution: the inverse information, made
  /// when it is first asked for. Of squares alone.
  [[nodiscard]] const Matrix& covariance();
  /// Its last part alone, of the torso's unknowns and the target's, which takes a tenth of the
  /// time.
  [[nodiscard]] Matrix torso_covariance();
  /// The information without the target's pixels, of the robot's unknowns, at the last solution.
  [[nodiscard]] Matrix information_without_target();
  /// The derivatives of the target's pixel in a look that is kept by the unknowns, in standard
  /// deviations: those that the covariance was made with.
  [[nodiscard]] Matrix target_row(std::size_t look) const;
  /// Of a feature's inverse depth near the last solution, 1/m. It must have been in it.
  [[nodiscard]] double inverse_depth_sigma_per_m(std::size_t feature) const;
  /// Cholesky's, of the information, as geometry::factorise() leaves them.
  [[nodiscard]] const Matrix& factors() const { return factors_; }

 private:
  enum class Renew : std::uint8_t {
    gradient,  // the information and its factors remain those of an earlier state
    target,    // but for the target's part of it and the priors
    all
  };

  void drop_pixels_behind();
  /// False when a point that counts is behind its look, or a number is none.
  bool linearise(Loss loss, Renew renew);
  bool raise_damping(Loss loss);
  [[nodiscard]] bool information_serves(double last_decrement) const;
  void be_within(double squared_distance);
  [[nodiscard]] bool step(State& next);
  void take(const Vector& step, State& state) const;

  Problem& problem_;
  State& state_;
  double damping_ = 0.0;

  // At the state.
  NormalEquations equations_;
  double cost_ = 0.0;
  Vector gradient_;
  // At the state at which the information was last renewed.
  std::optional<Robot> robot_;
  Matrix factors_;           // of the information
  bool factorised_ = false;  // it was positive definite

  double decrement_ = 0.0;  // squared length of the last step, in standard deviations
  double moved_ = 0.0;      // the sum of those since the features' information was made
  Matrix covariance_;
  bool covariance_is_made_ = false;
};

}  // namespace gazed::triangulation::all_looks
