#include "agent/triangulation/all_looks/problem.hpp"

#include <optional>
#include <utility>

#include "agent/geometry/chain.hpp"

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

geometry::HeadAngles angles(const Eigen::Vector2d& yaw_pitch) {
  return {yaw_pitch.x(), yaw_pitch.y()};
}

/// The rig with a state's calibration.
geometry::Rig believed_rig(const Problem& problem, const Vector& robot) {
  geometry::Rig rig = problem.rig;
  auto& [camera, head, sigmas] = rig;
  const int at = problem.calibration_at();
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
      sweep_arm_m_(problem.sweep_arm_m),
      unknowns_(problem.unknowns()),
      calibration_at_(problem.calibration_at()),
      torso_at_(problem.torso_of(1)) {
  const auto& [camera, head, sigmas] = rig_;
  const Matrix3d yaw = geometry::about_z(head.mount_rotation_rad.z());
  const Matrix3d yaw_pitch = yaw * geometry::about_y(head.mount_rotation_rad.y());
  Matrix3d axes;  // about which roll, pitch and yaw of the mount turn the camera
  axes << yaw_pitch.col(0), yaw.col(1), Vector3d::UnitZ();
  offset_from_unknowns_ = sigmas.mount_offset_sigma_m * mount_.cam_from_head;
  rotation_from_unknowns_ = sigmas.mount_rotation_sigma_rad * mount_.cam_from_head * axes;
  std::optional<HeadTurn> turn_1;
  for (std::size_t k = 0; k < count_; ++k) {
    readings_[k] =
        problem.measured[k] + angles(sigmas.encoder_sigma_rad * robot.segment<2>(reading_of(k)));
    const double sweep_sigma_rad = problem.sweep_sigma_rad[k];
    const Eigen::Vector2d measured_rad(problem.sweep[k].yaw_rad, problem.sweep[k].pitch_rad);
    sweeps_[k] = {measured_rad + sweep_sigma_rad * robot.segment<2>(sweep_of(k)), sweep_sigma_rad,
                  problem.row_px[k], problem.sweep_axes[k]};
    if (k > 0 && torso_sigma_.may_move()) {
      torsos_[k] = {torso_sigma_.rotation_rad * robot.segment<3>(torso_of(k)),
                    torso_sigma_.translation_m * robot.segment<3>(torso_of(k) + 3)};
    }
    const HeadTurn turn(readings_[k] + head.zero);
    if (k == 0) turn_1 = turn;
    looks_[k] = LookGeometry(mount_, *turn_1, turn, torsos_[k]);
    if (k > 0) {
      pose_[k] = by_unknowns_of_pose(looks_[k].pose_changes(mount_, *turn_1, turn, torsos_[k]));
    }
  }
  list_columns(problem);
}

Robot::PoseByUnknowns Robot::by_unknowns_of_pose(const PoseChanges& changes) const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const auto readings = changes.middleCols<2>(change_reading);
  const auto readings_1 = changes.middleCols<2>(change_reading_1);
  PoseByUnknowns out;
  out.reading = sigmas.encoder_sigma_rad * readings;
  out.torso << torso_sigma_.rotation_rad * changes.middleCols<3>(change_torso),
      torso_sigma_.translation_m * changes.middleCols<3>(change_torso + 3);
  out.shared << sigmas.encoder_sigma_rad * readings_1,
      changes.middleCols<3>(change_offset) * offset_from_unknowns_,
      changes.middleCols<3>(change_rotation) * rotation_from_unknowns_,
      sigmas.zero_sigma_rad * (readings + readings_1);
  return out;
}

