#include "agent/gaze/planner.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gazed::gaze {

namespace {

// The target keeps this share of the image's width off the border, over whose outer twentieth the
// saliency maps ramp down (agent/saliency/README.md), and this share of a large target's square is
// inside; registration asks for 0.6 of its edges. A head arrives at worst this far off its goal,
// the 0.02 rad of Russcher 2011, chapter 5, and two sigmas more where its encoders are bad.
constexpr double border_share = 0.075;
constexpr double visible_share_min = 0.85;
constexpr double arrival_error_rad = 0.02;
constexpr double arrival_sigmas = 2.0;
// Looks are tried on a grid over the field of view, half a grid this many steps wide, then around
// the best one on a grid as many times finer.
constexpr int coarse_steps = 8;
constexpr int fine_steps = 4;
constexpr double grid_reach = 1.1;  // over half the field of view: the optical axis may be turned
// For central differences of projections, inverse metres and radians: rounding and curvature both
// stay below 1e-6 of the derivative.
constexpr double inverse_depth_step_per_m = 1e-5;
constexpr double angle_step_rad = 1e-5;
// An encoder without error would make look 1's angles known and the prior infinite, a pixel without
// error a look's information.
constexpr double encoder_sigma_min_rad = 1e-6;
constexpr double pixel_sigma_min_px = 1e-3;

using Information = Eigen::Matrix3d;  // of inverse depth, look 1's yaw and pitch

/// A look as it is and with a joint turned a little back and on: poses to or from its camera.
struct NearbyPoses {
  geometry::Pose here, yaw_back, yaw, pitch_back, pitch;
};

/// `pose_of(angles)`.
template <typename PoseOf>
NearbyPoses nearby_poses(geometry::HeadAngles look, const PoseOf& pose_of) {
  const auto turned = [&](double yaw_rad, double pitch_rad) {
    return pose_of(look + geometry::HeadAngles{yaw_rad, pitch_rad});
  };
  return {turned(0.0, 0.0), turned(-angle_step_rad, 0.0), turned(angle_step_rad, 0.0),
          turned(0.0, -angle_step_rad), turned(0.0, angle_step_rad)};
}

/// Look 1: the same for everything that is asked of other looks.
NearbyPoses torso_from_cam1(const PlannedHead& robot, geometry::HeadAngles look_1) {
  return nearby_poses(look_1, [&](geometry::HeadAngles angles) {
    return geometry::cam_from_torso(robot.rig.head, angles).inverse();
  });
}

std::optional<geometry::Pixel> seen_at(const PlannedHead& robot, const geometry::Pose& pose,
                                       const Eigen::Vector2d& direction_1,
                                       double inverse_depth_per_m) {
  return geometry::project(robot.rig.camera, pose.rotation * direction_1.homogeneous() +
                                                 inverse_depth_per_m * pose.translation);
}

std::optional<Eigen::Vector2d> slope(const std::optional<geometry::Pixel>& before,
                                     const std::optional<geometry::Pixel>& after, double step) {
  if (!before || !after) return std::nullopt;
  return (*after - *before) / (2.0 * step);
}

/// What one look tells; none where it does not see the target.
std::optional<Information> information(const PlannedHead& robot, const NearbyPoses& look_1,
                                       geometry::HeadAngles look, const PlannedTarget& target) {
  const NearbyPoses poses = nearby_poses(look, [&](geometry::HeadAngles angles) {
    return geometry::cam_from_torso(robot.rig.head, angles);
  });
  const auto seen = [&](const geometry::Pose& torso_from_1, const geometry::Pose& cam_from_torso,
                        double change_per_m) {
    return seen_at(robot, cam_from_torso * torso_from_1, target.direction_1,
                   target.inverse_depth_per_m + change_per_m);
  };
  const auto by_depth = [&](double change_per_m) {
    return seen(look_1.here, poses.here, change_per_m);
  };
  const auto by_look_1 = [&](const geometry::Pose& pose) { return seen(pose, poses.here, 0.0); };
  const auto by_look = [&](const geometry::Pose& pose) { return seen(look_1.here, pose, 0.0); };
  const std::array slopes{
      slope(by_depth(-inverse_depth_step_per_m), by_depth(inverse_depth_step_per_m),
            inverse_depth_step_per_m),
      slope(by_look_1(look_1.yaw_back), by_look_1(look_1.yaw), angle_step_rad),
      slope(by_look_1(look_1.pitch_back), by_look_1(look_1.pitch), angle_step_rad),
      slope(by_look(poses.yaw_back), by_look(poses.yaw), angle_step_rad),
      slope(by_look(poses.pitch_back), by_look(poses.pitch), angle_step_rad)};
  Eigen::Matrix<double, 2, 5> jacobian;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!slopes[i]) return std::nullopt;
    jacobian.col(static_cast<Eigen::Index>(i)) = *slopes[i];
  }
  const Eigen::Matrix2d by_own_angles = jacobian.rightCols<2>();
  const Eigen::Matrix2d noise =
      std::pow(std::max(robot.rig.uncertainty.pixel_sigma_px, pixel_sigma_min_px), 2) *
          Eigen::Matrix2d::Identity() +
      std::pow(robot.rig.uncertainty.encoder_sigma_rad, 2) * by_own_angles *
          by_own_angles.transpose();
  const Eigen::Matrix<double, 2, 3> by_state = jacobian.leftCols<3>();
  return by_state.transpose() * noise.inverse() * by_state;
}

