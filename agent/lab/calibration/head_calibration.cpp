#include "agent/lab/calibration/head_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/pattern_place.hpp"
#include "agent/lab/calibration/scene_points.hpp"
#include "agent/lab/io/progress.hpp"

namespace gazed::lab::calibration {

namespace {

// Priors that no configuration states.
constexpr double mount_rotation_sigma_rad = 0.2;
// Of the camera's place in the head, where a board or marks tell metres: heads are built to
// millimetres.
constexpr double measured_offset_sigma_m = 0.02;
constexpr double encoder_scale_sigma = 0.1;   // pan-tilt units with stepped gears are 6 % off
constexpr double axis_offset_sigma_m = 0.05;  // of heads of the NAO's size
constexpr std::array<double, 5> distortion_sigma = {0.1, 0.1, 0.005, 0.005, 0.0};

// First guesses of the image noise; the residuals decide.
constexpr double corner_sigma_px = 0.2;
constexpr double track_sigma_px = 0.5;
constexpr double mark_sigma_px = 2.0;

constexpr std::size_t fewest_looks = 4;

void check_looks(std::size_t found, const std::string& what) {
  if (found >= fewest_looks) return;
  throw std::invalid_argument(
      base::text("%zu %s found; allowed: from %zu, better 20, spread over all "
                 "the angles of both joints",
                 found, what.c_str(), fewest_looks));
}

BundleInput bundle_for(const HeadBelief& belief, double pixel_sigma_px, bool metric) {
  BundleInput input;
  input.prior = prior_of(belief, metric);
  input.encoder_sigma_rad = belief.uncertainty.encoder_sigma_rad;
  input.pixel_sigma_px = pixel_sigma_px;
  return input;
}

BundleResult fitted(const BundleInput& input) {
  BundleResult fit = adjust_bundle(input);
  if (fit.converged && fit.estimate.allFinite()) return fit;
  if (fit.sightings_used == 0) {
    throw std::runtime_error(base::text(
        "no geometry fits what was seen: none of the %zu image points belongs to anything in "
        "front of the camera; in the torso's frame x is forward, y left, z up, in metres",
        input.sightings.size()));
  }
  throw std::runtime_error(
      base::text("no geometry fits what was seen: %.3g px rms at best; are the "
                 "angles in radians, yaw positive left, pitch positive down?",
                 fit.after.measured_px));
}

/// Which encoders count wrongly: by more than their sigmas explain, and than anybody would notice.
std::array<bool, 2> wrong_scales(const Eigen::Vector2d& scale, const Eigen::Vector2d& sigma) {
  constexpr double greatest_sigmas = 3.0, greatest_change = 0.002;
  std::array<bool, 2> wrong{};
  for (int i = 0; i < 2; ++i) {
    const double change = std::abs(scale[i] - 1.0);
    wrong[static_cast<std::size_t>(i)] =
        change > greatest_sigmas * sigma[i] && change > greatest_change;
  }
  return wrong;
}

/// The way between the least and the greatest angle, of both axes the lesser.
double least_spread_rad(std::span<const geometry::HeadAngles> looks) {
  geometry::HeadAngles least = looks[0], greatest = looks[0];
  for (const geometry::HeadAngles& look : looks) {
    least = {std::min(least.yaw_rad, look.yaw_rad), std::min(least.pitch_rad, look.pitch_rad)};
    greatest = {std::max(greatest.yaw_rad, look.yaw_rad),
                std::max(greatest.pitch_rad, look.pitch_rad)};
  }
  return std::min(greatest.yaw_rad - least.yaw_rad, greatest.pitch_rad - least.pitch_rad);
}

void check_spread(std::span<const geometry::HeadAngles> looks) {
  constexpr double least_rad = 0.1;
  const double spread_rad = least_spread_rad(looks);
  if (spread_rad >= least_rad) return;
  throw std::invalid_argument(
      base::text("the head turns by %.3f rad only in yaw or in pitch; allowed: "
                 "from %.1f rad in both, better all that keeps it in view",
                 spread_rad, least_rad));
}

/// Pictures that do not turn with the angles are explained by encoders that count next to nothing.
void check_scale(const Eigen::Vector2d& scale) {
  constexpr double farthest = 0.3;
  if ((scale.array() - 1.0).abs().maxCoeff() <= farthest) return;
  throw std::runtime_error(
      base::text("what was seen does not follow the head's angles: it turns %.2f and "
                 "%.2f times as far as yaw and pitch say. Does the scene stand "
                 "still, and do neighbouring pictures overlap?",
                 scale.x(), scale.y()));
}

HeadCalibration calibrated(const HeadBelief& belief, BundleInput input) {
  check_spread(input.looks);
  HeadCalibration result;
  result.before = belief.model;
  result.sightings = input.sightings.size();
  const BundleResult with_scale = fitted(input);
  check_scale(with_scale.estimate.segment<2>(encoder_scale_at));
  const Certainty all = certainty_of(with_scale.information, input.prior, with_scale.estimate);
  result.encoder_scale = with_scale.estimate.segment<2>(encoder_scale_at);
  result.encoder_scale_sigma = all.sigma.segment<2>(encoder_scale_at);
  result.scale_is_wrong = wrong_scales(result.encoder_scale, result.encoder_scale_sigma);
  // gazed has no key for a scale: unless it is plainly wrong it is held at 1 for all the others.
  for (int i = 0; i < 2; ++i) {
    if (!result.scale_is_wrong[static_cast<std::size_t>(i)]) {
      input.prior.sigma[encoder_scale_at + i] = 0.0;
    }
  }
  result.prior = input.prior;
  result.fit = fitted(input);
  result.certainty = certainty_of(result.fit.information, input.prior, result.fit.estimate);
  result.after = with_parameters(belief.model, result.fit.estimate);
  if (!input.pattern_m.empty())
    result.neck_in_pattern_m = geometry::origin(result.fit.neck_from_pattern);
  return result;
}

geometry::Pose first_place(const HeadBelief& belief, const BundleInput& input) {
  const auto place =
      first_pattern_place(belief.model, input.looks, input.sightings, input.pattern_m);
  if (!place) {
    throw std::runtime_error(
        "where the board or the marks stand cannot be told from what was "
        "seen: are there at least four points, not all on one line?");
  }
  return *place;
}

/// Turns the order of the corners around where the board's other end was found first.
void order_like(const Eigen::Vector3d& first_to_last, const HeadModel& model,
                geometry::HeadAngles look, std::vector<geometry::Pixel>& corners) {
  const auto first = direction_in_neck(model, look, corners.front());
  const auto last = direction_in_neck(model, look, corners.back());
  if (first && last && (*last - *first).dot(first_to_last) < 0.0) std::ranges::reverse(corners);
}

}  // namespace

Prior prior_of(const HeadBelief& belief, bool metric) {
  Prior prior;
  prior.mean = parameters_of(belief.model);
  Parameters& sigma = prior.sigma;
  const geometry::Uncertainty& u = belief.uncertainty;
  sigma.segment<2>(focal_at).setConstant(u.focal_sigma_px);
  sigma.segment<2>(centre_at).setConstant(u.centre_sigma_px);
  // A distortion that somebody calibrated stays; none at all is taken for unknown.
  const bool unknown =
      std::ranges::all_of(belief.model.camera.distortion, [](double d) { return d == 0.0; });
  for (int i = 0; i < 5; ++i) {
    sigma[distortion_at + i] = unknown ? distortion_sigma[static_cast<std::size_t>(i)] : 0.0;
  }
  sigma.segment<3>(mount_offset_at)
      .setConstant(metric ? std::max(measured_offset_sigma_m, u.mount_offset_sigma_m)
                          : u.mount_offset_sigma_m);
  sigma.segment<3>(mount_rotation_at).setConstant(mount_rotation_sigma_rad);
  sigma.segment<2>(zero_at).setConstant(u.zero_sigma_rad);
  sigma.segment<2>(encoder_scale_at).setConstant(encoder_scale_sigma);
  sigma.segment<3>(axis_offset_at)
      .setConstant(belief.axis_offset_estimated ? axis_offset_sigma_m : 0.0);
  return prior;
}

HeadCalibration calibrate_on_board(const HeadBelief& belief, const Chessboard& board,
                                   std::span<const HeadPicture> pictures, int corner_window_px) {
  if (board.columns == board.rows) {
    throw std::invalid_argument(base::text(
        "--board: %dx%d found; allowed with head angles: different numbers of columns and rows, so "
        "that a quarter turn of the board is seen",
        board.columns, board.rows));
  }
  BundleInput input = bundle_for(belief, corner_sigma_px, true);
  input.pattern_m = corner_places(board);
  input.point_count = board.corner_count();
  std::vector<std::string> unused;
  std::optional<Eigen::Vector3d> first_to_last;
  io::Progress progress(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const HeadPicture& picture = pictures[i];
    std::vector<geometry::Pixel> corners = find_corners(picture.grey, board, corner_window_px);
    progress.show(i + 1, base::text("%zu of %zu pictures searched", i + 1, pictures.size()));
    if (corners.empty()) {
      unused.push_back(picture.name +
                       base::text(": not all %dx%d inner corners of the board are found",
                                  board.columns, board.rows));
      continue;
    }
    const auto first = direction_in_neck(belief.model, picture.measured, corners.front());
    const auto last = direction_in_neck(belief.model, picture.measured, corners.back());
    if (!first_to_last && first && last) first_to_last = *last - *first;
    if (first_to_last) order_like(*first_to_last, belief.model, picture.measured, corners);
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      input.sightings.push_back({.look = static_cast<int>(input.looks.size()),
                                 .point = static_cast<int>(corner),
                                 .pixel = corners[corner]});
    }
    input.looks.push_back(picture.measured);
  }
  progress.clear();
  check_looks(input.looks.size(), base::text("pictures with all %dx%d corners of the board",
                                             board.columns, board.rows));
  input.neck_from_pattern = first_place(belief, input);
  HeadCalibration result = calibrated(belief, input);
  result.input = base::text("%zu pictures of a board, %d corners each", input.looks.size(),
                            board.corner_count());
  result.unused = std::move(unused);
  return result;
}