void Robot::list_columns(const Problem& problem) {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  const auto own = [this](int raw, int unknown, double sigma) {
    own_[own_count_++] = {raw, unknown, sigma};
  };
  for (std::size_t k = 0; k < count_; ++k) {
    for (int i = 0; i < 2; ++i) {
      own(look_columns * static_cast<int>(k) + column_sweep + i, sweep_of(k) + i,
          problem.sweep_sigma_rad[k]);
    }
  }
  const int camera = raw_camera_at() - column_camera;
  own(camera + column_focal, calibration_at_ + focal_at, sigmas.focal_sigma_px);
  for (int i = 0; i < 2; ++i) {
    own(camera + column_centre + i, calibration_at_ + centre_at + i, sigmas.centre_sigma_px);
    own(camera + column_distortion + i, calibration_at_ + distortion_at + i,
        sigmas.distortion_sigma[static_cast<std::size_t>(i)]);
  }
  for (int i = 0; i < 3; ++i) own(raw_columns() + i, unknowns_ - 3 + i, 1.0);
  auto shared = shared_.begin();
  for (int i = 0; i < 2; ++i) *shared++ = reading_of(0) + i;
  for (int i = 0; i < 3; ++i) *shared++ = calibration_at_ + offset_at + i;
  for (int i = 0; i < 3; ++i) *shared++ = calibration_at_ + rotation_at + i;
  for (int i = 0; i < 2; ++i) *shared++ = calibration_at_ + zero_at + i;
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

Matrix Robot::by_unknowns(const Matrix& raw) const {
  Matrix out(raw.rows(), unknowns_);
  fill_by_unknowns(raw, Rows::all, out);
  return out;
}

Matrix Robot::information_by_unknowns(const Matrix& raw) const {
  Matrix out(unknowns_, unknowns_);
  fill_by_unknowns(by_unknowns(raw).transpose(), Rows::from_diagonal, out);
  return out;
}

void Robot::fill_by_unknowns(const Matrix& raw, Rows rows, Matrix& out) const {
  const auto first_row = [rows](int unknown) { return rows == Rows::all ? 0 : unknown; };
  const auto at = [this](int i) { return shared_[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < shared_unknowns; ++i)
    out.col(at(i)).tail(raw.rows() - first_row(at(i))).setZero();
  for (std::size_t k = 1; k < count_; ++k) {
    const int pose_at = look_columns * static_cast<int>(k);
    // Adds columns to `out` that mix the six of the look's pose.
    const auto mix = [&](int unknown, const auto& weights, bool adds) {
      const int first = first_row(unknown);
      const auto part = [&](int i) {
        return weights(i) * raw.col(pose_at + i).tail(raw.rows() - first);
      };
      auto column = out.col(unknown).tail(raw.rows() - first);
      if (adds)
        column += part(0) + part(1) + part(2) + part(3) + part(4) + part(5);
      else
        column = part(0) + part(1) + part(2) + part(3) + part(4) + part(5);
    };
    for (int i = 0; i < 2; ++i) mix(reading_of(k) + i, pose_[k].reading.col(i), false);
    for (int i = 0; i < shared_unknowns; ++i) mix(at(i), pose_[k].shared.col(i), true);
    if (!torso_sigma_.may_move()) continue;
    for (int i = 0; i < torso_unknowns; ++i) mix(torso_of(k) + i, pose_[k].torso.col(i), false);
  }
  for (const Own& column : own()) {
    const Eigen::Index count = raw.rows() - first_row(column.unknown);
    out.col(column.unknown).tail(count) = column.sigma * raw.col(column.raw).tail(count);
  }
}

Vector Robot::raw_step(const Vector& step) const {
  Vector out = Vector::Zero(raw_columns() + 3);
  Eigen::Matrix<double, shared_unknowns, 1> shared;
  for (int i = 0; i < shared_unknowns; ++i) shared(i) = step(shared_[static_cast<std::size_t>(i)]);
  for (std::size_t k = 1; k < count_; ++k) {
    auto pose = out.segment<pose_columns>(look_columns * static_cast<int>(k));
    pose = pose_[k].reading * step.segment<2>(reading_of(k)) + pose_[k].shared * shared;
    if (torso_sigma_.may_move()) pose += pose_[k].torso * step.segment<torso_unknowns>(torso_of(k));
  }
  for (const Own& column : own()) out(column.raw) = column.sigma * step(column.unknown);
  return out;
}

Matrix Robot::by_unknowns_of_look_1(const Eigen::Matrix<double, 3, change_torso>& by_changes,
                                    const Eigen::Matrix3d& by_target) const {
  const geometry::Uncertainty& sigmas = rig_.uncertainty;
  Matrix out = Matrix::Zero(3, unknowns_);
  const auto readings = by_changes.middleCols<2>(change_reading);
  out.middleCols<2>(reading_of(0)) = sigmas.encoder_sigma_rad * readings;
  out.middleCols<2>(calibration_at_ + zero_at) = sigmas.zero_sigma_rad * readings;
  out.middleCols<3>(calibration_at_ + offset_at) =
      by_changes.middleCols<3>(change_offset).lazyProduct(offset_from_unknowns_);
  out.middleCols<3>(calibration_at_ + rotation_at) =
      by_changes.middleCols<3>(change_rotation).lazyProduct(rotation_from_unknowns_);
  out.rightCols<3>() = by_target;
  return out;
}

void set_torso(TorsoSigma torso, Problem& problem, State& state) {
  const int first = problem.torso_of(1);
  const TorsoSigma before = std::exchange(problem.torso, torso);
  if (!torso.may_move()) {
    state.robot.conservativeResize(first);
    return;
  }
  for (std::size_t k = 1; k < problem.looks; ++k) {
    const int at = problem.torso_of(k);
    state.robot.segment<3>(at) *= before.rotation_rad / torso.rotation_rad;
    state.robot.segment<3>(at + 3) *= before.translation_m / torso.translation_m;
  }
}

void anchor_sweeps(const Vector& robot, Problem& problem) {
  const Robot now(problem, robot);
  problem.sweep_arm_m = now.mount().arm_m;
  for (std::size_t k = 0; k < problem.looks; ++k) problem.sweep_axes[k] = now.look(k).joint_axes();
}

BelievedRobot Robot::believed(const Matrix& covariance) const {
  const Vector shares =
      covariance.diagonal().cwiseSqrt().segment<calibration_count>(calibration_at_);
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
