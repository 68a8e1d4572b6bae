#include "agent/geometry/epipolar.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::geometry::epipolar_test {
namespace {

// The golden numbers have 25 digits; F itself is good to 1e-16 an entry.
constexpr double golden = 1e-9;
// x2^T F x1 with unit |F| and pixels of up to 1000: 1e6 times the rounding of double.
constexpr double residual_tolerance = 1e-9;
constexpr double rounding = 1e-14;

const Eigen::Matrix3d report_k =
    (Eigen::Matrix3d() << 752, 0, 331, 0, 752, 253, 0, 0, 1).finished();

// Golden numbers are strings, so that none of their digits is lost, or small integers.
double number(const nlohmann::json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

template <int rows>
Eigen::Matrix<double, rows, 1> vector(const nlohmann::json& values) {
  Eigen::Matrix<double, rows, 1> v;
  for (int i = 0; i < rows; ++i) v(i) = number(values.at(static_cast<std::size_t>(i)));
  return v;
}

Eigen::Matrix3d matrix(const nlohmann::json& rows) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    m.row(i) = vector<3>(rows.at(static_cast<std::size_t>(i))).transpose();
  return m;
}

nlohmann::json golden_geometries() {
  std::ifstream file(GAZED_TEST_DATA "/golden/report_geometry.json");
  return nlohmann::json::parse(file).at("geometries");
}

TEST(Epipolar, FundamentalMatrixIsTheGoldenOne) {
  const nlohmann::json geometries = golden_geometries();
  for (const auto& [name, geometry] : geometries.items()) {
    SCOPED_TRACE(name);
    const Pose cam2_from_cam1{matrix(geometry.at("R")), vector<3>(geometry.at("t"))};
    const auto f = fundamental_matrix(report_k, report_k, cam2_from_cam1);
    ASSERT_TRUE(f);
    EXPECT_NEAR(f->norm(), 1.0, rounding);
    Eigen::Matrix3d expected = matrix(geometry.at("F_unit_frobenius"));
    if (f->cwiseProduct(expected).sum() < 0.0) expected = -expected;  // F has no sign of its own
    EXPECT_LT((*f - expected).cwiseAbs().maxCoeff(), golden);
    for (const auto& point : geometry.at("points")) {
      const Eigen::Vector3d x1 = vector<2>(point.at("x1")).homogeneous();
      const Eigen::Vector3d x2 = vector<2>(point.at("x2")).homogeneous();
      EXPECT_NEAR(x2.dot(*f * x1), 0.0, residual_tolerance);
    }
  }
}

TEST(Epipolar, GoldenPointsProjectToTheirPixels) {
  const CameraModel camera{640, 480, {752, 752}, {331, 253}, {}};
  const nlohmann::json geometries = golden_geometries();
  for (const auto& [name, geometry] : geometries.items()) {
    SCOPED_TRACE(name);
    const Pose cam2_from_cam1{matrix(geometry.at("R")), vector<3>(geometry.at("t"))};
    for (const auto& point : geometry.at("points")) {
      const Eigen::Vector3d in_cam1 = vector<3>(point.at("X"));
      const auto x1 = project(camera, in_cam1), x2 = project(camera, cam2_from_cam1 * in_cam1);
      ASSERT_TRUE(x1 && x2);
      EXPECT_LT((*x1 - vector<2>(point.at("x1"))).norm(), golden);
      EXPECT_LT((*x2 - vector<2>(point.at("x2"))).norm(), golden);
    }
  }
}

TEST(Epipolar, HeadTurnOfHalfARadianIsTheGoldenOne) {
  // Its mount is that of V4 and later without the 0.0209 rad of pitch.
  const nlohmann::json geometry = golden_geometries().at("NAO_yaw05");
  HeadGeometry head = robot_profile("nao-v4")->rig.head;
  head.mount_rotation_rad.setZero();
  const Pose pose = cam2_from_cam1(head, {0.0, 0.0}, {-0.5, 0.0});
  EXPECT_LT((pose.rotation - matrix(geometry.at("R"))).norm(), rounding);
  EXPECT_LT((1000.0 * pose.translation - vector<3>(geometry.at("t"))).norm(), golden);
}

TEST(Epipolar, BothImagesOfAPointSatisfyTheConstraint) {
  const Rig rig = robot_profile("nao-v6")->rig;
  const Eigen::Matrix3d k = calibration_matrix(rig.camera);
  const HeadAngles first{0.1, 0.05}, second{0.3, -0.15};
  const auto f = fundamental_matrix(k, k, cam2_from_cam1(rig.head, first, second));
  ASSERT_TRUE(f);
  for (const Eigen::Vector3d& point_in_torso :
       {Eigen::Vector3d(0.4, 0.05, 0.1), Eigen::Vector3d(1.0, 0.3, 0.2),
        Eigen::Vector3d(3.0, 0.5, 0.5)}) {
    const auto x1 = project(rig.camera, cam_from_torso(rig.head, first) * point_in_torso);
    const auto x2 = project(rig.camera, cam_from_torso(rig.head, second) * point_in_torso);
    ASSERT_TRUE(x1 && x2);
    EXPECT_NEAR(x2->homogeneous().dot(*f * x1->homogeneous()), 0.0, residual_tolerance);
  }
}

TEST(Epipolar, EpipolesAreTheOtherCamerasCentre) {
  const Pose pose{about_y(0.3) * about_x(-0.2), {0.02, 0.01, -0.03}};
  const Eigen::Matrix3d e = essential_matrix(pose);
  EXPECT_LT((e * origin(pose)).norm(), rounding);
  EXPECT_LT((e.transpose() * pose.translation).norm(), rounding);
  EXPECT_NEAR(e.determinant(), 0.0, rounding);
}

TEST(Epipolar, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a{1.0, -2.0, 3.0}, b{0.5, 4.0, -1.0};
  EXPECT_LT((skew(a) * b - Eigen::Vector3d(-10.0, 2.5, 5.0)).norm(), rounding);
}

TEST(Epipolar, ZeroBaselineHasNoFundamentalMatrix) {
  EXPECT_FALSE(fundamental_matrix(report_k, report_k, {about_z(0.3), Eigen::Vector3d::Zero()}));
}

TEST(Epipolar, TwoLooksWithTheSameAnglesHaveNoFundamentalMatrix) {
  for (const auto robot : robot_names) {
    const Pose pose = cam2_from_cam1(robot_profile(robot)->rig.head, {-1.1, 0.3}, {-1.1, 0.3});
    EXPECT_FALSE(fundamental_matrix(report_k, report_k, pose)) << robot;
  }
}

TEST(Epipolar, SingularCalibrationMatrixHasNoFundamentalMatrix) {
  const Pose pose{about_y(0.1), {0.01, 0.0, 0.0}};
  Eigen::Matrix3d singular = report_k;
  singular(0, 0) = 0.0;
  EXPECT_FALSE(fundamental_matrix(singular, report_k, pose));
  EXPECT_FALSE(fundamental_matrix(report_k, singular, pose));
}

TEST(Epipolar, NotANumberHasNoFundamentalMatrix) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Pose pose{about_y(0.1), {0.01, nan, 0.0}};
  EXPECT_FALSE(fundamental_matrix(report_k, report_k, pose));
  pose.translation.y() = 0.0;
  pose.rotation(1, 1) = nan;
  EXPECT_FALSE(fundamental_matrix(report_k, report_k, pose));
}

}  // namespace
}  // namespace gazed::geometry::epipolar_test
