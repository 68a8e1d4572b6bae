// The robot's own parts, where the head's angles say that they are in the frame: the shoulders and
// the chest, and of a robot that stands its feet.
//
// Parts are spheres and capsules in the torso's axes. What the ray of a sample of the map meets,
// and the samples beside it, is no object.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/saliency/bit_plane.hpp"

namespace gazed::saliency {

/// All points within `radius_m` of the line from one point to the other, torso frame, metres.
struct Capsule {
  Eigen::Vector3d from_m, to_m;
  double radius_m;
};

/// Of every NAO.
[[nodiscard]] std::span<const Capsule> body_parts();
/// Likewise, standing with its knees straight or bent.
[[nodiscard]] std::span<const Capsule> standing_feet();

/// What they leave of a map. Allocates nothing after construction.
class OwnParts {
 public:
  /// For the map of the camera's frames.
  OwnParts(const geometry::CameraModel& camera, bool body, bool feet);

  /// A factor for every sample of the map of a frame of that pose, Q15 (inhibition.hpp): none of S
  /// where a part is seen, all elsewhere; empty when no part is in view. The pose is made of
  /// doubles: a ray that touches a part within 1e-9 may be taken for it on one CPU and not on
  /// another. Borrowed until the next call.
  [[nodiscard]] std::span<const std::uint16_t> kept(const geometry::Pose& cam_from_torso);

 private:
  [[nodiscard]] bool in_view(const Capsule& in_cam) const;
  void mark(const Capsule& in_cam);

  std::vector<Capsule> parts_;
  std::vector<Eigen::Vector3d> rays_;  // of the map's samples, optical frame, length 1; NaN: none
  double half_angle_rad_ = 0.0;        // of the cone about the optical axis with all rays
  BitPlane seen_, beside_;
  std::vector<std::uint16_t> kept_;
};

}  // namespace gazed::saliency