Information prior(const PlannedHead& robot) {
  const double sigma_rad = std::max(robot.rig.uncertainty.encoder_sigma_rad, encoder_sigma_min_rad);
  return Eigen::Vector3d(0.0, 1.0, 1.0).asDiagonal().toDenseMatrix() / (sigma_rad * sigma_rad);
}

Information information(const PlannedHead& robot, const NearbyPoses& look_1,
                        std::span<const geometry::HeadAngles> later_looks,
                        const PlannedTarget& target) {
  Information sum = prior(robot);
  for (const geometry::HeadAngles look : later_looks) {
    sum += information(robot, look_1, look, target).value_or(Information::Zero());
  }
  return sum;
}

/// What is known of the inverse depth alone, m^2.
double known(const Information& information) {
  const Eigen::Vector2d shared = information.bottomLeftCorner<2, 1>();
  return information(0, 0) - shared.dot(information.bottomRightCorner<2, 2>().inverse() * shared);
}

/// The least share of a square about `pixel` that is inside the image if the head arrives badly.
double visible_share(const PlannedHead& robot, const geometry::Pixel& pixel, double half_size_px) {
  const geometry::CameraModel& camera = robot.rig.camera;
  const Eigen::Vector2d size_px(camera.width_px - 1, camera.height_px - 1);
  const double off_rad =
      std::hypot(arrival_error_rad, arrival_sigmas * robot.rig.uncertainty.encoder_sigma_rad);
  const Eigen::Vector2d to_border_px = pixel.cwiseMin(size_px - pixel) - off_rad * camera.focal_px;
  const Eigen::Vector2d inside = (to_border_px.array() + half_size_px) / (2.0 * half_size_px);
  return inside.cwiseMin(1.0).cwiseMax(0.0).prod();
}

bool sees(const PlannedHead& robot, const NearbyPoses& look_1, geometry::HeadAngles look,
          const PlannedTarget& target) {
  const geometry::Pose cam_from_cam1 = geometry::cam_from_torso(robot.rig.head, look) * look_1.here;
  const double border_px = border_share * robot.rig.camera.width_px;
  const std::array depths{target.inverse_depth_min_per_m, target.inverse_depth_per_m,
                          target.inverse_depth_max_per_m};
  return std::all_of(depths.begin(), depths.end(), [&](double inverse_depth_per_m) {
    const auto pixel = seen_at(robot, cam_from_cam1, target.direction_1, inverse_depth_per_m);
    return pixel && robot.rig.camera.contains(*pixel, border_px) &&
           visible_share(robot, *pixel, target.half_size_px) >= visible_share_min;
  });
}

