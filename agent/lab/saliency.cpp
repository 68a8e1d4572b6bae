// gazelab saliency: the most salient place of each picture.
#include "agent/saliency/saliency.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "agent/lab/commands.hpp"
#include "agent/lab/findings.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/lab/io/progress.hpp"
#include "agent/lab/overlay.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

struct SaliencyOptions {
  std::vector<std::string> images;
  std::string profile{
      saliency::profile_names[static_cast<std::size_t>(saliency::SaliencySettings().profile)]};
  std::string csv;
  fs::path maps;
  fs::path overlays;
};

/// Of one of saliency::profile_names.
saliency::SaliencyProfile profile_of(std::string_view name) {
  const auto found = std::ranges::find(saliency::profile_names, name);
  return static_cast<saliency::SaliencyProfile>(found - saliency::profile_names.begin());
}

/// Looks at pictures of any size; keeps the working state while the size stays the same.
class AnySizeSaliency {
 public:
  explicit AnySizeSaliency(const saliency::SaliencySettings& settings) : settings_(settings) {}

  saliency::SaliencyResult examine(const cv::Mat& working_bgr) {
    if (!saliency_ || working_bgr.size() != size_) {
      saliency_.emplace(settings_, working_bgr.cols, working_bgr.rows);
      size_ = working_bgr.size();
    }
    return saliency_->examine(io::view_of(io::rgb_of(working_bgr)));
  }

 private:
  saliency::SaliencySettings settings_;
  cv::Size size_;
  std::optional<saliency::Saliency> saliency_;
};

std::string size_text(const cv::Mat& picture) {
  return std::to_string(picture.cols) + "x" + std::to_string(picture.rows);
}

Finding find_salient(const std::string& image, const SaliencyOptions& options,
                     const saliency::SaliencySettings& settings, AnySizeSaliency& saliency_stage) {
  const cv::Mat picture = io::read_picture(image);
  const double scale = io::working_scale(picture);
  const cv::Mat working = io::scaled(picture, scale);
  const saliency::SaliencyResult result = [&] {
    try {
      return saliency_stage.examine(working);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(image + ": " + size_text(picture) + ", scaled to " +
                               size_text(working) + ": " + error.what());
    }
  }();
  const Finding finding{.image = image,
                        .winner_px = io::input_pixel(result.peak_px, scale),
                        .saliency = result.saliency,
                        .distinctness = result.distinctness};
  if (!options.maps.empty())
    io::write_map(io::output_file(options.maps, image, ".pgm"), result.map);
  if (!options.overlays.empty()) {
    io::write_png(io::output_file(options.overlays, image, ".png"),
                  overlay_of(picture, result.map, scale,
                             {.winner_px = finding.winner_px,
                              .saliency = finding.saliency,
                              .distinctness = finding.distinctness,
                              .distinctness_min = settings.distinctness_min}));
  }
  return finding;
}

int run_saliency(const SaliencyOptions& options) {
  saliency::SaliencySettings settings;
  settings.profile = profile_of(options.profile);
  io::check_output_folder(options.maps, ".pgm", options.images);
  io::check_output_folder(options.overlays, ".png", options.images);
  if (options.csv != "-") io::check_output_file(options.csv, options.images);
  io::make_folder(options.maps);
  io::make_folder(options.overlays);
  FindingsWriter writer(options.csv, options.images, settings.distinctness_min);
  AnySizeSaliency saliency_stage(settings);
  io::Progress progress(options.images.size());
  int exit_code = exit_done;
  const auto complain = [&](const std::exception& error) {
    progress.clear();
    std::fprintf(stderr, "gazelab: %s\n", error.what());
    exit_code = exit_fault;
  };
  for (std::size_t i = 0; i < options.images.size(); ++i) {
    try {
      writer.add(find_salient(options.images[i], options, settings, saliency_stage));
    } catch (const std::exception& error) {
      complain(error);
    }
    if (!writer.to_terminal()) progress.show(i + 1);  // there the rows are progress enough
  }
  try {
    writer.finish();
  } catch (const std::exception& error) {
    complain(error);
  }
  return exit_code;
}

constexpr const char* saliency_footer = R"(
Each picture is scaled by one factor s so that its longer side is 640 (area average when it shrinks,
bilinear when it grows), as the robot's camera would give it. Colour, grey, 8 and 16 bit; transparency
is dropped; the orientation noted by a camera is applied. The map needs at least 160x120 after
scaling, so a picture that is much longer than wide is refused.

  CSV       image,x_px,y_px,saliency,distinctness
            x_px, y_px: the winner in the picture's own pixels, (0,0) the centre of the top left one.
            Without --csv: columns to a terminal, CSV to a pipe or file.
  maps      NAME.pgm: 16 bit, one sample for 16x16 pixels of the scaled picture, its maximum at 65535
  overlays  NAME.png: heat map, ring and cross on the winner, caption; the picture's own size

Exit: 0 done, 1 a picture could not be read or a file not written (the others are done),
2 bad arguments (nothing is done).

Examples:
  gazelab saliency photo.jpg
  gazelab saliency --csv winners.csv --maps maps --overlay overlays photos/*.jpg
  gazelab saliency --profile report --csv - photo.jpg
)";

}  // namespace

Command add_saliency_command(CLI::App& gazelab) {
  CLI::App* command =
      gazelab.add_subcommand("saliency", "Find the most salient place of each picture.");
  const auto options = std::make_shared<SaliencyOptions>();
  command->add_option("IMAGE", options->images, "pictures: JPEG, PNG, PPM, PGM, BMP, TIFF, WebP")
      ->required()
      ->type_name("");
  command->add_option("--profile", options->profile, "report (2011), robust or surround")
      ->check(CLI::IsMember(
          std::vector<std::string>(saliency::profile_names.begin(), saliency::profile_names.end())))
      ->type_name("NAME")
      ->capture_default_str();
  command->add_option("--csv", options->csv, "write CSV to this file, - for standard output")
      ->type_name("FILE");
  command->add_option("--maps", options->maps, "write each map into this folder")->type_name("DIR");
  command->add_option("--overlay", options->overlays, "write each overlay into this folder")
      ->type_name("DIR");
  command->footer(saliency_footer);
  return {.options = command, .run = [options] { return run_saliency(*options); }};
}

}  // namespace gazed::lab
