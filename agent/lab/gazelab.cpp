// gazelab: gazed's algorithms on files, for the workstation.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "agent/lab/commands.hpp"
#include "agent/settings/help_formatter.hpp"
#include "agent/settings/option_words.hpp"

namespace {

std::string refusal(const CLI::App& app, const CLI::ParseError& error) {
  const bool has_command = !app.get_subcommands().empty();
  const CLI::App& place = has_command ? *app.get_subcommands().front() : app;
  const std::string help = (has_command ? "gazelab " : "") + place.get_name() + " --help";
  return gazed::settings::in_words(place, error, help);
}

/// The exit code.
int run(int argc, char** argv) {
  CLI::App app(
      "gazelab runs gazed's algorithms on files: the saliency of photographs, the points that two\n"
      "cameras saw, the errors of such points, logs that gazed replays, the calibration of a "
      "head, and pages\nthat show how a recorded answer came about.",
      "gazelab");
  app.require_subcommand(0, 1);
  // Before the commands, which take both from here.
  app.formatter(std::make_shared<gazed::settings::HelpFormatter>());
  app.set_help_flag("-h,--help", gazed::settings::help_description);
  app.set_version_flag("--version", "gazelab " GAZED_VERSION, gazed::settings::version_description);
  app.footer("gazelab COMMAND --help has each command's options, files and examples.");
  const std::array commands = {
      gazed::lab::add_saliency_command(app),  gazed::lab::add_triangulate_command(app),
      gazed::lab::add_analyze_command(app),   gazed::lab::add_log_command(app),
      gazed::lab::add_calibrate_command(app), gazed::lab::add_explain_command(app)};
  for (const gazed::lab::Command& command : commands) command.options->group("Commands");
  try {
    app.parse(argc, argv);
    for (const gazed::lab::Command& command : commands) {
      if (command.options->parsed()) return command.run();
    }
    throw std::invalid_argument("no command found; gazelab --help lists them");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      app.exit(error);
      return gazed::lab::exit_done;
    }
    throw std::invalid_argument(refusal(app, error));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  return run(argc, argv);
} catch (const std::invalid_argument& error) {
  std::fprintf(stderr, "gazelab: %s\n", error.what());
  return gazed::lab::exit_bad_arguments;
} catch (const std::exception& error) {
  std::fprintf(stderr, "gazelab: %s\n", error.what());
  return gazed::lab::exit_fault;
}
