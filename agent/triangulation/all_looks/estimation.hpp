// One estimate from all looks, while it is being made: what the pairs say, the problem and its
// solution, and which looks are believed.
#pragma once

#include <array>
#include <bit>
#include <optional>
#include <span>
#include <string>

#include "agent/triangulation/all_looks/features.hpp"
#include "agent/triangulation/all_looks/locate.hpp"
#include "agent/triangulation/all_looks/pair.hpp"
#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/all_looks/solver.hpp"
#include "agent/triangulation/gate.hpp"

namespace gazed::triangulation::all_looks {

/// The number of looks in a set, not counting look 1.
[[nodiscard]] inline int later_looks(LookSet set) {
  return std::popcount(static_cast<LookSet>(set & ~only_look(0)));
}

/// Needs two to looks_max looks and at most features_max features; locate() refuses anything else.
class Estimation {
 public:
  Estimation(const geometry::Rig& rig, std::span<const Look> looks, const Gate& gate);

  [[nodiscard]] Estimate estimate(std::span<const FeatureObservations> features);
  /// Predicted sigma of the inverse range after one more look; `estimate` must have located the
  /// point. Destroys the problem. NaN as in Estimate::expected_sigma_per_m.
  [[nodiscard]] double expected_sigma_per_m(geometry::HeadAngles next,
                                            std::span<const FeatureObservations> features);

 private:
  void judge_pair(std::size_t k);
  [[nodiscard]] Problem::TargetObservation target_observation(std::size_t k) const;
  [[nodiscard]] TorsoSigma loosest_torso() const;
  void start(LookSet target_looks, TorsoSigma loosest);
  [[nodiscard]] bool estimate_with(std::span<const FeatureObservations> features, Estimate& out);
  [[nodiscard]] bool choose_torso();
  struct Solved {
    FeatureAgreement agreement;
    double badness = 0.0;
  };
  [[nodiscard]] std::optional<Solved> solve_with(std::span<const FeatureObservations> features,
                                                 TorsoSigma loosest);
  [[nodiscard]] std::optional<FeatureAgreement> solve_likeliest(
      std::span<const FeatureObservations> features);
  [[nodiscard]] bool believe_that_it_moves();
  void widen_target(double scale);
  void estimate_without_features(Estimate& out);
  void make_room_for_a_look(geometry::HeadAngles next);
  void add_features_unseen(std::span<const FeatureObservations> features);
  void settle_and_answer(int dropped, Estimate& out);
  [[nodiscard]] bool settle(int dropped, Estimate& out);
  void fill_head(Estimate& out);
  [[nodiscard]] std::string left_out() const;
  [[nodiscard]] std::string why_left_out(std::size_t k) const;

  Gate gate_;
  std::span<const Look> looks_;
  // What every pair says by itself.
  std::array<Pair, looks_max> pair_;       // look 1 and each later look
  LookSet finite_ = only_look(0);          // looks whose angles are numbers
  LookSet valid_ = only_look(0);           // those in which the target also has a ray
  LookSet uncontradicted_ = only_look(0);  // those whose pair also does not contradict itself
  std::array<double, looks_max> contradiction_chi2_;  // of looks contradicted by the others

  double target_scale_ = 1.0;  // of the sigmas of the target's later pixels
  Problem problem_;
  State state_;
  Solver solver_{problem_, state_};
};

}  // namespace gazed::triangulation::all_looks
