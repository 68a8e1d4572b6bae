// What the accuracy benchmark measures: for each row of its table, how a simulated robot, its room
// and its target are drawn.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "agent/settings/settings.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed::benchmarks {

enum class Room : std::uint8_t {
  textured,   // a room papered with photographic texture; the object hangs on a wall of it, or free
  blank,      // one red object on a white wall
  cluttered,  // the textured room with six dull things and a second object that stands out
  colourful,  // painted and papered walls, furniture, books, posters, a table with things; the
              // object has any hue
  photographs,  // the same with walls of photographs
};

/// What robot and camera do besides erring as they are told to.
enum class Body : std::uint8_t {
  calm,  // joints stop dead, all rows are exposed at once, RGB
  real,  // joints creep into their goals and say nothing of their velocity, encoders have steps,
         // the profile's rolling shutter, YUYV
  uncalibrated,  // the same, of a robot of which only the profile is known
};

/// What else is hard, one thing a row.
enum class Strain : std::uint8_t {
  none,
  sway,      // the torso, as of a robot that keeps its balance
  lens,      // distortion of two pixels in the corners, not told
  exposure,  // 30 % more or less at each look
  ball,
  ball_pattern,
  ball_glossy,  // a ball in place of the flat object
  highlight,    // the lamp mirrored in the object
  edge,         // something nearer that hides part of the object in some looks
  jpeg,         // MJPEG of quality 60
  drift,        // the object moves on all the time, by millimetres a second
  fast_drift,   // by 5 to 30
  jump,         // it is moved once, by centimetres
  twins,        // a second one, just the same, beside it
  sweep,        // the head turns by 3 mrad while a frame is read out, and such looks are used
  no_sweep,     // the same settings, and a head that stands
  real_mount,   // the camera is turned in the head as those of real V6 heads are
};

/// Where in view 1 the object is: uniform over that part of the frame in which it is seen whole.
enum class Region : std::uint8_t {
  frame,
  level_or_below,  // of the camera's level
  above_level,     // by up to 0.3 rad
};

/// One row of the table. Values of which there are several are drawn, each as likely.
struct Row {
  std::string_view name;
  Room room = Room::textured;
  Region region = Region::level_or_below;
  double range_min_m = 0.3;  // of the object's centre from camera 1; log-uniform
  double range_max_m = 0.3;
  std::span<const double> encoder_sigmas_rad;
  std::span<const int> looks;  // none: as many as the default configuration needs
  gaze::Plan plan = gaze::Plan::parallax;
  Body body = Body::calm;
  Strain strain = Strain::none;
  int width_px = 640;       // of the image, 4:3
  std::uint64_t seeds = 0;  // number of its range of seeds: rows share none, and keep theirs
};

/// In the order of the table. Those of Room::photographs need the folder that the environment's
/// GAZED_PHOTOGRAPHS names, with pictures as P6 files.
[[nodiscard]] std::span<const Row> accuracy_rows();

/// One robot in front of one target.
struct Trial {
  std::uint64_t seed = 0;
  sim::Scene scene;             // with the robot as it truly is
  settings::Settings settings;  // what the agent believes and has been told
  std::string_view layout;      // "wall": the object is on a wall, "free": it stands before one
  double range_m = 0.0;         // of the object's centre
  double elevation_rad = 0.0;   // of its direction from camera 1
};

/// The robot is a nao-v6 calibrated to f 0.5 px, arm 1 mm, zeros 3 mrad, or not calibrated at all:
/// every trial draws the errors that remain, and the agent is told their sigmas. The same row and
/// index give the same trial. Throws std::runtime_error when a row's photographs are not there.
[[nodiscard]] Trial draw_trial(const Row& row, std::uint64_t index);

}  // namespace gazed::benchmarks
