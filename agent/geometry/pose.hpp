// Rigid motions, named so that inner frame names cancel when read aloud:
//
//   x_in_b = b_from_a * x_in_a          c_from_a = c_from_b * b_from_a
//
// Lengths in metres.
#pragma once

#include <Eigen/Core>

namespace gazed::geometry {

/// x_in_b = rotation * x_in_a + translation, for a pose called b_from_a.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Pose inverse() const {
    return {rotation.transpose(), -(rotation.transpose() * translation)};
  }
};

[[nodiscard]] inline Eigen::Vector3d operator*(const Pose& b_from_a,
                                               const Eigen::Vector3d& x_in_a) {
  return b_from_a.rotation * x_in_a + b_from_a.translation;
}

[[nodiscard]] inline Pose operator*(const Pose& c_from_b, const Pose& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation,
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

/// Where b's origin stands in a.
[[nodiscard]] inline Eigen::Vector3d origin(const Pose& b_from_a) {
  return -(b_from_a.rotation.transpose() * b_from_a.translation);
}

/// The rotation by a rotation vector: about it, by its length.
[[nodiscard]] Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector_rad);

/// The smallest rotation that turns the direction of `from` to that of `to`, neither of which may
/// be zero; where they are opposite, one of the half turns. As two reflections.
[[nodiscard]] Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from,
                                               const Eigen::Vector3d& to);

}  // namespace gazed::geometry
