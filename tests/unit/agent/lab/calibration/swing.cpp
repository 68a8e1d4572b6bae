#include "swing.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "agent/base/random.hpp"
#include "agent/geometry/limits.hpp"

namespace gazed::lab::calibration {

namespace {

struct TorsoRay {
  Eigen::Vector3d start, direction;
};

TorsoRay ray_of(const Robot& believed, const Glance& glance) {
  const geometry::Pose torso_from_cam =
      geometry::cam_from_torso(believed.head, glance.measured).inverse();
  const Eigen::Vector2d at = geometry::normalise(believed.camera, glance.pixel).value();
  return {torso_from_cam.translation, torso_from_cam.rotation * at.homogeneous().normalized()};
}

/// The point nearest to both.
Eigen::Vector3d meeting_point(const TorsoRay& a, const TorsoRay& b) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const TorsoRay& ray : {a, b}) {
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose();
    sum += across;
    right += across * ray.start;
  }
  return sum.inverse() * right;
}

}  // namespace

std::vector<Glance> glances_at(const Robot& truth, const Eigen::Vector3d& point,
                               double encoder_sigma_rad, double pixel_sigma_px) {
  constexpr double border_px = 10.0;
  const geometry::HeadLimits limits;
  base::Random random(1, 0);
  std::vector<Glance> glances;
  // Every 0.11 rad: neighbours on both axes are a step of the report's rule.
  for (int row = -6; row <= 6; ++row) {
    for (int column = -10; column <= 10; ++column) {
      const geometry::HeadAngles angles{0.11 * column, 0.11 * row};
      const geometry::Pose cam_from_torso_true = geometry::cam_from_torso(truth.head, angles);
      const auto pixel = geometry::project(truth.camera, cam_from_torso_true * point);
      if (!limits.contains(angles) || !pixel || !truth.camera.contains(*pixel, border_px)) continue;
      const auto noise = [&](double sigma) { return sigma > 0.0 ? sigma * random.normal() : 0.0; };
      Glance glance{angles, *pixel, (cam_from_torso_true * point).norm()};
      glance.measured.yaw_rad += noise(encoder_sigma_rad);
      glance.measured.pitch_rad += noise(encoder_sigma_rad);
      glance.pixel += geometry::Pixel(noise(pixel_sigma_px), noise(pixel_sigma_px));
      glances.push_back(glance);
    }
  }
  return glances;
}

double swing_m(const std::vector<Eigen::Vector3d>& points) {
  double greatest = 0.0;
  for (const Eigen::Vector3d& a : points) {
    for (const Eigen::Vector3d& b : points) greatest = std::max(greatest, (a - b).norm());
  }
  return greatest;
}

std::vector<Eigen::Vector3d> points_by_direction(const Robot& believed,
                                                 const std::vector<Glance>& glances) {
  std::vector<Eigen::Vector3d> points;
  for (const Glance& glance : glances) {
    const TorsoRay ray = ray_of(believed, glance);
    points.emplace_back(ray.start + glance.true_range_m * ray.direction);
  }
  return points;
}

std::vector<Eigen::Vector3d> points_by_two_looks(const Robot& believed,
                                                 const std::vector<Glance>& glances) {
  constexpr double least_rad = 0.1, greatest_rad = 0.2;
  const auto is_step = [](double turn) {
    return std::abs(turn) >= least_rad && std::abs(turn) <= greatest_rad;
  };
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < glances.size(); ++i) {
    for (std::size_t j = i + 1; j < glances.size(); ++j) {
      const geometry::HeadAngles turn = glances[j].measured - glances[i].measured;
      if (!is_step(turn.yaw_rad) || !is_step(turn.pitch_rad)) continue;
      points.push_back(meeting_point(ray_of(believed, glances[i]), ray_of(believed, glances[j])));
    }
  }
  return points;
}

}  // namespace gazed::lab::calibration
