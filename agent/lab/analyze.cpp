// gazelab analyze: the report's error analysis of the reconstruction methods, anew.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/analysis/gnuplot.hpp"
#include "agent/lab/analysis/monte_carlo.hpp"
#include "agent/lab/analysis/plots.hpp"
#include "agent/lab/analysis/sources.hpp"
#include "agent/lab/analysis/sweep.hpp"
#include "agent/lab/analysis/tables.hpp"
#include "agent/lab/commands.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/progress.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t table_samples = 10000;         // as the report
constexpr std::size_t sweep_samples = 401;           // 0 is among them
constexpr std::uint64_t greatest_seed = 4294967295;  // more than anybody tries

struct AnalyzeOptions {
  std::string what;
  std::size_t samples = 0;  // 0: what fits
  std::uint64_t seed = 1;
  fs::path out = "analysis";
  std::vector<std::string> geometries;
  std::string draws = "both";
};

std::vector<analysis::TwoViewSetup> chosen_setups(const std::vector<std::string>& geometries) {
  std::vector<analysis::TwoViewSetup> setups = analysis::all_setups();
  if (!geometries.empty()) {
    std::erase_if(setups, [&](const analysis::TwoViewSetup& setup) {
      return std::ranges::find(geometries, setup.name) == geometries.end();
    });
  }
  return setups;
}

/// Draws what can be drawn, and says which files there are.
int draw(const fs::path& folder, const std::string& stem, const std::string& figures) {
  const std::string script = stem + ".gp";
  const std::string files = (folder / (stem + ".csv")).string() + ", " + script;
  switch (analysis::run_gnuplot(folder, script)) {
    case analysis::Gnuplot::drawn:
      std::fprintf(stderr, "%s, %s\n", files.c_str(), figures.c_str());
      return exit_done;
    case analysis::Gnuplot::not_installed:
      std::fprintf(stderr,
                   "gazelab: %s, but no figures: gnuplot is not installed. Install it (Debian: "
                   "apt-get install gnuplot-nox), then: cd %s && gnuplot %s\n",
                   files.c_str(), folder.c_str(), script.c_str());
      break;
    case analysis::Gnuplot::failed:
      std::fprintf(stderr, "gazelab: %s, but no figures: gnuplot %s failed\n", files.c_str(),
                   script.c_str());
      break;
  }
  return exit_fault;
}

int make_table(const AnalyzeOptions& options) {
  const std::vector<analysis::TwoViewSetup> setups = chosen_setups(options.geometries);
  const analysis::MonteCarlo monte_carlo{
      .samples = options.samples == 0 ? table_samples : options.samples, .seed = options.seed};
  std::vector<analysis::Draws> kinds(analysis::all_draws.begin(), analysis::all_draws.end());
  std::erase_if(kinds, [&](analysis::Draws draws) {
    return options.draws != "both" && options.draws != analysis::name(draws);
  });
  io::Progress progress(setups.size() * kinds.size() * analysis::all_parameters.size() *
                        analysis::scene_points_m().size());
  std::size_t done = 0;
  std::vector<analysis::TableRow> all_rows;
  std::string tables;
  for (const analysis::TwoViewSetup& setup : setups) {
    for (const analysis::Draws draws : kinds) {
      const auto rows =
          analysis::analyse(setup, draws, monte_carlo, [&] { progress.show(++done); });
      tables += analysis::table_text(rows, monte_carlo);
      all_rows.insert(all_rows.end(), rows.begin(), rows.end());
    }
  }
  progress.clear();
  io::write_text_file(options.out / "table.csv", analysis::table_csv(all_rows));
  // Uniform draws are the report's.
  io::write_text_file(options.out / "table.gp", analysis::table_script(setups, kinds.front()));
  std::fputs(tables.c_str(), stdout);
  return draw(options.out, "table", "table.svg");
}

int make_sweep(const AnalyzeOptions& options) {
  const std::vector<analysis::TwoViewSetup> setups = chosen_setups(options.geometries);
  const std::size_t samples = options.samples == 0 ? sweep_samples : options.samples;
  io::Progress progress(setups.size() * analysis::all_parameters.size());
  std::size_t done = 0;
  std::vector<analysis::SweepRow> rows;
  std::string figures;
  for (const analysis::TwoViewSetup& setup : setups) {
    const auto more = analysis::sweep(setup, samples, [&] { progress.show(++done); });
    rows.insert(rows.end(), more.begin(), more.end());
    figures += (figures.empty() ? "" : ", ") + analysis::sweep_figure(setup);
  }
  progress.clear();
  io::write_text_file(options.out / "sweep.csv", analysis::sweep_csv(rows));
  io::write_text_file(options.out / "sweep.gp", analysis::sweep_script(setups));
  return draw(options.out, "sweep", figures);
}

int make_sources(const AnalyzeOptions& options) {
  const std::vector<analysis::SourceRow> rows = analysis::nao_sources();
  io::write_text_file(options.out / "sources.csv", analysis::sources_csv(rows));
  std::fputs(analysis::sources_text(rows).c_str(), stdout);
  return exit_done;
}

