// gazed_accuracy: closed-loop fixations on the simulated robot as CSV, one line each; the script
// `accuracy` beside it starts it, adds up and judges.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "agent/daemon/wiring.hpp"

#include "tests/benchmarks/accuracy_rows.hpp"
#include "tests/benchmarks/closed_loop.hpp"

namespace gazed::benchmarks {
namespace {

constexpr const char* usage =
    "gazed_accuracy rows                            the names of all rows\n"
    "gazed_accuracy ROW FIRST COUNT                 COUNT trials of a row, from number FIRST\n"
    "gazed_accuracy SCENE.toml FIRST COUNT [LOOKS]  as many robots with seeds from FIRST, each\n"
    "                                               through all tests of the scene\n"
    "gazed_accuracy picture ROW NUMBER              a trial's first frame, as PPM (P6)\n";

constexpr const char* header =
    "row,trial,test,layout,looks_wanted,encoder_sigma_rad,target_range_m,elevation_rad,status,"
    "looks,"
    "range_m,range_sigma_m,inverse_range_per_m,inverse_range_sigma_per_m,true_range_m,on_target,"
    "bearing_error_rad,parallax_rad,residual_px,x1_px,y1_px,x2_px,y2_px,duration_s,cycle_ms,"
    "locate_ms,reason\n";

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return '"' + text + '"';
}

/// What was asked for, and what came of it.
void print(std::string_view row, std::uint64_t number, std::size_t test, const Trial& trial,
           const JudgedFixation& judged) {
  const cycle::Fixation& fixation = judged.fixation;
  const triangulation::PointEstimate& estimate = fixation.estimate;
  std::printf("%.*s,%llu,%zu,%.*s,%d,%.4f,%.4f,%.4f,", static_cast<int>(row.size()), row.data(),
              static_cast<unsigned long long>(number), test, static_cast<int>(trial.layout.size()),
              trial.layout.data(), trial.settings.cycle.locate.looks,
              trial.settings.rig.uncertainty.encoder_sigma_rad, trial.range_m, trial.elevation_rad);
  const std::string_view status = cycle::name(fixation.status);
  std::printf("%.*s,%d,%.6f,%.6f,%.6f,%.6f,%.6f,%d,%.6f,%.6f,%.3f,",
              static_cast<int>(status.size()), status.data(), fixation.views, estimate.range_m,
              estimate.range_sigma_m, estimate.inverse_range_per_m,
              estimate.inverse_range_sigma_per_m,
              judged.truth ? judged.truth->range_m : triangulation::not_a_number,
              judged.truth && judged.truth->target ? 1 : 0, judged.bearing_error_rad,
              estimate.parallax_rad, estimate.residual_px);
  std::printf("%.2f,%.2f,%.2f,%.2f,%.3f,%.2f,%.2f,%s\n", fixation.pixel_1.x(), fixation.pixel_1.y(),
              fixation.pixel_2.x(), fixation.pixel_2.y(), fixation.duration_s, judged.cycle_ms,
              judged.locate_ms, quoted(fixation.reason).c_str());
}

void run_row(const Row& row, std::uint64_t first, std::uint64_t count) {
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  for (std::uint64_t number = first; number < first + count; ++number) {
    const Trial trial = draw_trial(row, number);
    ClosedLoop loop(trial.scene, profile, trial.settings.rig, trial.settings.cycle, trial.seed);
    print(row.name, number, 0, trial, loop.next());
  }
}

void run_scene(const std::string& file, std::uint64_t first, std::uint64_t count, int looks) {
  Trial trial;
  trial.layout = "scene";
  trial.scene = sim::load_scene(file);
  settings::SettingsLayers layers;
  layers.command_line.push_back({"sim.scene", file, "command line"});
  trial.settings = settings::load_settings(layers, daemon::scene_uncertainty);
  // As with a real camera, the agent knows the shutter from the robot's profile.
  if (trial.scene.camera.readout_s > 0.0)
    trial.settings.cycle.camera.readout_s =
        geometry::robot_profile(trial.settings.robot)->readout_s;
  trial.settings.cycle.locate.looks = trial.settings.cycle.locate.looks_min = looks;
  trial.settings.cycle.locate.plan = looks > 2 ? gaze::Plan::parallax : gaze::Plan::report;
  for (std::uint64_t number = first; number < first + count; ++number) {
    ClosedLoop loop(trial.scene, *geometry::robot_profile(trial.settings.robot), trial.settings.rig,
                    trial.settings.cycle, number);
    for (std::size_t test = 0; test < sim::test_count(trial.scene); ++test)
      print("scene", number, test, trial, loop.next());
  }
}

void print_picture(const Row& row, std::uint64_t number) {
  Trial trial = draw_trial(row, number);
  trial.scene.camera.format = base::PixelFormat::rgb24;
  sim::SimRobot robot(trial.scene, *geometry::robot_profile("nao-v6"), trial.seed, 0);
  const base::ImageView image = robot.next_frame()->image;
  std::printf("P6 %d %d 255\n", image.width_px, image.height_px);
  for (int y = 0; y < image.height_px; ++y)
    std::fwrite(image.row(y), 3, static_cast<std::size_t>(image.width_px), stdout);
}

std::uint64_t number_from(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::invalid_argument("'" + std::string(text) + "' found; allowed: a number");
  return number;
}

const Row& row_named(std::string_view name) {
  const auto rows = accuracy_rows();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == name; });
  if (row == rows.end()) throw std::invalid_argument(usage);
  return *row;
}

int run(std::span<char*> arguments) {
  if (arguments.size() == 2 && std::strcmp(arguments[1], "rows") == 0) {
    for (const Row& row : accuracy_rows()) std::printf("%s\n", std::string(row.name).c_str());
    return 0;
  }
  if (arguments.size() < 4 || arguments.size() > 5) throw std::invalid_argument(usage);
  const std::string what = arguments[1];
  if (what == "picture") {
    print_picture(row_named(arguments[2]), number_from(arguments[3]));
    return 0;
  }
  const std::uint64_t first = number_from(arguments[2]), count = number_from(arguments[3]);
  const bool is_scene = what.ends_with(".toml");
  if (!is_scene && arguments.size() == 5) throw std::invalid_argument(usage);
  std::fputs(header, stdout);
  if (is_scene)
    run_scene(what, first, count,
              arguments.size() == 5 ? static_cast<int>(number_from(arguments[4])) : 2);
  else
    run_row(row_named(what), first, count);
  return 0;
}

}  // namespace
}  // namespace gazed::benchmarks

int main(int argc, char** argv) {
  try {
    return gazed::benchmarks::run(std::span(argv, static_cast<std::size_t>(argc)));
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gazed_accuracy: %s\n", error.what());
    return 1;
  }
}
