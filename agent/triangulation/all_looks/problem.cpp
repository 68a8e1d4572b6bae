#include "agent/triangulation/all_looks/problem.hpp"

#include <optional>

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

// Places among the calibration's unknowns.
constexpr int focal_at = 0, centre_at = 1, offset_at = 3, rotation_at = 6, zero_at = 9;

geometry::HeadAngles angles(const Eigen::Vector2d& yaw_pitch) {
  return {yaw_pitch.x(), yaw_pitch.y()};
}

}  // namespace

std::size_t Problem::features_kept() const {
  std::size_t out = 0;
  for (std::size_t i = 0; i < feature_count; ++i) out += features[i].kept != 0 ? 1 : 0;
  return out;
}

Robot::Robot(const Problem& problem, const Vector& robot)
    : head_(problem.head),
      camera_(problem.camera),
      count_(problem.looks),
      sigmas_(problem.uncertainty) {
  const int at = 2 * static_cast<int>(count_);
  camera_.focal_px.array() += sigmas_.focal_sigma_px * robot(at + focal_at);
  camera_.centre_px += sigmas_.centre_sigma_px * robot.segment<2>(at + centre_at);
  head_.mount_offset_m += sigmas_.mount_offset_sigma_m * robot.segment<3>(at + offset_at);
  head_.mount_rotation_rad += sigmas_.mount_rotation_sigma_rad * robot.segment<3>(at + rotation_at);
  head_.zero = head_.zero + angles(sigmas_.zero_sigma_rad * robot.segment<2>(at + zero_at));
  const CameraMount mount(head_);
  std::optional<HeadTurn> turn_1;
  for (std::size_t k = 0; k < count_; ++k) {
    const auto own = 2 * static_cast<Eigen::Index>(k);
    readings_[k] = problem.measured[k] + angles(sigmas_.encoder_sigma_rad * robot.segment<2>(own));
    const HeadTurn turn(readings_[k] + head_.zero);
    if (k == 0) {
      turn_1 = turn;
    } else {
      looks_[k] = LookGeometry(mount, *turn_1, turn);
    }
  }
  const Matrix3d yaw = geometry::rotation_z(head_.mount_rotation_rad.z());
  const Matrix3d yaw_pitch = yaw * geometry::rotation_y(head_.mount_rotation_rad.y());
  Matrix3d axes;  // about which roll, pitch and yaw of the mount turn the camera
  axes << yaw_pitch.col(0), yaw.col(1), Vector3d::UnitZ();
  offset_from_unknowns_ = sigmas_.mount_offset_sigma_m * mount.cam_from_head;
  rotation_from_unknowns_ = sigmas_.mount_rotation_sigma_rad * mount.cam_from_head * axes;
}

void Robot::add_raw(std::size_t k, const Eigen::Matrix<double, 1, head_columns>& by_head,
                    Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) const {
  const int own = 2 * static_cast<int>(k);
  row(own) += by_head(column_yaw);
  row(own + 1) += by_head(column_pitch);
  row(0) -= by_head(column_yaw);
  row(1) += by_head(column_pitch_1);
  row.segment<raw_calibration>(raw_calibration_at()) +=
      by_head.segment<raw_calibration>(column_calibration);
}

Matrix Robot::by_unknowns(const Matrix& raw) const {
  const int angles = raw_calibration_at(), from = angles, to = angles;
  Matrix out(raw.rows(), angles + calibration_count + 3);
  out.leftCols(angles) = sigmas_.encoder_sigma_rad * raw.leftCols(angles);
  out.col(to + focal_at) = sigmas_.focal_sigma_px * raw.col(from + focal_at);
  out.middleCols<2>(to + centre_at) = sigmas_.centre_sigma_px * raw.middleCols<2>(from + centre_at);
  out.middleCols<3>(to + offset_at) =
      raw.middleCols<3>(from + offset_at).lazyProduct(offset_from_unknowns_);
  out.middleCols<3>(to + rotation_at) =
      raw.middleCols<3>(from + rotation_at).lazyProduct(rotation_from_unknowns_);
  out.middleCols<2>(to + zero_at).setZero();
  for (int k = 0; k < angles; k += 2) {
    out.middleCols<2>(to + zero_at) += sigmas_.zero_sigma_rad * raw.middleCols<2>(k);
  }
  out.rightCols<3>() = raw.rightCols<3>();
  return out;
}

}  // namespace gazed::triangulation::all_looks
