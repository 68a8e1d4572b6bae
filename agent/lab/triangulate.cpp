// gazelab triangulate: the points that two calibrated cameras saw, each with how sure it is.
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/commands.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/triangulate_rows.hpp"

namespace gazed::lab {

namespace {

struct TriangulateOptions {
  std::string pair;
  std::string correspondences;
  std::string method = "optimal";
  std::string csv;
};

/// What can be said before a point is triangulated. Throws std::invalid_argument.
CameraPair checked_pair(const TriangulateOptions& options) {
  CameraPair pair = read_pair_file(options.pair);
  if (!options.csv.empty() && options.csv != "-") {
    const std::vector<std::string> inputs = {options.pair, options.correspondences};
    io::check_output_file(options.csv, inputs);
  }
  for (const std::string& warning : pair.warnings) {
    std::fprintf(stderr, "gazelab: warning: %s\n", warning.c_str());
  }
  return pair;
}

int run_triangulate(const TriangulateOptions& options) {
  const CameraPair pair = checked_pair(options);
  CorrespondenceReader reader(options.correspondences);
  PointTable table(options.csv);
  triangulate(pair, *triangulation::methods::method_of(options.method), reader, table);
  table.finish();
  std::fprintf(stderr, "%s\n", table.summary().c_str());
  return exit_done;
}

constexpr const char* triangulate_footer = R"(
PAIR.toml, the two cameras; a key that is not here is an error:

  K1 = [[752.0, 0.0, 331.0], [0.0, 752.0, 253.0], [0.0, 0.0, 1.0]]       # pixels
  K2 = [[752.0, 0.0, 331.0], [0.0, 752.0, 253.0], [0.0, 0.0, 1.0]]
  R = [[0.921061, 0.0, -0.389418], [0.0, 1.0, 0.0], [0.389418, 0.0, 0.921061]]
  t = [-0.02286, 0.0, -0.00463]    # x2 = R x1 + t, METRES, in camera 2's optical frame
  pixel_sigma_px = 0.3             # of an image coordinate
  # Optional. Without D1, D2: no distortion. Without a sigma: 0, that error is not counted.
  D1 = [0.0, 0.0, 0.0, 0.0, 0.0]   # k1 k2 p1 p2 k3 (Brown-Conrady, as OpenCV)
  D2 = [0.0, 0.0, 0.0, 0.0, 0.0]
  rotation_sigma_rad = 0.001       # about each axis of camera 2
  translation_sigma_m = 0.0005     # along each axis of camera 2
  focal_sigma_px = 2.0             # equal K and D: one camera, and one error in both views;
  centre_sigma_px = 1.6            # else each camera has errors of its own
  relative_sigma_max = 0.15        # the default; over it a point is UNCERTAIN

CORRESPONDENCES.csv, - for standard input; pixels, (0,0) the centre of the top left one:

  id,x1,y1,x2,y2
  lamp,381.1,177.8,4.7,172.3
  door,531.5,152.7,214.0,154.9

Output, a row for each correspondence, in their order, ids as they were written:

  id,status,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,range_m,range_sigma_m,residual_px,parallax_rad

Camera 1's optical frame (x right, y down, z forward), 12 significant digits, nan where there is no
number. Without --csv: columns to a terminal, CSV to a pipe or file. A line on standard error counts
the statuses:

  LOCATED         within the gate
  UNCERTAIN       range sigma over relative_sigma_max; no position when it may be at infinity
  TARGET_LOST     the rays miss each other by more than their noise: not the same point
  BEHIND_CAMERA   the rays meet behind a camera
  DEGENERATE      no baseline, or both rays along it
  INVALID_INPUT   a coordinate is nan or infinite, or the camera has no ray for it

Methods. optimal: least squared image error (Hartley and Sturm). lindstrom: the same in two
iterations, faster. rectification: by disparity. linear-mmse: with the report's prior, 0.1 to 1.5 m
ahead of camera 1 (mean 0, 0, 0.8 m, sigma 0.25, 0.25, 0.7 m): for points in there only. Its sigmas
are right on average over that prior, not for a point outside it.

Rows are read and written one at a time: any number of them takes the same memory.

Exit: 0 done, 1 CORRESPONDENCES.csv could not be read (the line is named) or the output not written,
2 bad arguments or PAIR.toml. FILE appears only when it is complete.

Examples:
  gazelab triangulate pair.toml matches.csv
  gazelab triangulate --method linear-mmse --csv points.csv pair.toml matches.csv
  zcat matches.csv.gz | gazelab triangulate pair.toml - > points.csv
)";

}  // namespace

Command add_triangulate_command(CLI::App& gazelab) {
  CLI::App* command = gazelab.add_subcommand(
      "triangulate", "Locate the points that two calibrated cameras saw, with their uncertainty.");
  const auto options = std::make_shared<TriangulateOptions>();
  command->add_option("PAIR.toml", options->pair, "the two cameras")->required()->type_name("");
  command
      ->add_option("CORRESPONDENCES.csv", options->correspondences,
                   "image points, - for standard input")
      ->required()
      ->type_name("");
  const auto methods = triangulation::methods::method_names();
  command->add_option("--method", options->method, "optimal, rectification, linear-mmse, lindstrom")
      ->check(CLI::IsMember(std::vector<std::string>(methods.begin(), methods.end())))
      ->type_name("NAME")
      ->capture_default_str();
  command->add_option("--csv", options->csv, "write CSV to this file, - for standard output")
      ->type_name("FILE");
  command->footer(triangulate_footer);
  return {.options = command, .run = [options] { return run_triangulate(*options); }};
}

}  // namespace gazed::lab
