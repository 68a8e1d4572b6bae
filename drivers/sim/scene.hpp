// A scene: what the simulated robot sees and how its joints and its camera behave, as a TOML file
// says it.
//
// A room of planes and targets stands still, or what of it is told to move; tests, one after the
// other, add an object, and a wall that it is taped to. A value that the file leaves out is that of
// the robot's profile, or of a device without errors. The structs below say what each key means,
// one struct a table; the key is the member's name unless a comment says otherwise.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/rig.hpp"
#include "drivers/sim/texture.hpp"

namespace gazed::sim {

enum class Shape : std::uint8_t { rectangle, disc, ball, box };

/// Detail drawn on an object, inside its border.
enum class Mark : std::uint8_t { none, ring, cross };

/// How a surface takes the light of the room's lamp.
struct Finish {
  double shading = 0.5;  // of a ball or a box: the share of its light that comes from the lamp
  double gloss = 0.0;    // the mirrored lamp's brightness, 1 is white: a highlight that moves over
                         // the surface when the camera moves
  int shininess = 64;    // the greater, the smaller the highlight (exponent of Blinn 1977)
};

/// A thing's shape and its paint. Keys shape, size_m, depth_m, texture = { ... }, mark,
/// mark_colour, shading, gloss, shininess.
struct Appearance {
  Shape shape = Shape::rectangle;
  std::array<double, 2> size_m{0.06, 0.06};  // width and height; of a disc its axes, of a ball its
                                             // diameter, twice; of a box its front
  double depth_m = 0.06;                     // of a box, from its front to its back
  Texture texture;  // keys pattern, colour, colour_2, cell_m, tile_m, contrast, seed, gradient,
                    // vignette, file (P5 or P6, beside the scene's file)
  Mark mark = Mark::none;
  std::array<double, 3> mark_colour{0, 0, 0};
  Finish finish;
};

/// A thing that does not stand still: keys velocity_m_s and moving_s of [[plane]], [[target]] and
/// the tests (of a test it moves the object, not the wall: what moves backwards vanishes in it).
struct Motion {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // torso frame
  /// It moves between these times, counted from the test's start: between two looks, say.
  std::array<double, 2> moving_s{0.0, 1e6};

  [[nodiscard]] bool moves() const { return velocity_m_s != Eigen::Vector3d::Zero(); }
  [[nodiscard]] Eigen::Vector3d way_m(double time_s) const {
    return std::clamp(time_s - moving_s[0], 0.0, moving_s[1] - moving_s[0]) * velocity_m_s;
  }
};

/// [[plane]] and [[target]]: a thing that is always there. Flat ones are seen from both sides.
struct PlacedPlane {
  Appearance appearance;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  // torso frame; of a box, its front's
  Eigen::Vector3d normal = -Eigen::Vector3d::UnitX();  // towards whom it faces
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();       // of its picture
  Motion motion;
  bool target = false;
};

/// Where a test's object is put. Its front faces camera 1, the camera with the head at (0, 0).
enum class Placement : std::uint8_t {
  image_centre,  // report test 1: on a wall square to the optical axis, seen at the image's centre
  image_corner,  // report test 2: the same wall, seen as far in the top left corner as it is whole
  pixel,         // seen at a pixel of camera 1
  position,      // in the torso frame
};

/// [[report_test]] (keys number, range_m, object) and [[target_test]] (keys pixel and range_m, or
/// position_m; wall, wall_gap_m, object). `object = { ... }` changes keys of [object] for this
/// test.
struct SceneTest {
  Placement placement = Placement::image_centre;
  double range_m = 0.30;  // report tests: camera to wall along the optical axis; pixel: camera to
                          // the object's centre along the ray
  geometry::Pixel pixel = geometry::Pixel::Zero();
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  bool wall = true;         // [wall] stands behind the object, square to the optical axis
  double wall_gap_m = 0.0;  // from the object back to the wall, along the optical axis
  Motion motion;
  Appearance object;
};

/// [robot]: what it truly measures; what is left out is the profile's.
struct RobotTruth {
  std::optional<std::array<double, 2>> focal_px;
  std::optional<std::array<double, 2>> centre_px;
  std::optional<std::array<double, 5>> distortion;
  std::optional<std::array<double, 3>> neck_offset_m;
  std::optional<std::array<double, 3>> mount_offset_m;
  std::optional<std::array<double, 3>> mount_rotation_rad;
  std::optional<std::array<double, 2>> zero_rad;  // yaw, pitch: a constant offset, added to what
                                                  // the sensor says to give the joint's angle
};

/// What a head says about its velocity: LoLA's and NAOqi's nothing, others 0 whatever happens.
enum class Velocity : std::uint8_t { measured, none, zero };

/// [joints]
struct JointBehaviour {
  std::optional<std::array<double, 2>> max_speed_rad_s;  // yaw, pitch; the profile's when left out
  double acceleration_rad_s2 = 20.0;                     // B-Human 2024, HeadMotionEngine.h
  double settle_time_constant_s = 0.02;    // the joint follows its course with a first-order lag
  double settling_error_rad = 0.0;         // resting place off the command, uniform within +- this
  double encoder_step_rad = 0.0;           // what is measured is a multiple of this
  double encoder_noise_rad = 0.0;          // standard deviation of each sample
  double encoder_sigma_rad = 0.0;          // the same of each look: constant until the next command
  double backlash_rad = 0.0;               // play between encoder and camera, whole width
  double drift_rad_s = 0.0;                // it goes on so fast where its last move went
  double velocity_noise_rad_s = 0.005;     // standard deviation of each sample
  Velocity velocity = Velocity::measured;  // key: "measured", "none" (NaN) or "zero"
};

/// [sway]: the torso, and the head with it, sways in the room, as a standing robot does that keeps
/// its balance. Position and rotation along and about each axis are sums of three sines near the
/// frequency, with phases that the seed draws; each sum varies as much as one sine of the amplitude
/// given. Positions of a scene are in the torso's frame at rest.
struct Sway {
  double translation_m = 0.0;  // amplitude
  double rotation_rad = 0.0;   // amplitude
  double frequency_hz = 0.3;