/// Throws std::invalid_argument for an option that WHAT would not follow.
void check_options(const CLI::App& command, const std::string& what) {
  const auto refuse = [&](const char* option) {
    if (command.count(option) == 0) return;
    throw std::invalid_argument(std::string(option) + " is not for " + what);
  };
  if (what == "table") return;
  refuse("--seed");
  refuse("--draws");
  if (what == "sweep") return;
  refuse("--samples");
  refuse("--geometry");
}

int run_analyze(const CLI::App& command, const AnalyzeOptions& options) {
  check_options(command, options.what);
  io::make_folder(options.out);
  if (options.what == "sources") return make_sources(options);
  return options.what == "table" ? make_table(options) : make_sweep(options);
}

constexpr const char* analyze_footer = R"(
Chapter 3.4 of the report that gazed is built on (Russcher 2011) compares three reconstruction
methods: five points, two looks, and one parameter at a time that is wrong while the images are
exact. The parameters: focal length, image centre, rotation, translation, image points.

  table  table 3.3, by random errors (Monte Carlo): table.csv, table.svg; the table itself to
         standard output. For each parameter, point and method:
           systematic_mm, random_mm, rms_mm   mean and standard deviation of the error vector and
                            both together, as the report defines them. Where the disparity may pass
                            0 the last two do not exist: they grow with the number of samples
           median_mm        median length of the error vector
           half_width_68_mm half of the interval that holds the middle 68 % of the ranges; inf when
                            that reaches infinity
           failures         share without an answer or behind a camera
           over_20_percent  share of failures and of ranges that are over 20 % wrong
         point "worst" has the greatest of the five points in each column.
  sweep  figure 3.1: the parameter goes from -2 to 2 sigma, all its elements together; the error is
         the mean of the five points: sweep.csv, sweep-GEOMETRY.svg (five plots). Its last column
         names the points that the gate would let pass, knowing all the sigmas
  sources  what each error that the profile of a NAO V6 names does to a range, as
         gazed propagates it, in % at three points: sources.csv, and to standard output

Methods: optimal, rectification, linear-mmse, and replica, which is none. The report's optimal column
is smaller than any method can be. Numbers of its size come out when the wrong parameters only
correct the image points and the TRUE projection matrices then triangulate them: that is replica.

Geometries, sigmas as in the report's table 3.2 or the robot's profile:
  report      R = Ry(-0.5) Rx(0.5), t = [28 29 -24] mm; both angles wrong
  report-yaw  R = Ry(0.5) Rx(-0.5), the same t; the yaw alone wrong
  nao-v6      the head of a NAO V6 from (yaw, pitch) (0, 0) to (-0.35, 0.1) rad, through its chain

The same options give the same files, byte for byte. Figures are drawn by gnuplot (Debian:
gnuplot-nox); without it the CSV and a .gp script are still written.

Exit: 0 done, 1 a file or figure could not be made (the others are), 2 bad arguments.

Examples:
  gazelab analyze table
  gazelab analyze table --geometry report --draws uniform --samples 100000 --out large
  gazelab analyze sweep --geometry nao-v6
)";

std::vector<std::string> geometry_names() {
  std::vector<std::string> names;
  for (const analysis::TwoViewSetup& setup : analysis::all_setups()) names.push_back(setup.name);
  return names;
}

}  // namespace

Command add_analyze_command(CLI::App& gazelab) {
  CLI::App* command = gazelab.add_subcommand(
      "analyze", "Compare the reconstruction methods as the report did: table 3.3 and figure 3.1.");
  const auto options = std::make_shared<AnalyzeOptions>();
  command->add_option("WHAT", options->what, "table, sweep or sources")
      ->required()
      ->check(CLI::IsMember({"table", "sweep", "sources"}))
      ->type_name("");
  command
      ->add_option("--samples", options->samples,
                   "of each parameter (default: 10000 for the table, 401 for the sweep)")
      ->check(CLI::Range(std::size_t{2}, std::size_t{1000000}))
      ->type_name("N");
  command->add_option("--seed", options->seed, "of the random errors of the table")
      ->check(CLI::Range(std::uint64_t{0}, greatest_seed))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--out", options->out, "write into this folder")
      ->type_name("DIR")
      ->default_str("analysis");
  command->add_option("--geometry", options->geometries, "only these (default: all)")
      ->check(CLI::IsMember(geometry_names()))
      ->delimiter(',')
      ->type_name("NAME,...");
  command->add_option("--draws", options->draws, "of the table: uniform, gaussian or both")
      ->check(CLI::IsMember({"uniform", "gaussian", "both"}))
      ->type_name("NAME")
      ->capture_default_str();
  command->footer(analyze_footer);
  return {.options = command,
          .run = [command, options] { return run_analyze(*command, *options); }};
}

}  // namespace gazed::lab
