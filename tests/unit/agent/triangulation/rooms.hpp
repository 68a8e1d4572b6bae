// Robots in rooms, without images: a robot that is not quite what it is believed to be looks at a
// target several times and sees features of the background.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "agent/geometry/rig.hpp"
#include "agent/triangulation/all_looks/locate.hpp"

#include "random.hpp"

namespace gazed::triangulation {

enum class Moves {
  corners,  // the target to the corners of the field, in turn
  pair      // the target somewhere in the frame, and one look by the step rule
};

struct RoomModel {
  Moves moves = Moves::corners;
  std::size_t looks = 8;
  double range_m = 1.0;  // from look 1's camera
  std::size_t features = 100;
  double encoder_sigma_rad = 1.5e-3;
  std::array<double, 2> distortion_sigma{};
  // Of the torso's motion since look 1, per axis; what is told is the profile's most.
  bool torso_may_move = false;
  double torso_rotation_rad = 0.0;
  double torso_translation_m = 0.0;
  bool centred = false;      // the target is at the frame's centre in look 1
  bool exact = false;        // the robot is what it is believed to be, and measures without error
  double wrong_share = 0.0;  // of the tracks: every later pixel of theirs is anywhere near
  double sweep_sigma_rad = 0.0;           // rolling shutter: of the turn while a frame is read out
  double sweep_measured_sigma_rad = 0.0;  // of what is measured of it, and told
};

/// What is measured, and the truth of it.
struct Room {
  geometry::Rig rig;  // as believed, a calibrated V6
  std::vector<all_looks::Look> looks;
  std::vector<FeatureObservations> features;
  geometry::HeadGeometry true_head;
  geometry::CameraModel true_camera;
  std::vector<geometry::HeadAngles> true_readings;  // at the target's row
  std::vector<geometry::HeadAngles> true_sweeps;
  std::vector<geometry::Pose> true_torso_from_torso_1;  // at every look
  Eigen::Vector3d torso_point_m;
  double inverse_range_per_m = 0.0;

  [[nodiscard]] all_looks::Estimate locate(const Gate& gate = {}) const;
  [[nodiscard]] all_looks::Estimate locate_without_features(const Gate& gate = {}) const;
};

/// Encoders as told, the target's point given by look 1's pixel and found to 0.5 px later, features
/// to 0.3 to 0.5 px in every look at 0.3 to 5 m, the robot's errors drawn from the sigmas that it
/// is believed with.
[[nodiscard]] Room random_room(const RoomModel& model, Random& random);

}  // namespace gazed::triangulation
