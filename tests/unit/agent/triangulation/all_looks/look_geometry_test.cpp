#include "agent/triangulation/all_looks/look_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/chi_square.hpp"

#include "tests/unit/agent/triangulation/random.hpp"
#include "tests/unit/agent/triangulation/scenes.hpp"

namespace gazed::triangulation::all_looks::look_geometry_test {
namespace {

/// Of central differences with steps of 1e-5 in standard deviations of 1e-2.
constexpr double derivative_error = 1e-6;

/// Two looks at one point, everything about them uncertain.
struct Derivatives : testing::Test {
  Scene scene = step_rule_scene();
  Problem problem;
  State state;

  Derivatives() {
    scene.head.mount_rotation_rad = {0.03, 0.05, -0.02};
    scene.head.zero = {0.01, -0.02};
    problem.rig.head = scene.head;
    problem.rig.camera = scene.camera;
    problem.rig.uncertainty = {.pixel_sigma_px = 1.0,
                               .encoder_sigma_rad = 1e-2,
                               .zero_sigma_rad = 2e-2,
                               .focal_sigma_px = 5.0,
                               .centre_sigma_px = 4.0,
                               .distortion_sigma = {3e-2, 5e-2},
                               .mount_offset_sigma_m = 1e-2,
                               .mount_rotation_sigma_rad = 3e-2};
    problem.looks = 3;
    problem.measured = {scene.head_1, scene.head_2, scene.head_1 + geometry::HeadAngles{0.3, -0.2}};
    problem.sweep_sigma_rad = {1e-4, 1e-4, 1e-4};
    problem.torso = {.rotation_rad = 1.2e-2, .translation_m = 5e-3};
    problem.row_px = {100.0, 200.0, 300.0};
    state.robot.setZero(problem.robot_unknowns());
    Random random(11);
    for (double& unknown : state.robot) unknown = 0.5 * random.normal();
    anchor_sweeps(state.robot, problem);
    state.target = {{0.1, -0.2}, 1.5};
  }

  /// A point of look 1's torso in that of another look.
  static Eigen::Vector3d in_torso_of(const Robot& robot, std::size_t k,
                                     const Eigen::Vector3d& point_m) {
    const TorsoMotion& torso = robot.torso(k);
    const double angle = torso.rotation_rad.norm();
    const Eigen::Vector3d axis =
        angle > 0.0 ? Eigen::Vector3d(torso.rotation_rad / angle) : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d& neck_m = robot.head().neck_offset_m;
    return neck_m + Eigen::AngleAxisd(-angle, axis) * (point_m - neck_m) - torso.translation_m;
  }

