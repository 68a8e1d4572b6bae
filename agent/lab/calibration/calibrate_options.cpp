#include "agent/lab/calibration/calibrate_options.hpp"

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/camera_file.hpp"
#include "agent/lab/io/csv.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr const char* calibrate_footer = R"(
The input decides what is calibrated:

  pictures of a chessboard,          focal length, centre and distortion of the camera. 10 to 20
  or a folder of them                pictures, the board tilted by 20 to 40 degrees each way in most
                                     of them, near and far, and into every corner of the image. The
                                     pixels count as they were coded: a noted orientation is how the
                                     camera was held
  FOLDER or LOG.lcm with --board     how the camera sits in the head (rotation and offset), the
                                     joints' zeros and scales, and the camera: a board that stands
                                     still, about 20 head angles that keep it in view
  FOLDER or LOG.lcm alone            the same from ANY textured scene that stands still, 12 pictures
                                     or more that overlap, over all angles of both joints. Nothing
                                     in it is measured, so the length of the arm from the neck to
                                     the camera stays what it was believed to be
  --observations CSV                 the same from marks that were measured
  --delay WALK.lcm                   when the camera exposes, against the times of the head's angles:
                                     camera.delay_s and camera.readout_s, from a head that looks
                                     about in a textured room for 10 s or more, both joints, the
                                     camera and the mount calibrated before (--config)

FOLDER holds pictures and frames.csv, as gazelab log takes it:

  utime_us,file,yaw_rad,pitch_rad
  1700000000000000,first.jpg,0.0,0.0

yaw_rad, pitch_rad: HeadYaw (positive left) and HeadPitch (positive down), measured with the head at
rest. Of an LCM log (gazed --record, lcm-logger) each place that the head rests at for a few tenths
of a second is one picture.

CSV, a row a reading; pixels, (0,0) the centre of the top left one; the mark in metres, in a frame of
the marks' own (x, y, z right-handed), or with --marks-frame torso in the torso's:

  yaw_rad,pitch_rad,x_px,y_px,X_m,Y_m,Z_m
  0.0,0.1,412.3,250.9,0.50,-0.12,0.20

