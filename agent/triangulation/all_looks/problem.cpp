#include "agent/triangulation/all_looks/problem.hpp"

#include <optional>

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

// Places among the calibration's unknowns.
constexpr int focal_at = 0, centre_at = 1, distortion_at = 3, offset_at = 5, rotation_at = 8,
              zero_at = 11;

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
    : rig_(problem.rig), count_(problem.looks) {
  auto& [camera, head, sigmas] = rig_;
  const int at = look_unknowns * static_cast<int>(count_);
  camera.focal_px.array() += sigmas.focal_sigma_px * robot(at + focal_at);
  camera.centre_px += sigmas.centre_sigma_px * robot.segment<2>(at + centre_at);
  for (std::size_t i = 0; i < 2; ++i) {
    camera.distortion[i] +=
        sigmas.distortion_sigma[i] * robot(at + distortion_at + static_cast<int>(i));
  }
  head.mount_offset_m += sigmas.mount_offset_sigma_m * robot.segment<3>(at + offset_at);
  head.mount_rotation_rad += sigmas.mount_rotation_sigma_rad * robot.segment<3>(at + rotation_at);
  head.zero = head.zero + angles(sigmas.zero_sigma_rad * robot.segment<2>(at + zero_at));
  const CameraMount mount(head);
  std::optional<HeadTurn> turn_1;
  for (std::size_t k = 0; k < count_; ++k) {
    const auto own = look_unknowns * static_cast<Eigen::Index>(k);
    readings_[k] = problem.measured[k] + angles(sigmas.encoder_sigma_rad * robot.segment<2>(own));
    const double sweep_sigma_rad = problem.sweep_sigma_rad[k];
    sweeps_[k] = {problem.sweep[k] + angles(sweep_sigma_rad * robot.segment<2>(own + sweep_at)),
                  sweep_sigma_rad, problem.row_px[k]};
    const HeadTurn turn(readings_[k] + head.zero);
    if (k == 0) turn_1 = turn;
    looks_[k] = LookGeometry(mount, *turn_1, turn);
  }
  const Matrix3d yaw = geometry::rotation_z(head.mount_rotation_rad.z());
  const Matrix3d yaw_pitch = yaw * geometry::rotation_y(head.mount_rotation_rad.y());
  Matrix3d axes;  // about which roll, pitch and yaw of the mount turn the camera
  axes << yaw_pitch.col(0), yaw.col(1), Vector3d::UnitZ();
  offset_from_unknowns_ = sigmas.mount_offset_sigma_m * mount.cam_from_head;
  rotation_from_unknowns_ = sigmas.mount_rotation_sigma_rad * mount.cam_from_head * axes;
}

bool Robot::see_at_target_row(std::size_t k, const geometry::InverseDepthPoint& point,
                              PointInLook& out) const {
  return k == 0 ? see_in_look_1(rig_.camera, point, out) : looks_[k].see(rig_.camera, point, out);
}

bool Robot::see(std::size_t k, const geometry::InverseDepthPoint& point, double row_px,
                PointInLook& out) const {
  const RowSweep& look = sweeps_[k];
  if (!look.moves()) return see_at_target_row(k, point, out);
  const double share = (row_px - look.row_px) / (rig_.camera.height_px - 1);
  const geometry::HeadAngles since{share * look.sweep.yaw_rad, share * look.sweep.pitch_rad};
  if (!looks_[k].turned_by(since).see(rig_.camera, point, out)) return false;
  out.by_head.middleCols<2>(column_sweep) = share * out.by_head.leftCols<2>();
  return true;
}

void Robot::add_raw(std::size_t k, const Eigen::Matrix<double, 1, head_columns>& by_head,
                    Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) const {
  const int own = look_unknowns * static_cast<int>(k);
  row(own) += by_head(column_yaw);
  row(own + 1) += by_head(column_pitch);
  row.segment<2>(own + sweep_at) += by_head.segment<2>(column_sweep);
  row(0) -= by_head(column_yaw);
  row(1) += by_head(column_pitch_1);
  row.segment<raw_calibration>(raw_calibration_at()) +=
      by_head.segment<raw_calibration>(column_calibration);
}

Matrix Robot::by_unknowns(const Matrix& raw) const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const int angles = raw_calibration_at(), from = angles, to = angles;
  Matrix out(raw.rows(), angles + calibration_count + 3);
  out.col(to + focal_at) = sigmas.focal_sigma_px * raw.col(from + focal_at);
  out.middleCols<2>(to + centre_at) = sigmas.centre_sigma_px * raw.middleCols<2>(from + centre_at);
  for (int i = 0; i < 2; ++i) {
    out.col(to + distortion_at + i) =
        sigmas.distortion_sigma[static_cast<std::size_t>(i)] * raw.col(from + distortion_at + i);
  }
  out.middleCols<3>(to + offset_at) =
      raw.middleCols<3>(from + offset_at).lazyProduct(offset_from_unknowns_);
  out.middleCols<3>(to + rotation_at) =
      raw.middleCols<3>(from + rotation_at).lazyProduct(rotation_from_unknowns_);
  out.middleCols<2>(to + zero_at).setZero();
  for (std::size_t k = 0; k < count_; ++k) {
    const int own = look_unknowns * static_cast<int>(k);
    out.middleCols<2>(own) = sigmas.encoder_sigma_rad * raw.middleCols<2>(own);
    out.middleCols<2>(own + sweep_at) = sweeps_[k].sigma_rad * raw.middleCols<2>(own + sweep_at);
    out.middleCols<2>(to + zero_at) += sigmas.zero_sigma_rad * raw.middleCols<2>(own);
  }
  out.rightCols<3>() = raw.rightCols<3>();
  return out;
}

BelievedRobot Robot::believed(const Matrix& covariance) const {
  const Vector shares =
      covariance.diagonal().cwiseSqrt().segment<calibration_count>(raw_calibration_at());
  BelievedRobot out = believed_before(rig_);
  out.focal_sigma_px *= shares(focal_at);
  out.centre_sigma_px.array() *= shares.segment<2>(centre_at).array();
  out.distortion_sigma.array() *= shares.segment<2>(distortion_at).array();
  out.mount_offset_sigma_m.array() *= shares.segment<3>(offset_at).array();
  out.mount_rotation_sigma_rad.array() *= shares.segment<3>(rotation_at).array();
  out.zero_sigma_rad.array() *= shares.segment<2>(zero_at).array();
  return out;
}

}  // namespace gazed::triangulation::all_looks
