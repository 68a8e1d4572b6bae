// Where a look sees a point that is given by its ray and inverse depth in look 1, with the
// derivatives by everything that may be slightly off: the point, the look's pose relative to look
// 1, the head's turn during readout, and the camera.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::triangulation::all_looks {

/// The columns of PointInLook::by_robot.
enum RobotColumn : int {
  column_pose = 0,   // six: a turn about the camera's axes, rad, then a shift along them, m
  column_sweep = 6,  // two: the turn from the first row to the last, yaw and pitch, rad
  look_columns = 8,
  column_camera = 8,
  column_focal = 8,        // both axes together, px
  column_centre = 9,       // two, px
  column_distortion = 11,  // two: k1, k2
  robot_columns = 13
};
inline constexpr int pose_columns = 6, camera_columns = robot_columns - column_camera;

/// A point's pixel in a look and its derivatives, px.
struct PointInLook {
  geometry::Pixel pixel;
  Eigen::Matrix<double, 2, 3> by_point;  // direction, inverse depth
  Eigen::Matrix<double, 2, robot_columns> by_robot;
};

/// How the camera is mounted in the head.
struct CameraMount {
  explicit CameraMount(const geometry::HeadGeometry& head);

  Eigen::Matrix3d cam_from_head;
  Eigen::Vector3d arm_m;  // mount offset, camera axes
};

/// How far the head has turned.
struct HeadTurn {
  explicit HeadTurn(geometry::HeadAngles joint);

  Eigen::Matrix3d torso_from_head;
};

/// How the torso has moved since look 1: a rotation vector about the neck, and a shift; both in
/// look 1's torso axes.
struct TorsoMotion {
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

/// What can move a look relative to look 1, as columns of its pose change: see PoseChanges.
inline constexpr int change_count = 16;
enum Change : int {
  change_reading = 0,    // two: this look's yaw and pitch, rad
  change_reading_1 = 2,  // two: look 1's
  change_offset = 4,     // three: mount offset along the camera's axes, m
  change_rotation = 7,   // three: mount rotation about the camera's axes, rad
  change_torso = 10,     // six: TorsoMotion
};
using PoseChanges = Eigen::Matrix<double, pose_columns, change_count>;

/// How the head turned between the exposure of the target's row and that of another row: about the
/// neck, to first order, as the scene's turn in camera axes. For 2 mrad the error is 2e-3 px.
struct RowTurn {
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d arm_m = Eigen::Vector3d::Zero();  // from the neck to the camera, camera axes
};

/// One look relative to look 1, for true joint angles: no zero is added.
class LookGeometry {
 public:
  LookGeometry() = default;
  LookGeometry(const CameraMount& mount, const HeadTurn& turn_1, const HeadTurn& turn,
               const TorsoMotion& torso);

  /// Returns false, with `out` undefined, for a point that is not clearly in front of the look
  /// (0.05 times its depth in look 1), or where the lens polynomial folds back. The sweep's columns
  /// hold the derivative by the turn about `axes`.
  [[nodiscard]] bool see(const geometry::CameraModel& camera,
                         const geometry::InverseDepthPoint& point, const RowTurn& row,
                         const Eigen::Matrix<double, 3, 2>& axes, PointInLook& out) const;
  /// The axes, yaw and pitch, about which the scene turns when the joints do; in camera axes.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> joint_axes() const;

  [[nodiscard]] geometry::Pose cam_from_cam1() const { return {rotation_, translation_m_}; }
  /// Derivatives of the baseline (camera axes, metres) by the pose columns, column_pose.
  [[nodiscard]] Eigen::Matrix<double, 3, pose_columns> baseline_by_pose() const;
  [[nodiscard]] PoseChanges pose_changes(const CameraMount& mount, const HeadTurn& turn_1,
                                         const HeadTurn& turn, const TorsoMotion& torso) const;

 private:
  Eigen::Matrix3d rotation_;  // cam_from_cam1, together with translation_m_
  Eigen::Vector3d translation_m_;
  Eigen::Vector3d arm_m_;                  // mount offset, camera axes
  Eigen::Vector3d yaw_axis_, pitch_axis_;  // of the joints, camera axes
};

/// Look 1's own view: only the point's ray and the camera matter. Returns false where the lens
/// polynomial folds back.
[[nodiscard]] bool see_in_look_1(const geometry::CameraModel& camera,
                                 const geometry::InverseDepthPoint& point, PointInLook& out);

}  // namespace gazed::triangulation::all_looks