  State moved(int unknown, double step) const {
    State out = state;
    const int robot = problem.robot_unknowns();
    if (unknown < robot) {
      out.robot(unknown) += step;
    } else if (unknown < robot + 2) {
      out.target.direction(unknown - robot) += step;
    } else {
      out.target.inverse_depth_per_m += step;
    }
    return out;
  }
};

TEST_F(Derivatives, OfAPixelAreThoseOfDifferences) {
  constexpr double step = 1e-5, row_px = 450.0;
  const Robot robot(problem, state.robot);
  for (std::size_t k = 0; k < problem.looks; ++k) {
    const auto see = [&](const State& at) {
      const Robot there(problem, at.robot);
      PointInLook seen;
      EXPECT_TRUE(there.see(k, at.target, row_px, seen));
      return seen;
    };
    const PointInLook seen = see(state);
    const int columns = robot.raw_columns();
    Matrix raw = Matrix::Zero(2, columns + 3);
    for (int i = 0; i < 2; ++i) robot.add_raw(k, seen.by_robot.row(i), raw.row(i).head(columns));
    raw.rightCols<3>() = seen.by_point;
    const Matrix by_unknowns = robot.by_unknowns(raw);
    for (int i = 0; i < problem.unknowns(); ++i) {
      const Eigen::Vector2d difference =
          (see(moved(i, step)).pixel - see(moved(i, -step)).pixel) / (2.0 * step);
      EXPECT_LT((difference - by_unknowns.col(i)).norm(),
                derivative_error * (1.0 + difference.norm()))
          << "look " << k << ", unknown " << i;
    }
  }
}

TEST_F(Derivatives, OfABaselineAreThoseOfDifferences) {
  constexpr double step = 1e-5;
  const Robot robot(problem, state.robot);
  const int columns = robot.raw_columns();
  const auto by_pose = robot.look(2).baseline_by_pose();
  Matrix raw = Matrix::Zero(3, columns + 3);
  for (int i = 0; i < 3; ++i) {
    Eigen::Matrix<double, 1, robot_columns> by_robot =
        Eigen::Matrix<double, 1, robot_columns>::Zero();
    by_robot.head<pose_columns>() = by_pose.row(i);
    robot.add_raw(2, by_robot, raw.row(i).head(columns));
  }
  const Matrix by_unknowns = robot.by_unknowns(raw);
  for (int i = 0; i < problem.robot_unknowns(); ++i) {
    const auto at = [&](double by) {
      return Robot(problem, moved(i, by).robot).look(2).cam_from_cam1().translation;
    };
    const Eigen::Vector3d difference = (at(step) - at(-step)) / (2.0 * step);
    EXPECT_LT((difference - by_unknowns.col(i)).norm(), derivative_error) << "unknown " << i;
  }
}

TEST_F(Derivatives, AStepInTheUnknownsIsOneInTheRawColumns) {
  Random random(72);
  for (const bool torso_moves : {true, false}) {
    if (!torso_moves) set_torso({}, problem, state);
    const Robot robot(problem, state.robot);
    Vector step = Vector::Zero(problem.unknowns());
    for (double& unknown : step) unknown = random.normal();
    Matrix raw = Matrix::Zero(1, robot.raw_columns() + 3);
    for (Eigen::Index i = 6; i < raw.cols(); ++i) raw(0, i) = random.normal();  // but look 1's pose
    EXPECT_NEAR(robot.by_unknowns(raw).row(0).dot(step), raw.row(0).dot(robot.raw_step(step)),
                1e-9);
  }
}

TEST_F(Derivatives, APointIsSeenWhereTheHeadSeesIt) {
  const Robot robot(problem, state.robot);
  const geometry::Pose cam1_from_torso = geometry::cam_from_torso(robot.head(), robot.reading(0));
  const Eigen::Vector3d torso_point_m = cam1_from_torso.inverse() * state.target.point_m();
  for (std::size_t k = 1; k < problem.looks; ++k) {
    PointInLook seen;
    ASSERT_TRUE(robot.see_at_target_row(k, state.target, seen));
    const auto pixel =
        geometry::project(robot.camera(), geometry::cam_from_torso(robot.head(), robot.reading(k)) *
                                              in_torso_of(robot, k, torso_point_m));
    EXPECT_LT((seen.pixel - pixel.value()).norm(), 1e-9);
  }
}

// What a sweep of 2 mrad leaves of a pixel at the other end of the frame, px.
constexpr double first_order_px = 2e-3;

TEST_F(Derivatives, APixelIsSeenByTheAnglesOfItsOwnRow) {
  constexpr double row_px = 440.0;
  problem.sweep_sigma_rad = {};
  problem.sweep = {{{2e-3, -1e-3}, {-1e-3, 2e-3}, {1e-3, 2e-3}}};
  const Robot robot(problem, state.robot);
  const geometry::Pose cam1_from_torso = geometry::cam_from_torso(robot.head(), robot.reading(0));
  const Eigen::Vector3d torso_point_m = cam1_from_torso.inverse() * state.target.point_m();
  for (std::size_t k = 0; k < problem.looks; ++k) {
    PointInLook seen, at_target_row;
    ASSERT_TRUE(robot.see(k, state.target, row_px, seen));
    ASSERT_TRUE(robot.see_at_target_row(k, state.target, at_target_row));
    const double share = (row_px - problem.row_px[k]) / (problem.rig.camera.height_px - 1);
    const geometry::HeadAngles& sweep = problem.sweep[k];
    const geometry::HeadAngles then =
        robot.reading(k) + geometry::HeadAngles{share * sweep.yaw_rad, share * sweep.pitch_rad};
    const auto pixel =
        geometry::project(robot.camera(), geometry::cam_from_torso(robot.head(), then) *
                                              in_torso_of(robot, k, torso_point_m));
    EXPECT_LT((seen.pixel - pixel.value()).norm(), first_order_px) << "look " << k;
    EXPECT_GT((at_target_row.pixel - pixel.value()).norm(), 100 * first_order_px) << "look " << k;
  }
}

TEST_F(Derivatives, APointBehindALookIsNotSeen) {
  problem.measured[1] = problem.measured[0] + geometry::HeadAngles{2.0, 0.0};
  const Robot robot(problem, state.robot);
  PointInLook seen;
  EXPECT_FALSE(robot.see_at_target_row(1, state.target, seen));
  state.target.inverse_depth_per_m = not_a_number;
  EXPECT_FALSE(robot.see_at_target_row(2, state.target, seen));
}

/// The regularised incomplete gamma function by its series: Abramowitz and Stegun 1964, 6.5.29.
double share_below(double chi2, double degrees) {
  const double a = 0.5 * degrees, x = 0.5 * chi2;
  double term = 1.0 / a, sum = term;
  for (int n = 1; n < 500; ++n) sum += term *= x / (a + n);
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

TEST(ChiSquare, HoldsThisShareOfChiSquares) {
  constexpr double table_digits = 2e-6, approximation = 3e-5;
  for (int degrees = 1; degrees <= 60; ++degrees) {
    EXPECT_NEAR(share_below(chi2_999_of(degrees), degrees), 0.999,
                degrees <= 30 ? table_digits : approximation)
        << degrees;
  }
  EXPECT_EQ(chi2_999_of(0), 0.0);
  EXPECT_EQ(chi2_999_of(-1), 0.0);
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::look_geometry_test
