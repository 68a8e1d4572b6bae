// The least-squares problem of all looks: its unknowns, and how a step in them changes the robot.
//
// The robot's unknowns are deviations from its configured values in units of their sigmas, so their
// prior is the unit matrix, and an unknown with sigma zero stays where it is:
//
//   for every look two of its sweep and two errors of its reading | focal length | centre (2) |
//   distortion (k1, k2) | mount offset (3) | mount rotation (3) | zero (2) | for every later look
//   six of the torso's motion since look 1, where it may move
//
// They are followed by the target's direction (2) and inverse depth in look 1. The three unknowns
// of each feature are eliminated before solving (Schur complement: Triggs et al. 2000, Bundle
// adjustment, section 6).
//
// A look's reading belongs to the row with its target. Other rows were exposed earlier or later;
// the sweep, the head's turn from the first row's exposure to the last's, gives the angles at those
// times.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/triangulation/all_looks/believed_robot.hpp"
#include "agent/triangulation/all_looks/look_geometry.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/feature_observations.hpp"

namespace gazed::triangulation::all_looks {

inline constexpr int calibration_count = 13;
/// Positions among the calibration's unknowns.
inline constexpr int focal_at = 0, centre_at = 1, distortion_at = 3, offset_at = 5, rotation_at = 8,
                     zero_at = 11;
inline constexpr int look_unknowns = 4, torso_unknowns = 6;
inline constexpr int unknowns_max =
    (look_unknowns + torso_unknowns) * static_cast<int>(looks_max) + calibration_count + 3;
[[nodiscard]] constexpr int sweep_of(std::size_t look) {
  return look_unknowns * static_cast<int>(look);
}
[[nodiscard]] constexpr int reading_of(std::size_t look) {
  return sweep_of(look) + 2;
}
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, unknowns_max, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, unknowns_max, unknowns_max>;

/// One bit per look.
using LookSet = std::uint16_t;
static_assert(looks_max <= 16);
[[nodiscard]] constexpr LookSet only_look(std::size_t look) {
  return static_cast<LookSet>(1U << look);
}
[[nodiscard]] constexpr bool contains(LookSet set, std::size_t look) {
  return (set & only_look(look)) != 0;
}

/// No registration is better than this.
inline constexpr double registration_sigma_min_px = 1e-3;

/// Weak priors that keep the inverse depth of a point at the epipole determined: a feature is at
/// least about a centimetre away, a target a millimetre. The features' prior must be weak enough
/// that all of them together weigh nothing against a target's noise.
inline constexpr double feature_inverse_depth_sigma_per_m = 100.0;
inline constexpr double target_inverse_depth_sigma_per_m = 1000.0;

/// How far the torso may have moved since look 1, per axis. If zero, the torso stands still and has
/// no unknowns.
struct TorsoSigma {
  double rotation_rad = 0.0;
  double translation_m = 0.0;

  [[nodiscard]] bool may_move() const { return rotation_rad > 0.0 || translation_m > 0.0; }
  bool operator==(const TorsoSigma&) const = default;
};

/// The given data.
struct Problem {
  struct TargetObservation {
    geometry::Pixel pixel = geometry::Pixel::Zero();
    Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d whitening = Eigen::Matrix2d::Identity();  // px to standard deviations
  };
  struct Feature {
    const FeatureObservations* observed = nullptr;
    double sigma_px = 1.0;  // of each of its pixels
    LookSet seen = 0;       // the looks in which it has a pixel
    LookSet kept = 0;       // those whose pixel is believed; if none, the feature is left out
    bool behind = false;    // its pixels agree on a point behind the camera: never kept again
  };

  geometry::Rig rig;
  std::size_t looks = 0;
  std::array<geometry::HeadAngles, looks_max> measured;
  std::array<geometry::HeadAngles, looks_max> sweep{};  // measured
  std::array<double, looks_max> sweep_sigma_rad{};      // of each component
  std::array<double, looks_max> row_px{};               // the target's row, in looks that have one
  // How the sweeps turn the scene: see anchor_sweeps().
  std::array<Eigen::Matrix<double, 3, 2>, looks_max> sweep_axes;
  Eigen::Vector3d sweep_arm_m = Eigen::Vector3d::Zero();
  TorsoSigma torso;  // of the torso's motion since look 1
  std::array<TargetObservation, looks_max> target;
  LookSet target_kept = 0;  // always contains look 1
  std::array<Feature, features_max> features;
  std::size_t feature_count = 0;
  double feature_scale = 1.0;  // by which the features' residuals exceed their sigmas

  [[nodiscard]] int calibration_at() const { return sweep_of(looks); }
  /// Index of a later look's torso unknowns; only if the torso may move.
  [[nodiscard]] int torso_of(std::size_t look) const {
    return calibration_at() + calibration_count + torso_unknowns * (static_cast<int>(look) - 1);
  }
  [[nodiscard]] int robot_unknowns() const { return torso_of(torso.may_move() ? looks : 1); }
  [[nodiscard]] std::size_t features_kept() const;
  [[nodiscard]] int unknowns() const { return robot_unknowns() + 3; }
};

/// The values of the unknowns.
struct State {
  Vector robot;  // in standard deviations
  geometry::InverseDepthPoint target{Eigen::Vector2d::Zero(), 0.0};
  std::array<geometry::InverseDepthPoint, features_max> features;
};

/// The robot at a state.
///
/// Derivatives come in "raw" columns: eight for every look (pose and sweep), five for the camera
/// (RobotColumn), and three for the target. Look 1's pose defines the frame and does not move.
class Robot {
 public:
  Robot(const Problem& problem, const Vector& robot);

