// A rig: a camera in a head that turns, and how well both are known. The three travel together:
// whatever is worked out of a look's pixels needs all of them.
#pragma once

#include <array>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::geometry {

/// Standard deviations of everything that is measured or was calibrated; each holds for every axis
/// it applies to.
struct Uncertainty {
  double pixel_sigma_px =
      0.0;  // of an image point, per axis, on top of the registration's own covariance
  double encoder_sigma_rad = 0.0;            // of a joint angle, per axis and look
  double zero_sigma_rad = 0.0;               // of a joint's zero: the same error in all looks
  double focal_sigma_px = 0.0;               // one error for fx and fy together
  double centre_sigma_px = 0.0;              // of the principal point, per axis
  std::array<double, 2> distortion_sigma{};  // of k1 and k2
  double mount_offset_sigma_m = 0.0;         // of the camera's position in the head, per axis
  double mount_rotation_sigma_rad = 0.0;     // of the camera's orientation in the head, per axis
  // How far a standing robot's torso may move between two looks, at most, per axis; how far it does
  // is found out.
  double torso_rotation_sigma_rad = 0.0;
  double torso_translation_sigma_m = 0.0;
  // How much less the background's corners tell than their residuals say, 1 or more. Where edges of
  // two depths cross, or light glides over gloss, a corner moves with the view. Such errors agree
  // between the looks: a point of their own explains them, and no residual shows them.
  double corner_slip = 1.0;
};

/// Those of an Uncertainty that somebody states; the others keep what they have.
struct UncertaintyOverride {
  std::optional<double> pixel_sigma_px = std::nullopt;
  std::optional<double> encoder_sigma_rad = std::nullopt;
  std::optional<double> zero_sigma_rad = std::nullopt;
  std::optional<double> focal_sigma_px = std::nullopt;
  std::optional<double> centre_sigma_px = std::nullopt;
  std::optional<std::array<double, 2>> distortion_sigma = std::nullopt;
  std::optional<double> mount_offset_sigma_m = std::nullopt;
  std::optional<double> mount_rotation_sigma_rad = std::nullopt;
  std::optional<double> torso_rotation_sigma_rad = std::nullopt;
  std::optional<double> torso_translation_sigma_m = std::nullopt;
  std::optional<double> corner_slip = std::nullopt;
};

struct Rig {
  CameraModel camera;
  HeadGeometry head;
  Uncertainty uncertainty;
};

}  // namespace gazed::geometry
