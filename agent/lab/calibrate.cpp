// gazelab calibrate: the camera, and how it sits in the head.
#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/board_pictures.hpp"
#include "agent/lab/calibration/calibrate_inputs.hpp"
#include "agent/lab/calibration/calibrate_options.hpp"
#include "agent/lab/calibration/calibrated_settings.hpp"
#include "agent/lab/calibration/calibration_report.hpp"
#include "agent/lab/calibration/camera_file.hpp"
#include "agent/lab/calibration/delay.hpp"
#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/lab/calibration/intrinsics.hpp"
#include "agent/lab/commands.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/saliency/validation.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::lab {

namespace {

/// A file only when gazed takes it. `condition`: of the numbers, "yaw angles are multiplied by
/// 0.94".
void write_toml(const calibration::CalibrateOptions& options, const settings::Settings& settings,
                const std::string& comment,
                calibration::Timing timing = calibration::Timing::left_out,
                const std::string& condition = {}) {
  calibration::check_read_back(settings);
  const std::string toml = calibration::calibration_toml(settings, comment, timing);
  if (const auto format = calibration::camera_format_of(options.out)) {
    io::write_text_file(options.out, calibration::camera_text(settings.rig.camera, *format));
    std::fprintf(stderr, "\n%s: the camera alone, without its sigmas\n", options.out.c_str());
  } else if (options.out != "-") {
    io::write_text_file(options.out, toml);
    std::fprintf(stderr, "\n%s: ready for gazed --config%s\n", options.out.c_str(),
                 condition.empty() ? "" : (" once measured " + condition).c_str());
  } else if (std::fputs(toml.c_str(), stdout) < 0 || std::fflush(stdout) != 0) {
    throw std::runtime_error("standard output: cannot be written");
  }
}

/// A camera whose pictures are larger than gazed takes is believed at the width configured.
settings::Settings as_gazed_takes_it(settings::Settings settings, int width_px) {
  const geometry::CameraModel pictures = settings.rig.camera;
  if (saliency::size_is_taken(pictures.width_px, pictures.height_px)) return settings;
  calibration::scale_camera(settings, width_px);
  const geometry::CameraModel& scaled = settings.rig.camera;
  std::fprintf(stderr,
               "the pictures are %dx%d, which gazed does not take: the calibration is written for "
               "%dx%d, the whole image scaled\n",
               pictures.width_px, pictures.height_px, scaled.width_px, scaled.height_px);
  return settings;
}

int convert(const calibration::CalibrateOptions& options, const settings::Settings& settings) {
  std::fputs(
      "such a file does not tell how sure it is: focal_sigma_px and centre_sigma_px stay what was "
      "believed\n",
      stderr);
  write_toml(options, as_gazed_takes_it(settings, geometry::CameraModel().width_px),
             "Camera taken over by gazelab from " + options.camera_file + ".");
  return exit_done;
}

int calibrate_camera(const calibration::CalibrateOptions& options,
                     const settings::Settings& settings) {
  const calibration::Chessboard board = *calibration::board_of(options);
  const calibration::Intrinsics result = calibration::calibrated_intrinsics(
      board, calibration::read_board_pictures(calibration::pictures_of(options), board,
                                              calibration::window_of(options)));
  std::fputs(calibration::report_of(result).c_str(), stderr);
  const std::string comment =
      base::text("Camera calibrated by gazelab from %zu pictures of a chessboard, %.3f px rms.",
                 result.names.size(), result.rms_px);
  write_toml(options,
             as_gazed_takes_it(calibration::calibrated_settings(settings, result),
                               settings.rig.camera.width_px),
             comment);
  return exit_done;
}

int calibrate_delay(const calibration::CalibrateOptions& options, settings::Settings settings) {
  const calibration::DelayEstimate result = calibration::estimate_delay(
      options.delay_log, settings.lcm.prefix, settings.rig.camera, settings.rig.head);
  std::fputs(calibration::report_of(result).c_str(), stderr);
  // What gazed recorded has the delay of its configuration in the stamps.
  const double in_stamps_s = calibration::recorded_delay_s(options.delay_log, settings.lcm.prefix);
  settings.cycle.camera.delay_s = in_stamps_s + result.delay_s;
  settings.cycle.camera.readout_s = std::max(0.0, result.readout_s);
  std::fprintf(stderr,
               "camera.delay_s = %.4f: gazed adds it where it drives the camera itself; the stamps "
               "of another program are to be shifted by %.4f s\n",
               settings.cycle.camera.delay_s, result.delay_s);
  write_toml(options, settings,
             base::text("Delay and readout measured by gazelab from %zu pairs of frames:\n"
                        "+- %.2f ms and +- %.2f ms.",
                        result.pairs, 1e3 * result.delay_sigma_s, 1e3 * result.readout_sigma_s),
             calibration::Timing::written);
  return exit_done;
}

calibration::HeadCalibration head_calibration(const calibration::CalibrateOptions& options,
                                              const settings::Settings& settings) {
  const calibration::HeadBelief belief = calibration::belief_of(options, settings);
  if (!options.observations.empty()) {
    return calibration::calibrate_on_marks(belief,
                                           calibration::read_marks_csv(options.observations));
  }
  const std::optional<calibration::Chessboard> board = calibration::board_of(options);
  const int window_px = calibration::window_of(options);
  const std::vector<calibration::HeadPicture> pictures =
      calibration::read_head_pictures(options.inputs.front(), settings.rig.camera,
                                      settings.cycle.camera.readout_s, settings.lcm.prefix);
  return board ? calibration::calibrate_on_board(belief, *board, pictures, window_px)
               : calibration::calibrate_on_scene(belief, pictures);
}

int run_calibrate(const calibration::CalibrateOptions& options) {
  calibration::check_inputs(options);
  const settings::Settings settings = calibration::settings_of(options);
  if (!options.delay_log.empty()) return calibrate_delay(options, settings);
  if (calibration::is_conversion(options)) return convert(options, settings);
  if (calibration::is_camera_alone(options)) return calibrate_camera(options, settings);
  const calibration::HeadCalibration result = head_calibration(options, settings);
  std::fputs(calibration::report_of(result).c_str(), stderr);
  const std::string condition = calibration::scale_condition(result);
  write_toml(options, calibration::calibrated_settings(settings, result),
             "Camera and head calibrated by gazelab from " + result.input +
                 base::text(":\n%.3f px rms before, %.3f px after.", result.fit.before.measured_px,
                            result.fit.after.measured_px) +
                 (condition.empty() ? "" : "\nThe numbers hold where measured " + condition + "."),
             calibration::Timing::left_out, condition);
  return exit_done;
}

}  // namespace

Command add_calibrate_command(CLI::App& gazelab) {
  CLI::App* command = gazelab.add_subcommand(
      "calibrate", "Measure a camera and how it sits in the head, for gazed --config.");
  const auto options = std::make_shared<calibration::CalibrateOptions>();
  calibration::add_options(*command, *options);
  return {.options = command, .run = [options] { return run_calibrate(*options); }};
}

}  // namespace gazed::lab