  [[nodiscard]] const geometry::HeadGeometry& head() const { return rig_.head; }  // with its zero
  [[nodiscard]] const geometry::CameraModel& camera() const { return rig_.camera; }
  [[nodiscard]] const CameraMount& mount() const { return mount_; }
  /// A look at its target's row; look 1 relative to itself is the identity.
  [[nodiscard]] const LookGeometry& look(std::size_t k) const { return looks_[k]; }
  /// Where look k sees a point, with the angles at the exposure of row `row_px`. Returns false like
  /// LookGeometry::see.
  [[nodiscard]] bool see(std::size_t k, const geometry::InverseDepthPoint& point, double row_px,
                         PointInLook& out) const;
  /// The same at the target's row, where the look's own angles hold.
  [[nodiscard]] bool see_at_target_row(std::size_t k, const geometry::InverseDepthPoint& point,
                                       PointInLook& out) const;
  /// What an error-free encoder would report in a look.
  [[nodiscard]] geometry::HeadAngles reading(std::size_t k) const { return readings_[k]; }
  [[nodiscard]] const TorsoMotion& torso(std::size_t k) const { return torsos_[k]; }
  [[nodiscard]] geometry::Pose torso_1_from_torso(std::size_t k) const;

  [[nodiscard]] int raw_columns() const { return raw_camera_at() + camera_columns; }
  [[nodiscard]] int raw_camera_at() const { return look_columns * static_cast<int>(count_); }
  /// Spreads a look's derivatives over the robot's raw columns.
  void add_raw(std::size_t k, const Eigen::Matrix<double, 1, robot_columns>& by_robot,
               Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) const;

  /// Converts derivatives by the raw columns and the target's three to derivatives by the unknowns.
  /// `raw` is n x (raw_columns + 3).
  [[nodiscard]] Matrix by_unknowns(const Matrix& raw) const;
  /// Converts information in the raw columns and the target's three to information in the unknowns,
  /// without the priors. Only the lower triangle is set.
  [[nodiscard]] Matrix information_by_unknowns(const Matrix& raw) const;
  /// The step in the raw columns and the target's three for a step in the unknowns.
  [[nodiscard]] Vector raw_step(const Vector& step) const;
  /// Derivative by the unknowns of something that depends only on look 1's joints and mount, given
  /// by columns of Change, and on the target.
  [[nodiscard]] Matrix by_unknowns_of_look_1(
      const Eigen::Matrix<double, 3, change_torso>& by_changes,
      const Eigen::Matrix3d& by_target) const;

  /// The calibration, with the sigmas that the solution's covariance leaves.
  [[nodiscard]] BelievedRobot believed(const Matrix& covariance) const;

 private:
  // Unknowns that move the poses of all later looks: look 1's reading, mount offset and rotation,
  // zeros.
  static constexpr int shared_unknowns = 10;
  /// A later look's pose as a function of the unknowns.
  struct PoseByUnknowns {
    Eigen::Matrix<double, pose_columns, 2> reading;
    Eigen::Matrix<double, pose_columns, torso_unknowns> torso;
    Eigen::Matrix<double, pose_columns, shared_unknowns> shared;
  };
  /// A raw column that depends on a single unknown.
  struct Own {
    int raw, unknown;
    double sigma;
  };
  static constexpr std::size_t own_max = 2 * looks_max + camera_columns + 3;

  [[nodiscard]] PoseByUnknowns by_unknowns_of_pose(const PoseChanges& changes) const;
  enum class Rows : std::uint8_t { all, from_diagonal };
  void fill_by_unknowns(const Matrix& raw, Rows rows, Matrix& out) const;
  void list_columns(const Problem& problem);
  [[nodiscard]] std::span<const Own> own() const { return std::span(own_).first(own_count_); }
  [[nodiscard]] int torso_of(std::size_t look) const {
    return torso_at_ + torso_unknowns * (static_cast<int>(look) - 1);
  }

  struct RowSweep {
    Eigen::Vector2d sweep_rad = Eigen::Vector2d::Zero();
    double sigma_rad = 0.0;
    double row_px = 0.0;  // the row to which the look's reading belongs
    Eigen::Matrix<double, 3, 2> axes;
  };

  geometry::Rig rig_;  // the current calibration; its uncertainty is that before the looks
  CameraMount mount_;
  std::size_t count_;
  TorsoSigma torso_sigma_;
  Eigen::Vector3d sweep_arm_m_;
  std::array<geometry::HeadAngles, looks_max> readings_;
  std::array<TorsoMotion, looks_max> torsos_;
  std::array<RowSweep, looks_max> sweeps_;
  std::array<LookGeometry, looks_max> looks_;
  Eigen::Matrix3d offset_from_unknowns_, rotation_from_unknowns_;  // camera axes
  std::array<PoseByUnknowns, looks_max> pose_;                     // for later looks
  std::array<int, shared_unknowns> shared_;                        // their indices
  std::array<Own, own_max> own_;
  std::size_t own_count_ = 0;
  int unknowns_, calibration_at_, torso_at_;
};

/// The same state with the torso's unknowns in units of another level's sigmas; without them if
/// that level does not move.
void set_torso(TorsoSigma torso, Problem& problem, State& state);

/// Fixes how the sweeps turn the scene to the robot as it is now: its arm and axes are then not
/// unknowns there. What is learnt about them later is used at the next call.
void anchor_sweeps(const Vector& robot, Problem& problem);

}  // namespace gazed::triangulation::all_looks
