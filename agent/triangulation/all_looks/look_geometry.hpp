// Where one look sees a point that is given by its ray and inverse depth in look 1, and how that
// follows everything that may be a little different: the point, the look's pose against look 1, how
// far the head turned while the frame was read out, and the camera.
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

/// A point's pixel in a look, with its derivatives, px.
struct PointInLook {
  geometry::Pixel pixel;
  Eigen::Matrix<double, 2, 3> by_point;  // direction, inverse depth
  Eigen::Matrix<double, 2, robot_columns> by_robot;
};

/// How the camera stands in the head.
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

/// How the torso has moved since look 1: turned about the neck, as a rotation vector, and shifted;
/// both in look 1's torso axes.
struct TorsoMotion {
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

/// What moves a look against look 1, as columns of its pose change: see PoseChanges.
inline constexpr int change_count = 16;
enum Change : int {
  change_reading = 0,    // two: this look's yaw and pitch, rad
  change_reading_1 = 2,  // two: look 1's
  change_offset = 4,     // three: mount offset along the camera's axes, m
  change_rotation = 7,   // three: mount rotation about the camera's axes, rad
  change_torso = 10,     // six: TorsoMotion
};
using PoseChanges = Eigen::Matrix<double, pose_columns, change_count>;

/// How the head turned between the exposure of the target's row and that of another: about the
/// neck, to first order, as the scene turns in camera axes. 2 mrad leave 2e-3 px.
struct RowTurn {
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d arm_m = Eigen::Vector3d::Zero();  // from the neck to the camera, camera axes
};

/// One look, beside look 1. The joints stand at true angles: no zero is added.
class LookGeometry {
 public:
  LookGeometry() = default;
  LookGeometry(const CameraMount& mount, const HeadTurn& turn_1, const HeadTurn& turn,
               const TorsoMotion& torso);

  /// False, and nothing of `out` means anything, for a point that is not clearly in front of the
  /// look (0.05 in multiples of its depth in look 1), or where the lens polynomial folds back. The
  /// columns of the sweep hold the derivative by the turn about `axes`.
  [[nodiscard]] bool see(const geometry::CameraModel& camera,
                         const geometry::InverseDepthPoint& point, const RowTurn& row,
                         const Eigen::Matrix<double, 3, 2>& axes, PointInLook& out) const;
  /// About which the scene turns when the joints do, camera axes: yaw, pitch.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> joint_axes() const;

  [[nodiscard]] geometry::Pose cam_from_cam1() const { return {rotation_, translation_m_}; }
  /// By the parts of the pose, the columns of column_pose: of the baseline, camera axes, metres.
  [[nodiscard]] Eigen::Matrix<double, 3, pose_columns> baseline_by_pose() const;
  [[nodiscard]] PoseChanges pose_changes(const CameraMount& mount, const HeadTurn& turn_1,
                                         const HeadTurn& turn, const TorsoMotion& torso) const;

 private:
  Eigen::Matrix3d rotation_;  // cam_from_cam1, with translation_m_
  Eigen::Vector3d translation_m_;
  Eigen::Vector3d arm_m_;                  // mount offset, camera axes
  Eigen::Vector3d yaw_axis_, pitch_axis_;  // of the joints, camera axes
};

/// Look 1's own view: the point's ray and the camera are all that matters. False beyond the lens
/// polynomial's fold.
[[nodiscard]] bool see_in_look_1(const geometry::CameraModel& camera,
                                 const geometry::InverseDepthPoint& point, PointInLook& out);

}  // namespace gazed::triangulation::all_looks
