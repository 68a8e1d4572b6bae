// A real pan-tilt camera that read its angles and the images of marks on the floor (Dai, Xiong and
// Li 2011). Its lever arm is a few centimetres: near marks can be triangulated, far ones cannot,
// and that must be said.
#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/cholesky.hpp"
#include "agent/triangulation/estimate.hpp"

#include "real_data.hpp"

namespace gazed::triangulation::pan_tilt_test {
namespace {

using Eigen::Vector3d;

struct Reading {
  geometry::HeadAngles head;  // pan is to the right, tilt is down
  geometry::Pixel pixel;
  Vector3d mark_m;  // on the floor, x forward, y left
};

std::vector<Reading> readings(const std::filesystem::path& file) {
  constexpr double rad = std::numbers::pi / 180.0, m_per_cm = 0.01;
  std::ifstream stream = open_data(file);
  std::vector<Reading> out;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream numbers(line);
    double pan = 0.0, tilt = 0.0, u = 0.0, v = 0.0, x = 0.0, y = 0.0;
    if (!(numbers >> pan >> tilt >> u >> v >> x >> y)) continue;  // one line is blank
    // Pixels were read at half the resolution of the calibration.
    out.push_back(
        {{-pan * rad, tilt * rad}, {2.0 * u, 2.0 * v}, {m_per_cm * x, m_per_cm * y, 0.0}});
  }
  return out;
}

/// The camera's published calibration.
geometry::CameraModel pan_tilt_camera() {
  geometry::CameraModel camera;
  camera.focal_px = {471.34, 472.98};
  camera.centre_px = {301.39, 267.57};
  return camera;
}

/// Where the pan axis stands, pan zero, the camera's offset and rotation in its mount, and how much
/// of an angle is executed, for pan and tilt.
constexpr int parameters = 11;
using Parameters = Eigen::Matrix<double, parameters, 1>;

/// Unlike a NAO's, the two axes do not meet: the tilt axis is 5.8 mm before and 22 mm above the
/// origin of the pan axis (published with the data).
geometry::Pose cam_from_floor(const Parameters& p, geometry::HeadAngles head) {
  const geometry::Pose floor_from_pan{geometry::about_z(p(9) * head.yaw_rad + p(2)),
                                      Vector3d(p(0), 0.0, p(1))};
  const geometry::Pose pan_from_tilt{geometry::about_y(p(10) * head.pitch_rad),
                                     Vector3d(0.0058, 0.0, 0.022)};
  geometry::HeadGeometry mount;
  mount.mount_offset_m = p.segment<3>(3);
  mount.mount_rotation_rad = p.segment<3>(6);
  return geometry::cam_from_torso(mount, {}) * (floor_from_pan * pan_from_tilt).inverse();
}

Eigen::VectorXd residuals_px(const Parameters& p, const std::vector<Reading>& all) {
  Eigen::VectorXd out(2 * static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto pixel =
        geometry::project(pan_tilt_camera(), cam_from_floor(p, all[i].head) * all[i].mark_m);
    const geometry::Pixel error =
        pixel ? geometry::Pixel(*pixel - all[i].pixel) : geometry::Pixel(1e3, 1e3);
    // Huber's loss: a few marks were misread.
    constexpr double outlier_px = 10.0;
    const double size = error.norm();
    const double weight =
        size > outlier_px ? std::sqrt(outlier_px * (2.0 * size - outlier_px)) / size : 1.0;
    out.segment<2>(2 * static_cast<Eigen::Index>(i)) = weight * error;
  }
  return out;
}

/// Levenberg and Marquardt, with numerical derivatives.
Parameters fitted(const std::vector<Reading>& all) {
  Parameters p;
  p << 0.0, 0.5, 0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.0, 1.0, 1.0;
  double damping = 1e-3;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Eigen::VectorXd r = residuals_px(p, all);
    Eigen::MatrixXd jacobian(r.size(), parameters);
    for (int k = 0; k < parameters; ++k) {
      constexpr double difference = 1e-6;
      jacobian.col(k) = (residuals_px(p + difference * Parameters::Unit(k), all) - r) / difference;
    }
    Eigen::MatrixXd normal = jacobian.transpose().lazyProduct(jacobian);
    normal.diagonal() *= 1.0 + damping;
    if (!geometry::factorise(normal)) {
      damping *= 10.0;
      continue;
    }
    Parameters step = jacobian.transpose().lazyProduct(r);
    geometry::solve_factorised(normal, step);
    const Parameters candidate = p - step;
    const bool better = residuals_px(candidate, all).squaredNorm() < r.squaredNorm();
    damping *= better ? 0.3 : 10.0;
    if (better) p = candidate;
  }
  return p;
}

TEST(PanTilt, FarMarksComeOutUncertain) {
  const auto folder = real_data("pan_tilt");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  const std::vector<Reading> all = readings(folder / "calibration_data.log");
  ASSERT_EQ(all.size(), 71U);
  const Parameters fit = fitted(all);
  const double rms_px = residuals_px(fit, all).norm() / std::sqrt(2.0 * 71.0);
  EXPECT_LT(rms_px, 8.0) << fit.transpose();
  // What the model leaves over is all that is known of the errors.
  const Eigen::Matrix2d noise_px2 = rms_px * rms_px * Eigen::Matrix2d::Identity();

  constexpr double far_m = 2.0;
  int far = 0, near = 0, near_located = 0, near_within = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (all[i].mark_m != all[j].mark_m || all[i].head == all[j].head) continue;
      const geometry::Pose cam1_from_floor = cam_from_floor(fit, all[i].head);
      const PointEstimate out = estimate_point(
          {.cam2_from_cam1 = cam_from_floor(fit, all[j].head) * cam1_from_floor.inverse(),
           .point_1 = *image_point(pan_tilt_camera(), all[i].pixel, noise_px2),
           .point_2 = *image_point(pan_tilt_camera(), all[j].pixel, noise_px2),
           .torso_from_cam1 = cam1_from_floor.inverse()},
          {}, {});
      if (all[i].mark_m.norm() > far_m) {
        ++far;
        EXPECT_EQ(name(out.status), name(Status::uncertain)) << out.reason;
        continue;
      }
      ++near;
      near_located += out.status == Status::located ? 1 : 0;
      const double truth = 1.0 / (cam1_from_floor * all[i].mark_m).norm();
      near_within +=
          std::abs(out.inverse_range_per_m - truth) <= 2.0 * out.inverse_range_sigma_per_m ? 1 : 0;
    }
  }
  EXPECT_EQ(far, 132);
  EXPECT_GE(near_located, 10) << "of " << near << ": the gate does not turn everything away";
  EXPECT_GE(near_within, 0.95 * near);
}

}  // namespace
}  // namespace gazed::triangulation::pan_tilt_test
