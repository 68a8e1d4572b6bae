// Inhibition of return: what was just looked at is less salient for a while, so that the gaze moves
// on to the next object (Itti, Koch, Niebur 1998, section 2.3).
//
// A place is a direction in the torso's axes: that of the head angles that would point the camera
// there, wherever the head is now. A camera that turns also moves, by 6 mm for 0.1 rad; at 0.3 m
// that is 0.02 rad, small compared with a place's radius. A place's strength is 1 when it is added
// and decays exponentially. The factor on S is
//
// 1 - exp(-age / decay) exp(-angle^2 / (2 radius^2))
//
// and the product of these for overlapping places.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

/// The factor on S, in Q15: this value keeps everything.
inline constexpr int kept_fraction_bits = 15;
inline constexpr std::int32_t all_kept = 1 << kept_fraction_bits;

/// Multiplies S in place. `kept` has a factor for every sample, at most all_kept.
void inhibit(const PlaneView<std::int32_t>& saliency, std::span<const std::uint16_t> kept);

/// The inhibited places and their effect on a map. Allocates nothing after construction.
class Inhibition {
 public:
  /// When there are more, the oldest is forgotten.
  static constexpr std::size_t most_places = 16;

  /// Radius in radians and decay in seconds, both positive. For maps of this camera's frames.
  Inhibition(const geometry::CameraModel& camera, double radius_rad, double decay_s);

  /// `direction_in_torso` may have any length but 0. Replaces an earlier place that is nearer than
  /// the radius.
  void add(const Eigen::Vector3d& direction_in_torso, std::int64_t utime_us);

  /// A factor in Q15 for every sample of the map of a frame with this time and pose; empty if no
  /// place affects it. A place in the future is forgotten, because the clock was set back. Valid
  /// until the next call.
  [[nodiscard]] std::span<const std::uint16_t> kept(const geometry::Pose& cam_from_torso,
                                                    std::int64_t utime_us);

 private:
  struct Place {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // torso axes, length 1
    std::int64_t utime_us = 0;
  };

  [[nodiscard]] Place& place_for(const Eigen::Vector3d& direction);
  [[nodiscard]] bool multiply(const Eigen::Vector3f& direction_in_cam, double strength);

  double radius_rad_;
  double decay_s_;
  std::vector<Eigen::Vector3f> rays_;  // of the map's samples, optical frame, length 1; NaN: none
  std::vector<std::uint16_t> kept_;
  std::array<Place, most_places> places_;
  std::size_t count_ = 0;
};

}  // namespace gazed::saliency