HeadCalibration calibrate_on_scene(const HeadBelief& belief,
                                   std::span<const HeadPicture> pictures) {
  check_looks(pictures.size(), "pictures");
  BundleInput input = bundle_for(belief, track_sigma_px, false);
  for (const HeadPicture& picture : pictures) input.looks.push_back(picture.measured);
  ScenePoints points = find_scene_points(pictures, belief.model);
  constexpr int fewest_points = 30;
  if (points.point_count < fewest_points) {
    throw std::invalid_argument(base::text(
        "%d points of the scene found in three pictures or more; allowed: from %d: the scene "
        "needs texture and must stand still, and neighbouring pictures must overlap (turns "
        "below 0.5 rad)",
        points.point_count, fewest_points));
  }
  input.sightings = std::move(points.sightings);
  input.point_count = points.point_count;
  HeadCalibration result = calibrated(belief, input);
  result.input = base::text("%zu pictures of a scene, %d points followed", pictures.size(),
                            points.point_count);
  return result;
}

HeadCalibration calibrate_on_marks(const HeadBelief& belief,
                                   std::span<const MarkReading> readings) {
  check_looks(readings.size(), "readings");
  BundleInput input = bundle_for(belief, mark_sigma_px, true);
  input.encoder_sigma_rad = 0.0;    // one point a look: its noise and the image's are one
  input.outliers_rejected = false;  // somebody measured each of them
  for (std::size_t i = 0; i < readings.size(); ++i) {
    input.looks.push_back(readings[i].measured);
    input.pattern_m.push_back(readings[i].mark_m);
    input.sightings.push_back(
        {.look = static_cast<int>(i), .point = static_cast<int>(i), .pixel = readings[i].pixel});
  }
  input.point_count = static_cast<int>(readings.size());
  input.pattern_held = belief.marks_in_torso;
  input.neck_from_pattern = belief.marks_in_torso ? geometry::Pose{Eigen::Matrix3d::Identity(),
                                                                   -belief.model.head.neck_offset_m}
                                                  : first_place(belief, input);
  HeadCalibration result = calibrated(belief, input);
  result.input = base::text("%zu readings of marks", readings.size());
  return result;
}

}  // namespace gazed::lab::calibration
