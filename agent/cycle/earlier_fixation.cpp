#include "agent/cycle/earlier_fixation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"
#include "agent/triangulation/chi_square.hpp"

namespace gazed::cycle {

namespace {

// From the last view of one fixation to the first of the next, which takes two frames. Later the
// robot may stand somewhere else.
constexpr double moment_s = 2.0;

/// A point as seen from a place: two angles off an axis, and its inverse range.
struct Seen {
  Eigen::Vector3d place;
  Eigen::Matrix3d by_point;
};

Seen seen_from(const Eigen::Vector3d& centre_m, const Eigen::Matrix<double, 2, 3>& across,
               const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d way_m = point_m - centre_m;
  const double range_m = way_m.norm();
  const Eigen::Vector3d direction = way_m / range_m;
  Seen out;
  out.place << across * direction, 1.0 / range_m;
  out.by_point.topRows<2>() =
      across * (Eigen::Matrix3d::Identity() - direction * direction.transpose()) / range_m;
  out.by_point.row(2) = -direction.transpose() / (range_m * range_m);
  return out;
}

/// The two directions perpendicular to a third one.
Eigen::Matrix<double, 2, 3> across(const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 2, 3> out;
  out.row(0) = direction.unitOrthogonal().transpose();
  out.row(1) = direction.cross(Eigen::Vector3d(out.row(0))).transpose();
  return out;
}

/// For a point that rotates about the torso's origin and is shifted.
Eigen::Matrix3d covariance_of_motion(const geometry::Uncertainty& sigmas,
                                     const Eigen::Vector3d& point_m) {
  const double rotation_2 = std::pow(sigmas.torso_rotation_sigma_rad, 2);
  const double translation_2 = std::pow(sigmas.torso_translation_sigma_m, 2);
  const Eigen::Matrix3d turned =
      point_m.squaredNorm() * Eigen::Matrix3d::Identity() - point_m * point_m.transpose();
  return rotation_2 * turned + translation_2 * Eigen::Matrix3d::Identity();
}

}  // namespace

std::optional<EarlierFixation::Point> EarlierFixation::point_of(const Fixation& fixation) {
  const triangulation::PointEstimate& estimate = fixation.estimate;
  if (!estimate.torso_point_m.allFinite() || !estimate.torso_covariance_m2.allFinite() ||
      fixation.outline.count == 0) {
    return std::nullopt;
  }
  double radius_px = 0.0;
  for (const Eigen::Vector2f& point :
       std::span(fixation.outline.points_px).first(fixation.outline.count)) {
    radius_px = std::max(radius_px, (point.cast<double>() - fixation.pixel_1).norm());
  }
  return Point{fixation.number, fixation.utime_us, estimate.torso_point_m,
               estimate.torso_covariance_m2, radius_px / fixation.robot.camera.focal_px.minCoeff()};
}

void EarlierFixation::hold_against(Fixation& fixation) {
  const std::optional<Point> now = point_of(fixation), before = earlier_;
  earlier_ = now;
  if (!now || !before || fixation.status != Status::located) return;
  const FixationLook& first = fixation.looks.front();
  const double since_s = base::seconds_between(before->utime_us, first.utime_us);
  // A negative time means that the clock was set back.
  if (since_s < 0.0 || since_s > moment_s || !geometry::finite(first.refined)) return;

  const Eigen::Vector3d centre_m =
      geometry::cam_from_torso(fixation.robot.head, first.refined).inverse().translation;
  const Eigen::Matrix<double, 2, 3> sideways = across((now->torso_m - centre_m).normalized());
  const Seen seen = seen_from(centre_m, sideways, now->torso_m),
             earlier = seen_from(centre_m, sideways, before->torso_m);
  const Eigen::Vector3d differ = seen.place - earlier.place;
  const double angle_rad = differ.head<2>().norm();
  if (angle_rad > before->radius_rad) return;
  const Eigen::Matrix3d moved = covariance_of_motion(uncertainty_, before->torso_m);
  const Eigen::Matrix3d covariance =
      seen.by_point * now->covariance_m2 * seen.by_point.transpose() +
      earlier.by_point * (before->covariance_m2 + moved) * earlier.by_point.transpose();
  const double chi2 = differ.dot(covariance.inverse() * differ);
  if (chi2 <= triangulation::chi2_999_of(3)) return;
  fixation.status = Status::uncertain;
  fixation.reason += base::text(
      "; fixation %d, %.1f s before, contradicts it: inverse range %.3f 1/m, not %.3f, %.1f sigmas "
      "apart, and %.1f mrad in direction, chi-square %.1f",
      before->number, since_s, earlier.place.z(), seen.place.z(),
      std::abs(differ.z()) / std::sqrt(covariance(2, 2)), 1e3 * angle_rad, chi2);
}

}  // namespace gazed::cycle