  [[nodiscard]] bool sways() const { return translation_m > 0.0 || rotation_rad > 0.0; }
};

/// [camera]
struct CameraBehaviour {
  std::optional<int> width_px;  // the profile's when left out; focal length and centre go with it
  std::optional<int> height_px;
  double fps = 30.0;
  base::PixelFormat format = base::PixelFormat::rgb24;  // key: "rgb" or "yuyv"
  double pixel_noise = 0.0;                             // standard deviation, grey levels
  double blur_sigma_px = 0.0;                           // of the lens, Gaussian
  double exposure = 1.0;                                // factor on all brightness
  double exposure_swing = 0.0;     // it changes by up to this share, as a sine that
  double exposure_period_s = 3.0;  // starts with the test: light and automatic exposure
  double exposure_step = 0.0;      // it changes at once, by up to this share, when the head has
                                   // turned: automatic exposure
  double readout_s = 0.0;          // rolling shutter: first row to last
  double delay_s = 0.0;            // time stamp + delay_s = start of exposure
  int jpeg_quality = 0;            // of MJPEG, 1 to 100; 0: not compressed. Needs format "yuyv"
  double drop_rate = 0.0;          // share of frames that get lost
};

/// [room]
struct Room {
  std::array<double, 3> background{128, 128, 128};  // where there is nothing
  Eigen::Vector3d lamp_m{-0.3, 0.6, 1.6};           // torso frame
};

struct Scene {
  bool repeat = true;  // after the last test comes the first again
  RobotTruth robot;
  JointBehaviour joints;
  Sway sway;
  CameraBehaviour camera;
  Room room;
  Appearance wall;  // [wall], behind the objects of the tests
  std::vector<PlacedPlane> planes;
  std::vector<SceneTest> tests;  // report tests first; empty: the room alone is the only test
  geometry::UncertaintyOverride
      uncertainty;  // [uncertainty]: what the agent is told about the robot
};

/// Throws std::invalid_argument "source_name:line: key: value found; allowed: ..." for anything
/// that is not a scene. Picture files are looked for beside `source_name`.
[[nodiscard]] Scene parse_scene(std::string_view toml_text, const std::string& source_name);

/// Throws std::invalid_argument also for a file that cannot be read.
[[nodiscard]] Scene load_scene(const std::string& path);

/// The report's tests 1 and 2 (Russcher 2011, section 4.4) in turn, for ever.
[[nodiscard]] std::string_view default_scene_toml();

}  // namespace gazed::sim