What is believed before is the robot's profile, or --config FILE, with its sigmas as priors. A
distortion in FILE is kept; without one it is estimated. So calibrate the camera first, then the
head:

  gazelab calibrate --board 9x6 --square 0.025 --out camera.toml board/*.jpg
  gazelab calibrate --config camera.toml --board 9x6 --square 0.025 --out robot.toml walk.lcm
  gazed --config robot.toml

The report, on standard error: residuals before and after (px rms), each number with its standard
deviation, and what could not be observed, found from the information matrix: a constant yaw offset
turns the whole world with the robot; a pitch offset is the same as a turned mount; the size of a
scene that nobody measured follows the arm. There the prior stays. The TOML, on standard output or in
--out FILE, holds every key of camera and head with the sigmas that gazed is to count on; other keys
of --config are not copied. gazed has no key for an encoder's scale: one that is plainly not 1 is a
warning. Nor has it one for an axis offset: that goes into mount_offset_m and neck_offset_m, with a
warning and a larger mount_offset_sigma_m where that is not exact.

Russcher (2011, chapter 5) proposes to find the distances from the neck to the camera by tilting the
head until the camera's z is 0, a triangle from one angle that must be known exactly. Here all angles
used take part, none has to be exact, and the mount's rotation, which moved that robot's points more
than its distances did, is found with them.

Exit: 0 done, 1 a file could not be read or written or no geometry fits, 2 bad arguments or too
little to calibrate from.

More examples:
  gazelab calibrate --out robot.toml walk.lcm                    any textured room
  gazelab calibrate --board 9x6 --square 0.025 pictures > robot.toml
  gazelab calibrate --observations marks.csv --config head.toml --axis-offset estimate
  gazelab calibrate --config robot.toml --delay walk.lcm --out robot-2.toml
  gazelab calibrate --camera-file ost.yaml --out camera.toml     what ROS calibrated, for gazed
)";

/// Where the pitch axis stands from the yaw axis; "estimate", or "0.0058,0,0.022".
void read_axis_offset(std::string_view text, HeadBelief& belief) {
  belief.axis_offset_estimated = text == "estimate";
  if (text.empty() || belief.axis_offset_estimated) return;
  constexpr double farthest_m = 0.5;  // gazed's keys, which it goes into, end at 1 m
  const auto fields = io::split_csv_line(text);
  bool good = fields && fields->size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const io::ParsedNumber number = io::parsed_number(io::trimmed((*fields)[i]));
    good = number.value && std::abs(*number.value) <= farthest_m;
    if (good) belief.model.axis_offset_m[static_cast<Eigen::Index>(i)] = *number.value;
  }
  if (good) return;
  throw std::invalid_argument("--axis-offset: '" + base::excerpt(text) +
                              "' found; allowed: estimate, or X,Y,Z in metres, each -0.5 to 0.5");
}

}  // namespace

settings::Settings settings_of(const CalibrateOptions& options) {
  settings::SettingsLayers layers;
  if (!options.config.empty()) layers.file = options.config;
  if (!options.robot.empty()) {
    layers.command_line.push_back({.key = "robot", .text = options.robot, .where = "--robot"});
  }
  settings::Settings settings = settings::load_settings(
      layers, [](const std::string&) { return geometry::UncertaintyOverride{}; });
  if (!options.camera_file.empty()) {
    settings.rig.camera = read_camera_file(options.camera_file, settings.rig.camera);
  }
  return settings;
}

std::optional<Chessboard> board_of(const CalibrateOptions& options) {
  if (options.board.empty() && options.square_m == 0.0) return std::nullopt;
  if (options.board.empty()) {
    throw std::invalid_argument(
        "--square without --board; allowed: both, as --board 9x6 "
        "--square 0.025");
  }
  return parsed_chessboard(options.board, options.square_m);
}

HeadBelief belief_of(const CalibrateOptions& options, const settings::Settings& settings) {
  HeadBelief belief;
  belief.model.camera = settings.rig.camera;
  belief.model.head = settings.rig.head;
  belief.uncertainty = settings.rig.uncertainty;
  belief.marks_in_torso = options.marks_frame == "torso";
  read_axis_offset(options.axis_offset, belief);
  return belief;
}

int window_of(const CalibrateOptions& options) {
  if (options.corner_window == "auto") return window_by_square;
  constexpr int smallest = 2, largest = 50;
  const auto window = io::parsed<int>(options.corner_window);
  if (window && *window >= smallest && *window <= largest) return *window;
  throw std::invalid_argument(
      "--corner-window: '" + base::excerpt(options.corner_window) +
      base::text("' found; allowed: auto, or %d to %d pixels", smallest, largest));
}

void add_options(CLI::App& command, CalibrateOptions& options) {
  command
      .add_option("INPUT", options.inputs,
                  "pictures of a chessboard, or a folder of them; a folder with frames.csv; an "
                  "LCM log")
      ->type_name("");
  command.add_option("--board", options.board, "the chessboard's inner corners, as 9x6")
      ->type_name("CxR");
  command.add_option("--square", options.square_m, "the side of its squares")->type_name("METRES");
  command
      .add_option("--corner-window", options.corner_window,
                  "half the window that refines a corner, pixels; auto: less than half a square")
      ->type_name("PX")
      ->capture_default_str();
  command.add_option("--observations", options.observations, "measured marks instead of pictures")
      ->type_name("CSV");
  command
      .add_option("--marks-frame", options.marks_frame,
                  "own: the marks' frame stands anywhere; torso: it is the torso's")
      ->check(CLI::IsMember({"own", "torso"}))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--axis-offset", options.axis_offset,
                  "from the yaw axis to the pitch axis: X,Y,Z in metres, or estimate; "
                  "the NAO's axes meet")
      ->type_name("OFFSET");
  command
      .add_option("--delay", options.delay_log,
                  "the camera's delay and readout, from the LCM log of a head that moves")
      ->type_name("WALK.lcm");
  command.add_option("--config", options.config, "what is believed before: gazed's configuration")
      ->type_name("FILE");
  command
      .add_option("--camera-file", options.camera_file,
                  "the camera that is believed before: ROS's camera_info, OpenCV's YAML or XML, "
                  "Kalibr's camchain; without any input it is written as --out asks")
      ->type_name("FILE");
  command.add_option("--robot", options.robot, "nao-v3, nao-v4, nao-v5, nao-v6 (default)")
      ->type_name("NAME");
  command
      .add_option(
          "--out", options.out,
          "write the TOML to this file, - for standard output; .yaml: ROS's camera_info, .xml: "
          "OpenCV's")
      ->type_name("FILE")
      ->capture_default_str();
  command.footer(calibrate_footer);
}

}  // namespace gazed::lab::calibration
