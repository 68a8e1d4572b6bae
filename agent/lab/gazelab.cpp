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

namespace {

/// The allowed words after a message about a wrong one.
std::string allowed_words(const CLI::App& app) {
  const CLI::App* place = &app;
  if (!app.get_subcommands().empty()) place = app.get_subcommands().front();
  std::string words;
  for (const CLI::Option* option : place->get_options()) words += " " + option->get_name();
  for (const CLI::App* command : place->get_subcommands({})) words += " " + command->get_name();
  return "allowed:" + words + "\nsee " + (place == &app ? "" : "gazelab ") + place->get_name() +
         " --help\n";
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
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    return "gazelab: " + std::string(error.what()) + "\n" + allowed_words(*failed);
  });
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
    throw CLI::RequiredError("A command");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? gazed::lab::exit_done : gazed::lab::exit_bad_arguments;
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
