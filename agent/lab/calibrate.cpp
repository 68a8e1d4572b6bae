// gazelab calibrate: the camera, and how it sits in the head.
#include <CLI/App.hpp>
#include <cstdio>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/calibrate_options.hpp"
#include "agent/lab/calibration/calibration_report.hpp"
#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/lab/commands.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/lab/io/progress.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::lab {

namespace {

struct BoardPictures {
  std::vector<std::vector<geometry::Pixel>> corners;
  std::vector<std::string> names;  // of those with corners
  cv::Size size;
};

BoardPictures read_board_pictures(const calibration::CalibrateOptions& options,
                                  const calibration::Chessboard& board) {
  const std::vector<std::string>& files = options.inputs;
  const int window_px = calibration::window_of(options, calibration::usual_window_px);
  BoardPictures result;
  io::Progress progress(files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    cv::Mat grey;
    cv::cvtColor(io::read_picture(files[i]), grey, cv::COLOR_BGR2GRAY);
    if (i == 0) result.size = grey.size();
    if (grey.size() != result.size) {
      throw std::runtime_error(base::text("%s: is %dx%d, the first picture is %dx%d",
                                          files[i].c_str(), grey.cols, grey.rows, result.size.width,
                                          result.size.height));
    }
    std::vector<geometry::Pixel> corners = calibration::find_corners(grey, board, window_px);
    progress.show(i + 1);
    if (corners.empty()) {
      progress.clear();
      std::fprintf(stderr, "not used: %s: not all %dx%d inner corners of the board are found\n",
                   files[i].c_str(), board.columns, board.rows);
      continue;
    }
    result.corners.push_back(std::move(corners));
    result.names.push_back(files[i]);
  }
  return result;
}

void write_toml(const calibration::CalibrateOptions& options, const std::string& toml) {
  if (options.out != "-") {
    io::write_text_file(options.out, toml);
    std::fprintf(stderr, "\n%s: ready for gazed --config\n", options.out.c_str());
  } else if (std::fputs(toml.c_str(), stdout) < 0 || std::fflush(stdout) != 0) {
    throw std::runtime_error("standard output: cannot be written");
  }
}

int calibrate_camera(const calibration::CalibrateOptions& options,
                     const settings::Settings& settings) {
  const calibration::Chessboard board = *calibration::board_of(options);
  const BoardPictures pictures = read_board_pictures(options, board);
  const calibration::Intrinsics result =
      calibration::calibrated_intrinsics(board, pictures.corners, pictures.size);
  std::fputs(calibration::report_of(result, pictures.names).c_str(), stderr);
  write_toml(options, calibration::calibration_toml(
                          calibration::calibrated_settings(settings, result),
                          base::text("Camera calibrated by gazelab from %zu pictures of a "
                                     "chessboard, %.3f px rms.",
                                     pictures.names.size(), result.rms_px)));
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
  const int window_px = calibration::window_of(options, calibration::window_by_square);
  const std::vector<calibration::HeadPicture> pictures =
      calibration::read_head_pictures(options.inputs.front(), settings.camera.model,
                                      settings.camera.readout_s, settings.lcm.prefix);
  return board ? calibration::calibrate_on_board(belief, *board, pictures, window_px)
               : calibration::calibrate_on_scene(belief, pictures);
}

int run_calibrate(const calibration::CalibrateOptions& options) {
  calibration::check_inputs(options);
  const settings::Settings settings = calibration::settings_of(options);
  const bool camera_only =
      options.observations.empty() && !calibration::has_head_angles(options.inputs.front());
  if (camera_only) return calibrate_camera(options, settings);
  const calibration::HeadCalibration result = head_calibration(options, settings);
  std::fputs(calibration::report_of(result).c_str(), stderr);
  write_toml(options,
             calibration::calibration_toml(
                 calibration::calibrated_settings(settings, result),
                 "Camera and head calibrated by gazelab from " + result.input +
                     base::text(":\n%.3f px rms before, %.3f px after.",
                                result.fit.before.measured_px, result.fit.after.measured_px)));
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