bool is_a_step(geometry::HeadAngles move, double least_step_rad) {
  return std::abs(move.yaw_rad) >= least_step_rad && std::abs(move.pitch_rad) >= least_step_rad;
}

/// About the angles at which the camera looks at the target.
geometry::HeadAngles towards(const PlannedHead& robot, const NearbyPoses& look_1,
                             const PlannedTarget& target) {
  const Eigen::Vector3d way =
      look_1.here * (target.direction_1.homogeneous() / target.inverse_depth_per_m) -
      robot.rig.head.neck_offset_m;
  return {std::atan2(way.y(), way.x()), std::atan2(-way.z(), way.head<2>().norm())};
}

/// The best of the looks so far tried.
struct Best {
  geometry::HeadAngles look;
  double known = 0.0;
  bool found = false;
};

void try_grid(const PlannedHead& robot, const NearbyPoses& look_1, geometry::HeadAngles current,
              const PlannedTarget& target, const Information& so_far, geometry::HeadAngles centre,
              geometry::HeadAngles spacing, int steps, Best& best) {
  for (int i = -steps; i <= steps; ++i) {
    for (int k = -steps; k <= steps; ++k) {
      const geometry::HeadAngles look{centre.yaw_rad + i * spacing.yaw_rad,
                                      centre.pitch_rad + k * spacing.pitch_rad};
      if (!is_a_step(look - current, robot.least_step_rad) ||
          !robot.limits.contains_segment(current, look) || !sees(robot, look_1, look, target))
        continue;
      const auto added = information(robot, look_1, look, target);
      if (!added) continue;
      if (const double value = known(so_far + *added); value > best.known || !best.found) {
        best = {look, value, true};
      }
    }
  }
}

}  // namespace

std::optional<geometry::HeadAngles> most_informative_look(
    const PlannedHead& robot, std::span<const geometry::HeadAngles> looks,
    geometry::HeadAngles current, const PlannedTarget& target) {
  const NearbyPoses look_1 = torso_from_cam1(robot, looks.front());
  const Information so_far = information(robot, look_1, looks.subspan(1), target);
  const geometry::CameraModel& camera = robot.rig.camera;
  const geometry::HeadAngles spacing{
      grid_reach / coarse_steps * std::atan(camera.width_px / (2.0 * camera.focal_px.x())),
      grid_reach / coarse_steps * std::atan(camera.height_px / (2.0 * camera.focal_px.y()))};
  Best best;
  try_grid(robot, look_1, current, target, so_far, towards(robot, look_1, target), spacing,
           coarse_steps, best);
  if (!best.found) return std::nullopt;
  try_grid(robot, look_1, current, target, so_far, best.look,
           {spacing.yaw_rad / fine_steps, spacing.pitch_rad / fine_steps}, fine_steps, best);
  return best.look;
}

double planned_sigma_per_m(const PlannedHead& robot, std::span<const geometry::HeadAngles> looks,
                           const PlannedTarget& target) {
  const NearbyPoses look_1 = torso_from_cam1(robot, looks.front());
  const double value = known(information(robot, look_1, looks.subspan(1), target));
  return value > 0.0 ? 1.0 / std::sqrt(value) : std::numeric_limits<double>::infinity();
}

std::optional<geometry::HeadAngles> approach_point(const geometry::HeadLimits& limits,
                                                   geometry::HeadAngles from,
                                                   geometry::HeadAngles to,
                                                   geometry::HeadAngles side,
                                                   double overshoot_rad) {
  const auto beyond = [overshoot_rad](double move, double wanted) {
    return move * wanted < 0.0 ? std::copysign(overshoot_rad, move) : 0.0;
  };
  const geometry::HeadAngles move = to - from;
  const geometry::HeadAngles detour{beyond(move.yaw_rad, side.yaw_rad),
                                    beyond(move.pitch_rad, side.pitch_rad)};
  if (detour == geometry::HeadAngles{}) return std::nullopt;
  const geometry::HeadAngles via = to + detour;
  if (!limits.contains_segment(from, via) || !limits.contains_segment(via, to)) return std::nullopt;
  return via;
}

}  // namespace gazed::gaze
