// gazelab explain: how the answer of a recorded fixation came about, as a page for people.
#include <CLI/App.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/commands.hpp"
#include "agent/lab/explain/page.hpp"
#include "agent/lab/explain/replay.hpp"
#include "agent/lab/explain/words.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/settings/options.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

struct ExplainOptions {
  std::string log;
  int fixation = 0;  // from 1; 0: the last one
  fs::path out = "explained";
  std::string robot;
  std::string config;
  std::vector<std::string> sets;  // KEY=VALUE
};

settings::SettingsLayers layers_of(const ExplainOptions& options) {
  settings::SettingsLayers layers;
  if (!options.config.empty()) layers.file = options.config;
  if (!options.robot.empty()) layers.command_line.push_back({"robot", options.robot, "--robot"});
  for (const std::string& set : options.sets)
    layers.command_line.push_back(settings::set_assignment(set));
  return layers;
}

/// The fixation that is asked for, and a line for each of the recording.
struct Found {
  std::optional<explain::ReplayedFixation> wanted;
  std::vector<std::string> lines;
};

Found find(explain::Replay& replay, int number) {
  Found found;
  while (auto replayed = replay.next()) {
    found.lines.push_back(explain::summary_line(replayed->fixation));
    if (number == 0 || replayed->fixation.number == number) found.wanted = std::move(replayed);
  }
  return found;
}

int run_explain(const ExplainOptions& options) {
  const settings::Settings settings = explain::settings_of(options.log, layers_of(options));
  explain::Replay replay(settings, options.log);
  const Found found = find(replay, options.fixation);
  const std::string notes = replay.notes();
  if (!notes.empty()) std::fprintf(stderr, "gazelab: %s\n", notes.c_str());
  for (const std::string& line : found.lines) std::printf("%s\n", line.c_str());
  if (!found.wanted) {
    throw std::invalid_argument(found.lines.empty()
                                    ? options.log + ": no fixation comes of this recording"
                                    : base::text("--fixation: %d found; allowed: 1 to %zu",
                                                 options.fixation, found.lines.size()));
  }
  io::make_folder(options.out);
  const explain::Explained explained =
      explain::write_page(*found.wanted, settings, options.log, found.lines, options.out);
  std::printf("%s\n", explained.page.c_str());
  if (explained.complaint.empty()) return exit_done;
  std::fprintf(stderr, "gazelab: %s\n", explained.complaint.c_str());
  return exit_fault;
}

constexpr const char* explain_footer = R"(
Replays WALK.lcm through the code of gazed and explains one of its fixations, located or not, on a
page that any browser shows without a network: the looks with everything that was found in them, both
saliency maps of each, the patch, the interval of the range, a table of the looks, what each source of
error costs, the answer of the 2011 report's own steps, whether the epipoles coincide, and what is
believed of the robot.

  DIR/fixation-N.html           the page; it needs no other file
  DIR/fixation-N-look-K.png, -map-K.png, -patches.png, -range.png, -range.svg, -costs.png, -costs.svg
                                what it shows, for a talk or a paper; -*.gp are gnuplot's scripts

A recording of `gazed --record` has its robot and configuration in it. For one of `gazelab log`, or of
lcm-logger, say --robot, and --config or --set as to gazed. With other settings than those of the
recording the fixations may come out otherwise: that is how to find out what a key would have done.

Exit: 0 done, 1 a chart (gnuplot is needed) or a file could not be made, 2 bad arguments.

Examples:
  gazed --fixations 2 --record walk.lcm
  gazelab explain walk.lcm
  gazelab explain walk.lcm --fixation 1 --out first
  gazelab explain walk.lcm --set uncertainty.encoder_sigma_rad=0.005 --out coarse_encoders
)";

}  // namespace

Command add_explain_command(CLI::App& gazelab) {
  CLI::App* command = gazelab.add_subcommand(
      "explain", "Show on a page how the answer of a recorded fixation came about.");
  const auto options = std::make_shared<ExplainOptions>();
  command->add_option("WALK.lcm", options->log, "a recording of gazed, gazelab log or lcm-logger")
      ->required()
      ->type_name("");
  command->add_option("--fixation", options->fixation, "which one, from 1 (default: the last)")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  command->add_option("--out", options->out, "write into this folder")
      ->type_name("DIR")
      ->default_str("explained");
  command
      ->add_option("--robot", options->robot,
                   "which NAO, where the recording does not say so: nao-v3 to nao-v6")
      ->type_name("NAME");
  command->add_option("--config", options->config, "keys and values, as for gazed")
      ->type_name("FILE.toml");
  command->add_option("--set", options->sets, "any key, as for gazed; once for each")
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("KEY=VALUE");
  command->footer(explain_footer);
  return {.options = command, .run = [options] { return run_explain(*options); }};
}

}  // namespace gazed::lab
