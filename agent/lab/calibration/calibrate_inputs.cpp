#include "agent/lab/calibration/calibrate_inputs.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/camera_file.hpp"
#include "agent/lab/calibration/head_pictures.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/picture_files.hpp"

namespace gazed::lab::calibration {

namespace {

/// An option that the input has no use for is a mistake, of the option or of the input.
[[noreturn]] void refuse_with_marks(const std::string& option) {
  throw std::invalid_argument("both --observations and " + option +
                              "; allowed: one of them, marks have no chessboard");
}

void check_board_options(const CalibrateOptions& options) {
  const bool marks = !options.observations.empty();
  if (marks && !options.board.empty()) refuse_with_marks("--board");
  if (marks && options.square_m != 0.0) refuse_with_marks("--square");
  const bool window_set = options.corner_window != "auto";
  if (marks && window_set) refuse_with_marks("--corner-window");
  if (window_set && options.board.empty()) {
    throw std::invalid_argument(
        "--corner-window without --board; allowed: both, corners are those of a chessboard");
  }
}

/// Text in a file that is called a picture or a log is a slip of the hand.
void check_ending(const std::filesystem::path& out) {
  constexpr auto others = std::to_array<std::string_view>({".csv", ".lcm", ".json", ".html"});
  const std::string ending = out.extension().string();
  if (!io::is_picture_name(out) && std::ranges::find(others, ending) == others.end()) return;
  throw std::invalid_argument("--out: '" + base::excerpt(out.string()) +
                              "' found; allowed: FILE.toml for gazed, FILE.yaml as ROS has it, "
                              "FILE.xml as OpenCV has it, or -");
}

/// Whether there is anything to calibrate from at all.
void check_input(const std::filesystem::path& input) {
  if (!std::filesystem::exists(input)) {
    throw std::runtime_error(input.string() + ": cannot be opened: No such file or directory");
  }
  if (std::filesystem::is_directory(input) && !std::filesystem::exists(input / "frames.csv") &&
      io::pictures_in(input).empty()) {
    throw std::invalid_argument(input.string() +
                                ": holds no pictures; needed: a folder of pictures of a "
                                "chessboard, or of pictures and frames.csv");
  }
}

void check_out(const CalibrateOptions& options) {
  if (options.out == "-") return;
  std::vector<std::string> inputs = options.inputs;
  for (const std::string& file :
       {options.observations, options.config, options.camera_file, options.delay_log}) {
    if (!file.empty()) inputs.push_back(file);
  }
  io::check_output_file(options.out, inputs);
  check_ending(options.out);
  const bool tells_of_head =
      !options.observations.empty() || std::ranges::any_of(options.inputs, has_head_angles);
  if (tells_of_head && camera_format_of(options.out)) {
    throw std::invalid_argument(
        "--out: '" + base::excerpt(options.out) +
        "' found; allowed with head angles: .toml, the others have no head");
  }
}

}  // namespace

void check_inputs(const CalibrateOptions& options) {
  check_out(options);
  if (!options.delay_log.empty()) {
    if (options.inputs.empty() && options.observations.empty() && options.board.empty()) return;
    throw std::invalid_argument(
        "both --delay and something else to calibrate from; allowed: one of them");
  }
  if (is_conversion(options)) return;
  const bool marks = !options.observations.empty();
  if (marks && !options.inputs.empty()) {
    throw std::invalid_argument("both --observations and the input " + options.inputs.front() +
                                "; allowed: one of them");
  }
  if (!marks && options.inputs.empty()) {
    throw std::invalid_argument(
        "nothing to calibrate from; allowed: pictures of a chessboard or a folder of them, a "
        "folder with frames.csv, an LCM log, or --observations CSV");
  }
  check_board_options(options);
  // Of many inputs one that holds nothing is named and left out.
  if (options.inputs.size() == 1 && std::filesystem::is_directory(options.inputs.front())) {
    check_input(options.inputs.front());
  }
  const bool angles = std::ranges::any_of(options.inputs, has_head_angles);
  if (angles && options.inputs.size() > 1) {
    throw std::invalid_argument(
        base::text("%zu inputs, one of them with head angles; allowed: one "
                   "folder, frames.csv or LCM log alone, or pictures only",
                   options.inputs.size()));
  }
  if (!marks && !angles && options.board.empty()) {
    // It may be none at all.
    if (!io::is_picture_name(options.inputs.front())) check_input(options.inputs.front());
    throw std::invalid_argument(options.inputs.front() +
                                ": pictures without head angles need the chessboard's --board "
                                "COLUMNSxROWS and --square METRES");
  }
}

bool is_conversion(const CalibrateOptions& options) {
  return options.inputs.empty() && options.observations.empty() && !options.camera_file.empty();
}

bool is_camera_alone(const CalibrateOptions& options) {
  return options.observations.empty() && !has_head_angles(options.inputs.front());
}

std::vector<std::string> pictures_of(const CalibrateOptions& options) {
  std::vector<std::string> files;
  for (const std::string& input : options.inputs) {
    if (!std::filesystem::is_directory(input)) {
      files.push_back(input);
      continue;
    }
    check_input(input);
    const std::vector<std::string> inside = io::pictures_in(input);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

}  // namespace gazed::lab::calibration
