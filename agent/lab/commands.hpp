// gazelab's subcommands. Each adds itself with its options to the command line.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace gazed::lab {

constexpr int exit_done = 0;
constexpr int exit_fault = 1;          // a file could not be read or written; the rest was done
constexpr int exit_bad_arguments = 2;  // nothing was done

struct Command {
  CLI::App* options;  // owned by the command line it was added to
  /// After the options were read; returns the exit code. Throws std::invalid_argument for bad
  /// arguments, another std::exception for a fault: gazelab's main says them and ends with their
  /// codes.
  std::function<int()> run;
};

[[nodiscard]] Command add_saliency_command(CLI::App& gazelab);
[[nodiscard]] Command add_triangulate_command(CLI::App& gazelab);
[[nodiscard]] Command add_analyze_command(CLI::App& gazelab);
[[nodiscard]] Command add_log_command(CLI::App& gazelab);
[[nodiscard]] Command add_calibrate_command(CLI::App& gazelab);
[[nodiscard]] Command add_explain_command(CLI::App& gazelab);

}  // namespace gazed::lab
