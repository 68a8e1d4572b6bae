#include "agent/triangulation/all_looks/problem.hpp"

#include <optional>

#include "agent/geometry/chain.hpp"

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

// Places among the calibration's unknowns.
constexpr int focal_at = 0, centre_at = 1, distortion_at = 3, offset_at = 5, rotation_at = 8,
              zero_at = 11;

geometry::HeadAngles angles(const Eigen::Vector2d& yaw_pitch) {
  return {yaw_pitch.x(), yaw_pitch.y()};
}

/// The calibration of a state.
geometry::Rig believed_rig(const Problem& problem, const Vector& robot) {
  geometry::Rig rig = problem.rig;
  auto& [camera, head, sigmas] = rig;
  const int at = unknowns_of(problem.looks);
  camera.focal_px.array() += sigmas.focal_sigma_px * robot(at + focal_at);
  camera.centre_px += sigmas.centre_sigma_px * robot.segment<2>(at + centre_at);
  for (std::size_t i = 0; i < 2; ++i) {
    camera.distortion[i] +=
        sigmas.distortion_sigma[i] * robot(at + distortion_at + static_cast<int>(i));
  }
  head.mount_offset_m += sigmas.mount_offset_sigma_m * robot.segment<3>(at + offset_at);
  head.mount_rotation_rad += sigmas.mount_rotation_sigma_rad * robot.segment<3>(at + rotation_at);
  head.zero = head.zero + angles(sigmas.zero_sigma_rad * robot.segment<2>(at + zero_at));
  return rig;
}

}  // namespace

std::size_t Problem::features_kept() const {
  std::size_t out = 0;
  for (std::size_t i = 0; i < feature_count; ++i) out += features[i].kept != 0 ? 1 : 0;
  return out;
}

Robot::Robot(const Problem& problem, const Vector& robot)
    : rig_(believed_rig(problem, robot)),
      mount_(rig_.head),
      count_(problem.looks),
      torso_sigma_(problem.torso),
      sweep_arm_m_(problem.sweep_arm_m) {
  const auto& [camera, head, sigmas] = rig_;
  std::optional<HeadTurn> turn_1;
  for (std::size_t k = 0; k < count_; ++k) {
    const int own = unknowns_of(k);
    readings_[k] = problem.measured[k] + angles(sigmas.encoder_sigma_rad * robot.segment<2>(own));
    const double sweep_sigma_rad = problem.sweep_sigma_rad[k];
    const Eigen::Vector2d measured_rad(problem.sweep[k].yaw_rad, problem.sweep[k].pitch_rad);
    sweeps_[k] = {measured_rad + sweep_sigma_rad * robot.segment<2>(own + sweep_at),
                  sweep_sigma_rad, problem.row_px[k], problem.sweep_axes[k]};
    if (k > 0) {
      torsos_[k] = {torso_sigma_.rotation_rad * robot.segment<3>(own + torso_at),
                    torso_sigma_.translation_m * robot.segment<3>(own + torso_at + 3)};
    }
    const HeadTurn turn(readings_[k] + head.zero);
    if (k == 0) turn_1 = turn;
    looks_[k] = LookGeometry(mount_, *turn_1, turn, torsos_[k]);
    if (k > 0) changes_[k] = looks_[k].pose_changes(mount_, *turn_1, turn, torsos_[k]);
  }
  const Matrix3d yaw = geometry::about_z(head.mount_rotation_rad.z());
  const Matrix3d yaw_pitch = yaw * geometry::about_y(head.mount_rotation_rad.y());
  Matrix3d axes;  // about which roll, pitch and yaw of the mount turn the camera
  axes << yaw_pitch.col(0), yaw.col(1), Vector3d::UnitZ();
  offset_from_unknowns_ = sigmas.mount_offset_sigma_m * mount_.cam_from_head;
  rotation_from_unknowns_ = sigmas.mount_rotation_sigma_rad * mount_.cam_from_head * axes;
}

bool Robot::see_at_target_row(std::size_t k, const geometry::InverseDepthPoint& point,
                              PointInLook& out) const {
  return k == 0 ? see_in_look_1(rig_.camera, point, out)
                : looks_[k].see(rig_.camera, point, {}, Eigen::Matrix<double, 3, 2>::Zero(), out);
}

bool Robot::see(std::size_t k, const geometry::InverseDepthPoint& point, double row_px,
                PointInLook& out) const {
  const RowSweep& look = sweeps_[k];
  if (!(look.sigma_rad > 0.0) && look.sweep_rad.isZero(0.0)) {
    return see_at_target_row(k, point, out);
  }
  const double share = (row_px - look.row_px) / (rig_.camera.height_px - 1);
  const RowTurn row{share * (look.axes * look.sweep_rad), sweep_arm_m_};
  return looks_[k].see(rig_.camera, point, row, share * look.axes, out);
}

geometry::Pose Robot::torso_1_from_torso(std::size_t k) const {
  const Matrix3d rotation = geometry::rotation_by(torsos_[k].rotation_rad);
  const Vector3d& neck_m = rig_.head.neck_offset_m;
  return {rotation, neck_m + rotation * (torsos_[k].translation_m - neck_m)};
}

void Robot::add_raw(std::size_t k, const Eigen::Matrix<double, 1, robot_columns>& by_robot,
                    Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) const {
  row.segment<look_columns>(look_columns * static_cast<int>(k)) += by_robot.head<look_columns>();
  row.segment<camera_columns>(raw_camera_at()) += by_robot.tail<camera_columns>();
}

