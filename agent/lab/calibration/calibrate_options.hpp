// The command line of gazelab calibrate, and what each option means.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "agent/lab/calibration/chessboard.hpp"
#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::lab::calibration {

struct CalibrateOptions {
  std::vector<std::string> inputs;
  std::string observations;
  std::string board;
  double square_m = 0.0;
  std::string corner_window = "auto";  // "11"
  std::string config;
  std::string camera_file;  // of another program
  std::string robot;
  std::string axis_offset;
  std::string marks_frame = "own";
  std::string delay_log;  // of a moving head
  std::string out = "-";
};

/// Options and help. `options` must outlive `command`.
void add_options(CLI::App& command, CalibrateOptions& options);

// Each of these throws std::invalid_argument that names the option and what is allowed.
[[nodiscard]] settings::Settings settings_of(const CalibrateOptions& options);
[[nodiscard]] std::optional<Chessboard> board_of(const CalibrateOptions& options);
[[nodiscard]] HeadBelief belief_of(const CalibrateOptions& options,
                                   const settings::Settings& settings);
/// Half the side of the window that refines corners, px; window_by_square unless it is set.
[[nodiscard]] int window_of(const CalibrateOptions& options);

}  // namespace gazed::lab::calibration
