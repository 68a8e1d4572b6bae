// The robot's own parts that are in view at the given head angles: shoulders and chest and, for a
// standing robot, the feet.
//
// Parts are spheres and capsules in the torso's axes. Samples of the map whose ray, or whose
// neighbour's ray, meets a part are not considered as objects.
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

/// Parts that every NAO has.
[[nodiscard]] std::span<const Capsule> body_parts();
/// The same for the feet of a standing robot, with straight or bent knees.
[[nodiscard]] std::span<const Capsule> standing_feet();

/// The effect of the parts on a map. Allocates nothing after construction.
class OwnParts {
 public:
  /// For maps of this camera's frames.
  OwnParts(const geometry::CameraModel& camera, bool body, bool feet);

  /// A factor in Q15 (inhibition.hpp) for every sample of the map of a frame with this pose: 0
  /// where a part is seen, 1 elsewhere; empty if no part is in view. The pose is floating point:
  /// CPUs may differ for a ray that passes a part's surface within 1e-9. Valid until the next call.
  [[nodiscard]] std::span<const std::uint16_t> kept(const geometry::Pose& cam_from_torso);

 private:
  [[nodiscard]] bool in_view(const Capsule& in_cam) const;
  void mark(const Capsule& in_cam);

  std::vector<Capsule> parts_;
  std::vector<Eigen::Vector3d> rays_;  // of the map's samples, optical frame, length 1; NaN: none
  double half_angle_rad_ = 0.0;        // of the cone about the optical axis that contains all rays
  BitPlane seen_, beside_;
  std::vector<std::uint16_t> kept_;
};

}  // namespace gazed::saliency
