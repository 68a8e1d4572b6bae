// gazelab saliency: the most salient place of each picture.
#include "agent/saliency/saliency.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/commands.hpp"
#include "agent/lab/io/findings.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/overlay.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/lab/io/picture_files.hpp"
#include "agent/lab/io/picture_saliency.hpp"
#include "agent/lab/io/progress.hpp"
#include "agent/lab/live/sources.hpp"
#include "agent/lab/live/watch.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

struct SaliencyOptions {
  std::vector<std::string> inputs;     // pictures, or folders of them
  std::string camera, video;           // or one of these
  std::optional<std::int64_t> frames;  // of these, the most
  std::string profile{
      saliency::profile_names[static_cast<std::size_t>(saliency::SaliencySettings().profile)]};
  std::string csv;
  fs::path maps;
  fs::path overlays;
};

/// Where maps and overlays go.
struct Outputs {
  io::OutputFolder maps, overlays;
};

/// The inputs, and of a folder the pictures in it.
std::vector<std::string> images_of(const SaliencyOptions& options) {
  std::vector<std::string> images;
  for (const std::string& input : options.inputs) {
    if (!fs::is_directory(input)) {
      images.push_back(input);
      continue;
    }
    const std::vector<std::string> inside = io::pictures_in(input);
    if (inside.empty()) throw std::invalid_argument(input + ": a folder without pictures");
    images.insert(images.end(), inside.begin(), inside.end());
  }
  return images;
}

/// Less than the least frame that gazed takes: what is in it was lost before it was enlarged.
bool is_small(const cv::Mat& picture) {
  return picture.cols < saliency::frame_width_range_px.min ||
         picture.rows < saliency::frame_height_range_px.min;
}

io::Finding find_salient(const std::string& image, const Outputs& outputs,
                         const saliency::SaliencySettings& settings,
                         io::PictureSaliency& saliency) {
  const cv::Mat picture = io::read_picture(image);
  const io::SalientPicture salient = [&] {
    try {
      return saliency.examine(picture);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(image + ": " + error.what());
    }
  }();
  const saliency::SaliencyResult& result = salient.seen;
  const io::Finding finding{.image = image,
                            .winner_px = salient.winner_px,
                            .saliency = result.saliency,
                            .distinctness = result.distinctness,
                            .is_small = is_small(picture)};
  if (outputs.maps.is_wanted()) io::write_map(outputs.maps.file_for(image), result.map);
  if (outputs.overlays.is_wanted()) {
    io::write_png(outputs.overlays.file_for(image),
                  io::overlay_of(picture, result, salient.scale, settings.distinctness_min));
  }
  return finding;
}

/// Of a camera or a video.
int run_live(const SaliencyOptions& options, const saliency::SaliencySettings& settings) {
  if (!options.maps.empty()) throw std::invalid_argument("--maps is for pictures");
  const auto watch = [&](live::Frames& frames) {
    live::watch(frames, {settings, options.csv, options.overlays, options.frames});
    return exit_done;
  };
  if (!options.camera.empty()) {
    live::Camera camera(options.camera);
    return watch(camera);
  }
  if (options.csv != "-") io::check_output_file(options.csv, std::vector{options.video});
  live::Video video(options.video);
  return watch(video);
}

int run_saliency(const SaliencyOptions& options) {
  saliency::SaliencySettings settings;
  settings.profile = saliency::profile_of(options.profile).value();  // CLI11 has checked it
  const int kinds = (options.inputs.empty() ? 0 : 1) + (options.camera.empty() ? 0 : 1) +
                    (options.video.empty() ? 0 : 1);
  if (kinds != 1) throw std::invalid_argument("one of IMAGE, --camera and --video is needed");
  if (options.inputs.empty()) return run_live(options, settings);
  if (options.frames) throw std::invalid_argument("--frames is for --camera and --video");
  const std::vector<std::string> images = images_of(options);
  const Outputs outputs{{options.maps, ".pgm", images}, {options.overlays, ".png", images}};
  if (options.csv != "-") io::check_output_file(options.csv, images);
  outputs.maps.make(images);
  outputs.overlays.make(images);
  io::FindingsWriter writer(options.csv, images, settings.distinctness_min);
  io::PictureSaliency saliency(settings);
  io::Progress progress(images.size());
  int exit_code = exit_done;
  const auto complain = [&](const std::exception& error) {
    progress.clear();
    std::fprintf(stderr, "gazelab: %s\n", error.what());
    exit_code = exit_fault;
  };
  for (std::size_t i = 0; i < images.size(); ++i) {
    try {
      const io::Finding finding = find_salient(images[i], outputs, settings, saliency);
      writer.add(finding);
      if (finding.is_small) {
        progress.clear();
        std::fprintf(stderr, "%s: too small to judge, gazed takes %gx%g and more\n",
                     images[i].c_str(), saliency::frame_width_range_px.min,
                     saliency::frame_height_range_px.min);
      }
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
bilinear when it grows), as the robot's camera would give it. Colour, grey, 8 and 16 bit (of samples of
10, 12 or 14 bit the upper 8 count); transparency is dropped; the orientation noted by a camera is
applied. The map needs at least 160x120 after scaling, so a picture that is much longer than wide is
refused.

  CSV       image,x_px,y_px,saliency,distinctness,distinct
            x_px, y_px: the winner in the picture's own pixels, (0,0) the centre of the top left one.
            distinct: yes where gazed would look at it, else no.
            Without --csv: columns to a terminal, CSV to a pipe or file.
  maps      NAME.pgm: 16 bit, one sample for 16x16 pixels of the scaled picture, its maximum at 65535
  overlays  NAME.png: heat map, ring and cross on the winner, caption; the picture's own size

Maps and overlays of pictures from several folders are kept apart: FOLDER/NAME.pgm.

With --camera or --video a window shows each frame with its overlay and how many come a second; q, Esc
or closing it ends. A camera gives 640x480, as YUYV or, where it has none of that size, as JPEG, through
gazed's own driver. With --csv or --overlay there is no window, but a row, or a file, for each frame, its
number behind a '#'.

Exit: 0 done, 1 a picture could not be read or a file not written (the others are done),
2 bad arguments (nothing is done).

Examples:
  gazelab saliency photo.jpg
  gazelab saliency photos
  gazelab saliency --csv winners.csv --maps maps --overlay overlays photos/*.jpg
  gazelab saliency --profile report --csv - photo.jpg
  gazelab saliency --camera /dev/video0
  gazelab saliency --video walk.mp4 --frames 300 --csv winners.csv
)";

}  // namespace

Command add_saliency_command(CLI::App& gazelab) {
  CLI::App* command =
      gazelab.add_subcommand("saliency", "Find the most salient place of each picture.");
  const auto options = std::make_shared<SaliencyOptions>();
  command
      ->add_option("IMAGE", options->inputs,
                   base::text("pictures (%s), or folders of them", io::picture_formats))
      ->type_name("");
  command
      ->add_option("--camera", options->camera, "instead of pictures: this computer's camera, live")
      ->type_name("DEVICE");
  command->add_option("--video", options->video, "instead of pictures: a video's frames")
      ->type_name("FILE");
  command->add_option("--frames", options->frames, "of a camera or a video: end after so many")
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
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
