#include "agent/triangulation/all_looks/refinement.hpp"

#include "agent/triangulation/chi_square.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// Share of the features' pixels in later looks; if fewer agree, there is no telling which are
/// right.
constexpr double kept_share_min = 0.5;
/// Residuals this many times their sigmas are not noise.
constexpr double feature_scale_max = 3.0;
/// Encoders may be this many times worse than stated, and the background then knows better. A
/// repeated pattern that agrees by mistake is farther off.
constexpr double encoder_scale_max = 2.0;

/// Features that agree on a point behind the camera show no real point: later choices leave them
/// out.
void mark_features_behind(const State& state, Solver& solver, Problem& problem) {
  constexpr double sigmas = 3.090232;  // 99.9 % of the standard normal, one-sided
  for (std::size_t i = 0; i < problem.feature_count; ++i) {
    Problem::Feature& feature = problem.features[i];
    const double inverse_depth = state.features[i].inverse_depth_per_m;
    if (feature.kept == 0 || inverse_depth >= 0.0) continue;
    feature.behind = inverse_depth < -sigmas * solver.inverse_depth_sigma_per_m(i);
  }
}

}  // namespace

std::optional<FeatureAgreement> solve_with_features(Problem& problem, State& state,
                                                    Solver& solver) {
  constexpr int rounds = 4;  // of choosing and solving; two are enough except in close cases
  if (!solver.solve(Loss::huber)) return std::nullopt;
  problem.feature_scale = typical_scale(problem, state);
  FeatureAgreement agreement;
  for (int round = 0; round < rounds; ++round) {
    agreement = keep_agreeing(problem, state);
    problem.feature_scale = agreement.scale;
    if (round > 0 && !agreement.changed) break;
    if (!solver.solve(Loss::squares)) return std::nullopt;
    if (round + 1 < rounds) mark_features_behind(state, solver, problem);
  }
  return agreement;
}

bool is_plausible(const Problem& problem, const State& state, const FeatureAgreement& agreement) {
  const int angles = 2 * static_cast<int>(problem.looks);
  double angles_chi2 = 0.0;
  for (std::size_t k = 0; k < problem.looks; ++k) {
    angles_chi2 += state.robot.segment<2>(reading_of(k)).squaredNorm();
  }
  return problem.features_kept() >= features_min &&
         agreement.pixels_kept >= kept_share_min * agreement.pixels_seen &&
         agreement.scale <= feature_scale_max &&
         angles_chi2 <= encoder_scale_max * encoder_scale_max * chi2_999_of(angles);
}

}  // namespace gazed::triangulation::all_looks
