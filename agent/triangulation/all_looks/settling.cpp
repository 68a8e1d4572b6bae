// Decides which looks are believed, and fills in what is reported about them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "agent/base/text.hpp"
#include "agent/triangulation/all_looks/answer.hpp"
#include "agent/triangulation/all_looks/estimation.hpp"
#include "agent/triangulation/all_looks/target.hpp"
#include "agent/triangulation/all_looks/torso_level.hpp"
#include "agent/triangulation/chi_square.hpp"

namespace gazed::triangulation::all_looks {

namespace {

// The target's pixels may exceed their sigmas by this factor, 2 px with the profiles' sigma, and
// still be explained by drift: another object lies farther off. Needs at least three later looks.
constexpr double drift_scale_max = 6.0;
constexpr int drift_degrees_min = 5;

}  // namespace

void Estimation::settle_and_answer(int dropped, Estimate& out) {
  const bool agree = settle(dropped, out);
  if (agree) weigh_scale(problem_, solver_.covariance(), state_);
  fill_head(out);
  if (!agree) return;
  out.point = answer_of(problem_, state_, solver_.covariance(), gate_);
  out.point.reason += left_out();
  if (out.point.status == Status::degenerate) return;
  out.budget = target_budget(problem_, state_, solver_);
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    out.looks[k].used = contains(problem_.target_kept, k);
    if (!out.looks[k].used) out.looks[k].reason = why_left_out(k);
  }
  out.looks[0].status = out.point.status;
  out.looks_used = static_cast<std::size_t>(later_looks(problem_.target_kept)) + 1;
}

/// Drops looks until the others agree on the target. Returns false if too few are left to tell
/// which are right; the answer then says so.
bool Estimation::settle(int dropped, Estimate& out) {
  // The gate's limit is for a pair, which has one degree of freedom.
  const double wider = gate_.epipolar_chi2_max / chi2_999;
  for (;;) {
    const TargetAgreement found = target_agreement(problem_, state_, solver_);
    out.chi2 = found.chi2;
    out.degrees_of_freedom = found.degrees_of_freedom;
    const bool agree = found.chi2 <= wider * chi2_999_of(found.degrees_of_freedom) &&
                       found.worst_chi2 <= wider * chi2_999_of(2);
    const int left = later_looks(problem_.target_kept);
    for (std::size_t k = 1; k < looks_.size(); ++k) {
      if (contains(problem_.target_kept, k)) out.looks[k].chi2 = found.look_chi2[k];
    }
    if (agree && left > dropped) return true;
    if (agree || left <= dropped + 2) {
      out.point = images_of(problem_, state_);
      out.point.status = Status::target_lost;
      out.point.reason = base::text(
                             "%zu looks contradict each other, chi-square %.1f: not one "
                             "point",
                             looks_.size(), found.chi2) +
                         left_out();
      return false;
    }
    ++dropped;
    problem_.target_kept =
        static_cast<LookSet>(problem_.target_kept & ~only_look(found.worst_look));
    contradiction_chi2_[found.worst_look] = found.worst_chi2;
    out.looks[found.worst_look].status = Status::target_lost;
    out.looks[found.worst_look].chi2 = found.worst_chi2;
    if (!solver_.solve(Loss::squares)) {
      out.point.status = Status::degenerate;
      out.point.reason = "the looks that agree do not determine a point" + left_out();
      return false;
    }
  }
}

/// An object in a draught drifts by millimetres while it is looked at: no look is wrong, but all of
/// them differ by more than their pixels' noise. Takes that spread as the noise (Birge ratio:
/// Birge, Physical Review 40, 1932) and brings back all looks. Returns false if there are too few
/// looks, or if the spread is too large for drift.
bool Estimation::believe_that_it_moves() {
  problem_.target_kept = valid_;
  contradiction_chi2_.fill(not_a_number);
  if (!solver_.solve(Loss::squares)) return false;
  const TargetAgreement found = target_agreement(problem_, state_, solver_);
  const double scale = std::sqrt(found.chi2 / found.degrees_of_freedom);
  if (found.degrees_of_freedom < drift_degrees_min || !(scale <= drift_scale_max)) return false;
  widen_target(scale);
  return solver_.solve(Loss::squares);
}

/// Relative to the configured joint zeros, not the estimated ones.
void Estimation::fill_head(Estimate& out) {
  const Robot robot(problem_, state_.robot);
  const geometry::HeadAngles zero_error = robot.head().zero - problem_.rig.head.zero;
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    if (!contains(finite_, k)) continue;
    out.reading[k] = robot.reading(k);
    out.head[k] = out.reading[k] + zero_error;
    out.torso_1_from_torso[k] = robot.torso_1_from_torso(k);
  }
  out.robot = robot.believed(solver_.covariance());
}

std::string Estimation::left_out() const {
  std::string out;
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    if (contains(problem_.target_kept, k)) continue;
    out += base::text("; look %zu left out: ", k + 1) + why_left_out(k);
  }
  return out;
}

std::string Estimation::why_left_out(std::size_t k) const {
  return std::isfinite(contradiction_chi2_[k])
             ? base::text("the others contradict it, chi-square %.1f", contradiction_chi2_[k])
             : pair_[k].estimate.reason;
}

}  // namespace gazed::triangulation::all_looks
