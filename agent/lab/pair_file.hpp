// Two calibrated cameras, from a TOML file: what gazelab triangulate takes as PAIR.toml.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::lab {

struct PairCamera {
  geometry::CameraModel model;  // its width and height are not used
  double skew_px = 0.0;         // K(0, 1)

  friend bool operator==(const PairCamera& a, const PairCamera& b) {
    return a.model.focal_px == b.model.focal_px && a.model.centre_px == b.model.centre_px &&
           a.model.distortion == b.model.distortion && a.skew_px == b.skew_px;
  }
};

/// Every sigma that the file does not give is 0: that source of error is not counted.
struct CameraPair {
  std::array<PairCamera, 2> cameras;
  geometry::Pose cam2_from_cam1;
  double pixel_sigma_px = 0.0;
  double rotation_sigma_rad = 0.0;
  double translation_sigma_m = 0.0;
  double focal_sigma_px = 0.0;
  double centre_sigma_px = 0.0;
  double relative_sigma_max = triangulation::Gate{}.relative_sigma_max;
  std::vector<std::string> warnings;  // what is allowed and still hardly meant
};

/// The pair that a TOML text describes; `name` is what messages call it. Throws
/// std::invalid_argument, "name:line: key: value found; allowed: ...", for an unknown key, a
/// missing or singular K, an R that is no rotation and a value out of range.
[[nodiscard]] CameraPair parse_pair(std::string_view toml_text, const std::string& name);

/// The same of a file. Throws std::invalid_argument also when it cannot be read.
[[nodiscard]] CameraPair read_pair_file(const std::string& file);

/// The two looks of `pair` at one point. The image points are NaN where a camera has no ray for its
/// pixel.
[[nodiscard]] triangulation::TwoViews two_views(const CameraPair& pair,
                                                const geometry::Pixel& pixel_1,
                                                const geometry::Pixel& pixel_2);

/// The pair's sources of error, but for the noise of the image points. Cameras that are equal are
/// one camera, whose errors both looks share; others have errors of their own.
[[nodiscard]] triangulation::ErrorSources error_sources(const CameraPair& pair,
                                                        const triangulation::TwoViews& views);

}  // namespace gazed::lab