/// Adds what moves a later look's pose. `by_changes` has the columns of Change, `out` those of the
/// unknowns.
void Robot::add_changes(std::size_t k, const Eigen::Ref<const Eigen::MatrixXd>& by_changes,
                        Eigen::Ref<Eigen::MatrixXd> out) const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const int own = unknowns_of(k), calibration = unknowns_of(count_);
  const auto readings = by_changes.middleCols<2>(change_reading);
  const auto readings_1 = by_changes.middleCols<2>(change_reading_1);
  out.middleCols<2>(own) += sigmas.encoder_sigma_rad * readings;
  out.leftCols<2>() += sigmas.encoder_sigma_rad * readings_1;
  out.middleCols<2>(calibration + zero_at) += sigmas.zero_sigma_rad * (readings + readings_1);
  out.middleCols<3>(calibration + offset_at) +=
      by_changes.middleCols<3>(change_offset).lazyProduct(offset_from_unknowns_);
  out.middleCols<3>(calibration + rotation_at) +=
      by_changes.middleCols<3>(change_rotation).lazyProduct(rotation_from_unknowns_);
  out.middleCols<3>(own + torso_at) +=
      torso_sigma_.rotation_rad * by_changes.middleCols<3>(change_torso);
  out.middleCols<3>(own + torso_at + 3) +=
      torso_sigma_.translation_m * by_changes.middleCols<3>(change_torso + 3);
}

Matrix Robot::by_unknowns(const Matrix& raw) const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const int calibration = unknowns_of(count_), camera = raw_camera_at() - column_camera;
  Matrix out = Matrix::Zero(raw.rows(), calibration + calibration_count + 3);
  Eigen::Matrix<double, Eigen::Dynamic, change_count, 0, unknowns_max, change_count> by_changes;
  for (std::size_t k = 0; k < count_; ++k) {
    const int from = look_columns * static_cast<int>(k);
    out.middleCols<2>(unknowns_of(k) + sweep_at) =
        sweeps_[k].sigma_rad * raw.middleCols<2>(from + column_sweep);
    if (k == 0) continue;
    by_changes = raw.middleCols<pose_columns>(from + column_pose).lazyProduct(changes_[k]);
    add_changes(k, by_changes, out);
  }
  out.col(calibration + focal_at) = sigmas.focal_sigma_px * raw.col(camera + column_focal);
  out.middleCols<2>(calibration + centre_at) =
      sigmas.centre_sigma_px * raw.middleCols<2>(camera + column_centre);
  for (int i = 0; i < 2; ++i) {
    out.col(calibration + distortion_at + i) =
        sigmas.distortion_sigma[static_cast<std::size_t>(i)] *
        raw.col(camera + column_distortion + i);
  }
  out.rightCols<3>() = raw.rightCols<3>();
  return out;
}

Matrix Robot::raw_from_unknowns() const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const int calibration = unknowns_of(count_), camera = raw_camera_at() - column_camera;
  Matrix out = Matrix::Zero(raw_columns() + 3, calibration + calibration_count + 3);
  for (std::size_t k = 0; k < count_; ++k) {
    const int at = look_columns * static_cast<int>(k);
    out.block<2, 2>(at + column_sweep, unknowns_of(k) + sweep_at)
        .diagonal()
        .setConstant(sweeps_[k].sigma_rad);
    if (k > 0) add_changes(k, changes_[k], out.middleRows<pose_columns>(at + column_pose));
  }
  out(camera + column_focal, calibration + focal_at) = sigmas.focal_sigma_px;
  out.block<2, 2>(camera + column_centre, calibration + centre_at)
      .diagonal()
      .setConstant(sigmas.centre_sigma_px);
  for (int i = 0; i < 2; ++i) {
    out(camera + column_distortion + i, calibration + distortion_at + i) =
        sigmas.distortion_sigma[static_cast<std::size_t>(i)];
  }
  out.bottomRightCorner<3, 3>().setIdentity();
  return out;
}

Matrix Robot::by_unknowns_of_look_1(const Eigen::Matrix<double, 3, change_torso>& by_changes,
                                    const Eigen::Matrix3d& by_target) const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const int calibration = unknowns_of(count_);
  Matrix out = Matrix::Zero(3, calibration + calibration_count + 3);
  const auto readings = by_changes.middleCols<2>(change_reading);
  out.leftCols<2>() = sigmas.encoder_sigma_rad * readings;
  out.middleCols<2>(calibration + zero_at) = sigmas.zero_sigma_rad * readings;
  out.middleCols<3>(calibration + offset_at) =
      by_changes.middleCols<3>(change_offset).lazyProduct(offset_from_unknowns_);
  out.middleCols<3>(calibration + rotation_at) =
      by_changes.middleCols<3>(change_rotation).lazyProduct(rotation_from_unknowns_);
  out.rightCols<3>() = by_target;
  return out;
}

void anchor_sweeps(const Vector& robot, Problem& problem) {
  const Robot now(problem, robot);
  problem.sweep_arm_m = now.mount().arm_m;
  for (std::size_t k = 0; k < problem.looks; ++k) problem.sweep_axes[k] = now.look(k).joint_axes();
}

BelievedRobot Robot::believed(const Matrix& covariance) const {
  const Vector shares =
      covariance.diagonal().cwiseSqrt().segment<calibration_count>(unknowns_of(count_));
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
