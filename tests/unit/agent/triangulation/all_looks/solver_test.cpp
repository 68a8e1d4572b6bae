#include "agent/triangulation/all_looks/solver.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "agent/triangulation/all_looks/features.hpp"
#include "agent/triangulation/all_looks/torso_level.hpp"

#include "tests/unit/agent/triangulation/random.hpp"
#include "tests/unit/agent/triangulation/rooms.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::triangulation::all_looks::solver_test {
namespace {

/// A room's problem, as locate would set it up; the room must outlive it.
struct Solving {
  Problem problem;
  State state;
  Solver solver{problem, state};

  explicit Solving(const Room& room) {
    problem.rig = room.rig;
    problem.looks = room.looks.size();
    const geometry::Uncertainty& sigmas = problem.rig.uncertainty;
    problem.torso = {sigmas.torso_rotation_sigma_rad, sigmas.torso_translation_sigma_m};
    for (std::size_t k = 0; k < problem.looks; ++k) {
      problem.measured[k] = room.looks[k].head;
      problem.target[k].pixel = room.looks[k].pixel;
      problem.target_kept |= only_look(k);
    }
    state.robot.setZero(problem.robot_unknowns());
    state.target.direction = geometry::normalise(problem.rig.camera, room.looks[0].pixel).value();
    state.target.inverse_depth_per_m = room.inverse_range_per_m;
    anchor_sweeps(state.robot, problem);
    add_features(room.features, problem.target_kept, problem, state);
  }

  /// The looks of what is kept of a feature that have its point in front of them.
  LookSet in_front(std::size_t feature) const {
    const Robot robot(problem, state.robot);
    const LookSet kept = problem.features[feature].kept;
    LookSet out = only_look(0);
    for (std::size_t k = 1; k < problem.looks; ++k) {
      PointInLook seen;
      if (contains(kept, k) && robot.see_at_target_row(k, state.features[feature], seen)) {
        out |= only_look(k);
      }
    }
    return out;
  }
};

/// From inverse depths that are far off, Gauss-Newton's steps go far beyond, and many a point
/// behind a look. What is behind at the start goes, and nothing else.
TEST(Solver, AStepThatPutsAPointBehindALookCostsNoPixel) {
  constexpr double far_off_per_m = 50.0;  // seven of ten such rooms have a step of that kind
  Random random(71);
  for (int i = 0; i < test::trials(50, 12); ++i) {
    const Room drawn = random_room({.range_m = 0.5, .features = 20, .exact = true}, random);
    Solving room(drawn);
    std::vector<LookSet> in_front;
    for (std::size_t f = 0; f < room.problem.feature_count; ++f) {
      room.state.features[f].inverse_depth_per_m += far_off_per_m * random.normal();
      in_front.push_back(room.in_front(f));
    }
    ASSERT_TRUE(room.solver.solve(Loss::huber));
    for (std::size_t f = 0; f < room.problem.feature_count; ++f) {
      EXPECT_EQ(room.problem.features[f].kept, in_front[f]) << "room " << i << ", feature " << f;
    }
  }
}

/// A look less, or a torso that stands still: what an earlier solution knew of the features is used
/// again, and must not show.
TEST(Solver, WhatIsUsedAgainGivesTheSolutionThatANewStartGives) {
  constexpr double of_a_sigma = 1e-3, of_a_covariance = 3e-3;
  Random random(73);
  for (int i = 0; i < test::trials(30, 8); ++i) {
    const Room drawn =
        random_room({.range_m = 0.4, .features = 40, .torso_may_move = true}, random);
    Solving room(drawn);
    ASSERT_TRUE(room.solver.solve(Loss::huber));
    ASSERT_TRUE(room.solver.solve(Loss::squares));
    room.problem.target_kept = static_cast<LookSet>(room.problem.target_kept & ~only_look(3));
    if (i % 2 == 0) {
      const auto torso = likeliest_torso(room.problem, room.state, room.solver.torso_covariance());
      ASSERT_TRUE(torso.has_value());
      room.solver.tighten_torso(torso->sigma, torso->pull);
    }
    State anew = room.state;
    ASSERT_TRUE(room.solver.solve(Loss::squares));
    Solver other(room.problem, anew);
    ASSERT_TRUE(other.solve(Loss::squares));
    const Matrix& expected = other.covariance();
    const double sigma = std::sqrt(expected(expected.rows() - 1, expected.cols() - 1));
    EXPECT_LT((room.state.robot - anew.robot).norm(), of_a_sigma) << i;
    EXPECT_NEAR(room.state.target.inverse_depth_per_m, anew.target.inverse_depth_per_m,
                of_a_sigma * sigma)
        << i;
    EXPECT_LT((room.solver.covariance() - expected).norm(), of_a_covariance * expected.norm()) << i;
  }
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::solver_test
