// Where one look sees a point that is given by its ray and inverse depth in look 1, and how that
// follows everything that may be a little different: the point, both looks' joint angles, the
// camera, and how it is mounted.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::triangulation::all_looks {

/// The columns of PointInLook::by_head. HeadYaw of look 1 needs none: only the difference of the
/// two yaws moves anything, so its column is this look's, negative.
enum HeadColumn : int {
  column_yaw = 0,      // this look's
  column_pitch = 1,    // this look's
  column_pitch_1 = 2,  // look 1's
  column_sweep = 3,    // two: this look's turn from its first row to its last, yaw and pitch
  column_calibration = 5,
  column_focal = 5,       // both axes together, px
  column_centre = 6,      // two, px
  column_distortion = 8,  // two: k1, k2
  column_offset = 10,     // three: mount offset along the camera's axes, m
  column_rotation = 13,   // three: mount rotation about the camera's axes, rad
  head_columns = 16
};

/// A point's pixel in a look, with its derivatives, px.
struct PointInLook {
  geometry::Pixel pixel;
  Eigen::Matrix<double, 2, 3> by_point;  // direction, inverse depth
  Eigen::Matrix<double, 2, head_columns> by_head;
};

/// The baseline of two looks and its derivatives, in this look's camera axes, metres.
struct Baseline {
  Eigen::Vector3d translation_m;
  Eigen::Matrix<double, 3, head_columns> by_head;
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

/// A later look, beside look 1. The joints stand at true angles: no zero is added.
class LookGeometry {
 public:
  LookGeometry() = default;
  LookGeometry(const CameraMount& mount, const HeadTurn& turn_1, const HeadTurn& turn);

  /// The same look with the joints a little farther on, to first order: 2 mrad leave 2e-3 px.
  [[nodiscard]] LookGeometry turned_by(geometry::HeadAngles angles) const;

  /// False, and nothing of `out` means anything, for a point that is not clearly in front of the
  /// look (0.05 in multiples of its depth in look 1), or where the lens polynomial folds back.
  [[nodiscard]] bool see(const geometry::CameraModel& camera,
                         const geometry::InverseDepthPoint& point, PointInLook& out) const;
  [[nodiscard]] geometry::Pose cam_from_cam1() const { return {rotation_, translation_m_}; }
  [[nodiscard]] Baseline baseline() const;

 private:
  Eigen::Matrix3d rotation_;  // cam_from_cam1, with translation_m_
  Eigen::Vector3d translation_m_;
  Eigen::Vector3d arm_m_;  // mount offset, camera axes
  // Axes about which the joints turn the scene, camera axes.
  Eigen::Vector3d yaw_axis_, pitch_axis_, pitch_1_axis_;
};

/// Look 1's own view: the point's ray and the camera are all that matters. False beyond the lens
/// polynomial's fold.
[[nodiscard]] bool see_in_look_1(const geometry::CameraModel& camera,
                                 const geometry::InverseDepthPoint& point, PointInLook& out);

}  // namespace gazed::triangulation::all_looks
