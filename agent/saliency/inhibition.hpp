// Inhibition of return: what was just looked at is less salient for a while, so that the gaze goes
// on to the next object (Itti, Koch, Niebur 1998, section 2.3).
//
// A place is where a ray points, in the torso's axes: the head angles that would turn the camera
// there, whatever the head does meanwhile. A camera that turns also moves, by 6 mm for 0.1 rad: at
// 0.3 m that is 0.02 rad, little beside a place's radius. A place's strength is 1 when it is added
// and falls off exponentially with time. What is left of S there is
//
//   1 - exp(-age / decay) exp(-angle^2 / (2 radius^2))
//
// and of overlapping places the product.
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

/// What is kept of S, Q15: this much is all of it.
inline constexpr int kept_fraction_bits = 15;
inline constexpr std::int32_t all_kept = 1 << kept_fraction_bits;

/// Multiplies S, in place. `kept` has a factor for every sample, at most all_kept.
void inhibit(const PlaneView<std::int32_t>& saliency, std::span<const std::uint16_t> kept);

/// The places, and what they leave of a map. Allocates nothing after construction.
class Inhibition {
 public:
  /// Of more places the oldest is forgotten.
  static constexpr std::size_t most_places = 16;

  /// Radius in radians, decay in seconds, both positive. For the map of the camera's frames.
  Inhibition(const geometry::CameraModel& camera, double radius_rad, double decay_s);

  /// `direction_in_torso` of any length but 0. A place nearer than the radius to one that is there
  /// replaces it.
  void add(const Eigen::Vector3d& direction_in_torso, std::int64_t utime_us);

  /// A factor for every sample of the map of a frame of that time and pose, Q15; empty when no
  /// place has a say there. A place from the future is forgotten: the clock was set. Borrowed until
  /// the next call.
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
