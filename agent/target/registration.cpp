#include "agent/target/registration.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "agent/target/object.hpp"
#include "agent/target/patch.hpp"
#include "agent/target/plane.hpp"
#include "agent/target/refine.hpp"
#include "agent/target/search.hpp"
#include "agent/target/warp.hpp"

namespace gazed {

namespace {

// Half sizes of the patch, px.
constexpr double half_size_min_px = 8.0;
constexpr double half_size_max_px = 160.0;
// When nothing stands out as an area, squares of texture are tried, the smallest first.
constexpr std::array texture_half_sizes_px = {24, 48, 96};
// How far the patch reaches over the object's outline: the blurred edge and a little of what is
// behind, and the error of the outline itself.
constexpr double outline_margin_px = 3.0;
// The reference point keeps off the frame's border.
constexpr double reference_border_px = 3.0;

// A patch must promise its place in the better direction to this with noise of camera_noise levels.
constexpr double predicted_sigma_max_px = 0.3;
constexpr double camera_noise = 3.0;
constexpr double smoothed_noise_share = 0.48;  // what reading the plane leaves of white noise

// The search goes this far from the prediction whatever the sigmas say: joint errors that nobody
// told us of (20 mrad on both looks, 2.5 sigma) shall be found, and then judged by the caller.
constexpr double untold_error_rad = 0.07;
constexpr double margin_sigmas = 3.5;
constexpr double margin_max_rad = 0.2;

// What the match may not differ by.
constexpr double visible_min = 0.6;
constexpr double gain_min = 0.4, gain_max = 2.5;
constexpr double colour_cosine_min =
    0.9;  // of the contrast's direction in colour space, 26 degrees
// Another place is as good when its misfit, 1 - correlation, is below twice the best one's plus
// this.
constexpr double misfit_noise = 0.03;
// The answer's error is not noise alone: sampling an edge of half a pixel leaves up to this.
constexpr double sampling_sigma_px = 0.015;
// From here on the place along an edge is unknown and the reason says so.
constexpr double edge_only_sigma_px = 1.0;

// What is known of the warp beforehand. A surface is rarely seen under less than 30 degrees: slopes
// of the inverse depth of 0.6 of itself. 28 mrad of relative angle error change the size by up to
// 3 %, and turn the picture by less than 10 mrad.
constexpr double slope_sigma = 0.6;
constexpr double log_scale_sigma = 0.03;
constexpr double roll_sigma_rad = 0.01;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  std::array<char, 256> buffer;
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

bool finite(HeadAngles angles) {
  return std::isfinite(angles.yaw_rad) && std::isfinite(angles.pitch_rad);
}

bool fits(const ImageView& image, const CameraModel& camera) {
  return !image.empty() && image.width_px == camera.width_px && image.height_px == camera.height_px;
}

void check(const RegistrationSettings& settings, const CameraModel& camera) {
  const auto refuse = [](const char* name, double value, const char* allowed) {
    throw std::invalid_argument(text("%s is %g, must be %s", name, value, allowed));
  };
  if (!(settings.range_min_m > 0.0)) refuse("range_min_m", settings.range_min_m, "positive");
  if (!(settings.range_max_m > settings.range_min_m)) {
    refuse("range_max_m", settings.range_max_m, "above range_min_m");
  }
  if (!(settings.correlation_min > 0.0 && settings.correlation_min < 1.0)) {
    refuse("correlation_min", settings.correlation_min, "between 0 and 1");
  }
  if (!(camera.focal_px.minCoeff() > 0.0)) {
    refuse("focal_px", camera.focal_px.minCoeff(), "positive");
  }
  if (std::min(camera.width_px, camera.height_px) < 64) {
    refuse("image size", std::min(camera.width_px, camera.height_px), "at least 64 px");
  }
}

}  // namespace

struct Registration::State {
  RegistrationSettings settings;
  CameraModel camera;
  HeadGeometry head;
  Uncertainty uncertainty;

  bool chosen = false;
  HeadAngles head_1;
  Eigen::Vector2d reference = Eigen::Vector2d::Zero();  // normalised
  ObjectMask object;
  Patch patch;

  PlanePyramid planes_2;
  PatchSearch search;
  WarpRefinement refinement;

  bool choose_patch(const ImageView& image, const Pixel& centre, double half_size_px,
                    double margin_px);
  double predicted_sigma_px() const;
  double search_margin_px(const PatchMotion& motion) const;
  int search_level() const;
  RegistrationResult find(const View& view_2);
  RegistrationResult match(const ImageView& image, const PatchMotion& motion,
                           const EpipolarSegment& segment, double margin_px);
  RegistrationResult judge(const ImageView& image, const PatchMotion& motion, const WarpFit& fit);
};

Registration::Registration(const RegistrationSettings& settings, const CameraModel& camera,
                           const HeadGeometry& head, const Uncertainty& uncertainty)
    : state_(std::make_unique<State>()) {
  check(settings, camera);
  state_->settings = settings;
  state_->camera = camera;
  state_->head = head;
  state_->uncertainty = uncertainty;
  const int patch_px = 2 * static_cast<int>(half_size_max_px) + 160;
  state_->patch.planes.reserve(patch_px, patch_px);
  for (PatchLevel& level : state_->patch.levels) {
    level.samples.reserve(4096);
    level.pixels.reserve(4096);
  }
  const int beyond_px = 2 * 256;
  state_->planes_2.reserve(camera.width_px + beyond_px, camera.height_px + beyond_px);
  state_->search.reserve(camera.width_px, camera.height_px);
  state_->refinement.reserve(4096);
}

Registration::~Registration() = default;
Registration::Registration(Registration&&) noexcept = default;
Registration& Registration::operator=(Registration&&) noexcept = default;

std::optional<Pixel> Registration::choose_target(const View& view_1, const Pixel& salient) {
  State& state = *state_;
  state.chosen = false;
  if (!fits(view_1.image, state.camera) || !state.camera.contains(salient)) return std::nullopt;
  state.head_1 = view_1.head;
  if (state.object.segment(view_1.image, salient)) {
    const Pixel centre = state.object.interior_point();
    const double margin = outline_margin_px + 1.5 * state.object.cell_px();
    state.chosen = state.choose_patch(view_1.image, centre,
                                      state.object.half_size_px(centre) + margin, margin);
  }
  for (const int half_size : texture_half_sizes_px) {
    if (state.chosen) break;
    state.object.take_square(view_1.image, salient, half_size);
    state.chosen = state.choose_patch(view_1.image, salient, half_size, 0.0);
  }
  if (!state.chosen) return std::nullopt;
  return state.patch.reference_px;
}

bool Registration::State::choose_patch(const ImageView& image, const Pixel& centre,
                                       double half_size_px, double margin_px) {
  if (!camera.contains(centre, reference_border_px)) return false;
  const auto normalised = normalise(camera, centre);
  if (!normalised) return false;
  reference = *normalised;
  patch.reference_px = centre;
  patch.format = image.format;
  patch.half_size_px = std::clamp(half_size_px, half_size_min_px, half_size_max_px);
  patch.margin_px = margin_px;
  patch.axis = strongest_colour_axis(image, object, centre, patch.half_size_px, margin_px);
  if (patch.axis.isZero()) return false;
  sample_patch(image, camera, object, patch);
  if (!(predicted_sigma_px() < predicted_sigma_max_px)) return false;
  patch.contrast = colour_contrast(image, patch.levels[0].samples, patch.levels[0].pixels);
  return true;
}

// Standard deviation of the place in the better direction if the patch were found again with camera
// noise in both views. Gain and bias are unknown too: a ramp has gradient and yet no place.
double Registration::State::predicted_sigma_px() const {
  constexpr std::size_t level = 1;
  const PlaneLevel& plane = patch.planes.level(level);
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (const Pixel& pixel : patch.levels[level].pixels) {
    const PlaneSample read = plane.read(plane.to_samples(pixel));
    const Eigen::Vector4d jacobian(read.dx / plane.step_px, read.dy / plane.step_px, read.value,
                                   1.0);
    normal += jacobian * jacobian.transpose();
  }
  // Eliminate gain and bias.
  const Eigen::Matrix2d nuisance = normal.bottomRightCorner<2, 2>();
  const Eigen::Matrix2d mixed = normal.topRightCorner<2, 2>();
  const double determinant = nuisance.determinant();
  if (!(determinant > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Matrix2d place =
      normal.topLeftCorner<2, 2>() - mixed * nuisance.inverse() * mixed.transpose();
  const double information =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(place, Eigen::EigenvaluesOnly)
          .eigenvalues()[1];
  return information > 0.0 ? camera_noise * smoothed_noise_share / std::sqrt(information)
                           : std::numeric_limits<double>::infinity();
}

RegistrationResult Registration::find(const View& view_2) {
  return state_->find(view_2);
}

RegistrationResult Registration::State::find(const View& view_2) {
  const ImageView& image = view_2.image;
  if (!chosen) return {std::nullopt, "no target was chosen"};
  if (!fits(image, camera)) {
    return {std::nullopt, text("view 2 is %dx%d px, the camera %dx%d px", image.width_px,
                               image.height_px, camera.width_px, camera.height_px)};
  }
  if (image.format != patch.format) {
    return {std::nullopt, "view 2 has another pixel format than view 1"};
  }
  if (!finite(head_1) || !finite(view_2.head)) {
    return {std::nullopt, "the head angles are not finite"};
  }
  const PatchMotion motion{cam2_from_cam1(head, head_1, view_2.head), reference};
  const double ray_length = reference.homogeneous().norm();  // range over depth
  const EpipolarSegment segment(motion, camera, ray_length / settings.range_max_m,
                                ray_length / settings.range_min_m);
  if (!segment.valid()) {
    return {std::nullopt, "the target would be outside the field of view of view 2"};
  }
  const double margin_px = search_margin_px(motion);
  bool visible = false;
  for (int i = 0; i < EpipolarSegment::knots; ++i) {
    visible = visible || camera.contains(segment.knot(i), -margin_px);
  }
  if (!visible) {
    const Pixel& at = segment.knot(EpipolarSegment::knots / 2);
    return {std::nullopt,
            text("the target would be at (%.0f, %.0f), outside the image", at.x(), at.y())};
  }
  return match(image, motion, segment, margin_px);
}

double Registration::State::search_margin_px(const PatchMotion& motion) const {
  const Eigen::Matrix3d& rotation = motion.cam2_from_cam1.rotation;
  const double turn_rad = std::acos(std::clamp(0.5 * (rotation.trace() - 1.0), -1.0, 1.0));
  // Errors common to both looks cancel but for the turn between them.
  const double sigma_rad = std::sqrt(2.0 * std::pow(uncertainty.encoder_sigma_rad, 2) +
                                     turn_rad * turn_rad *
                                         (std::pow(uncertainty.zero_sigma_rad, 2) +
                                          std::pow(uncertainty.mount_rotation_sigma_rad, 2)));
  return camera.focal_px.maxCoeff() *
         std::clamp(margin_sigmas * sigma_rad, untold_error_rad, margin_max_rad);
}

// The coarsest level that has not lost the patch's contrast.
int Registration::State::search_level() const {
  constexpr double spread_kept = 0.3;
  const auto variance = [&](int level) {
    double n = 0.0, sum = 0.0, sum2 = 0.0;
    for (const PatchSample& sample : patch.levels[static_cast<std::size_t>(level)].samples) {
      const double value = sample.value;
      n += 1.0;
      sum += value;
      sum2 += value * value;
    }
    return n > 0.0 ? sum2 / n - (sum / n) * (sum / n) : 0.0;
  };
  int level = patch.planes.levels() - 1;
  while (level > 1 && variance(level) < spread_kept * variance(1)) --level;
  return level;
}

RegistrationResult Registration::State::match(const ImageView& image, const PatchMotion& motion,
                                              const EpipolarSegment& segment, double margin_px) {
  const int level = search_level();
  const auto index = static_cast<std::size_t>(level);
  Pixel low = segment.knot(0), high = low;
  for (int i = 1; i < EpipolarSegment::knots; ++i) {
    low = low.cwiseMin(segment.knot(i));
    high = high.cwiseMax(segment.knot(i));
  }
  const Pixel frame(camera.width_px - 1, camera.height_px - 1);
  const double support = 1.4 * patch.half_size_px + 4.0 * (1 << level);
  low = (low.array() - margin_px).cwiseMax(0.0).matrix().cwiseMin(frame).array() - support;
  high = (high.array() + margin_px).cwiseMax(0.0).matrix().cwiseMin(frame).array() + support;
  planes_2.build(
      image, patch.axis,
      {static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())),
       static_cast<int>(std::ceil(high.x())) + 1, static_cast<int>(std::ceil(high.y())) + 1},
      level + 1);

  const double separation_px = std::max(0.5 * patch.half_size_px, 2.0 * (1 << level));
  const int candidates = search.run(patch, level, object, motion, camera, segment, margin_px,
                                    separation_px, planes_2.level(level));
  const auto prior_for = [&](const PatchWarp& warp) {
    return WarpPrior{slope_sigma * std::hypot(warp.inverse_depth_per_m, 1.0), log_scale_sigma,
                     roll_sigma_rad};
  };
  WarpFit best, second;
  Pixel best_px = Pixel::Zero(), second_px = Pixel::Zero();
  for (int i = 0; i < candidates; ++i) {
    const auto start = warp_to(motion, camera, segment, search.candidate(i).pixel);
    if (!start) continue;
    WarpFit fit = refinement.run(patch.levels[index], planes_2.level(level), motion, camera,
                                 prior_for(*start), *start);
    const auto at = motion.reference_in_view_2(camera, fit.warp);
    if (!at || fit.visible < visible_min) continue;
    if (fit.correlation > best.correlation) {
      if ((*at - best_px).norm() > separation_px) {
        second = best;
        second_px = best_px;
      }
      best = fit;
      best_px = *at;
    } else if (fit.correlation > second.correlation && (*at - best_px).norm() > separation_px) {
      second = fit;
      second_px = *at;
    }
  }
  if (best.correlation < 0.5 * settings.correlation_min) {
    const Pixel& near = segment.knot(EpipolarSegment::knots - 1);
    const Pixel& far = segment.knot(0);
    return {std::nullopt,
            text("the target is not found between (%.0f, %.0f) and (%.0f, %.0f): best correlation "
                 "%.2f",
                 near.x(), near.y(), far.x(), far.y(), best.correlation)};
  }
  if (1.0 - second.correlation < 2.0 * (1.0 - best.correlation) + misfit_noise) {
    return {std::nullopt, text("ambiguous: correlation %.3f at (%.0f, %.0f), %.3f at (%.0f, %.0f)",
                               best.correlation, best_px.x(), best_px.y(), second.correlation,
                               second_px.x(), second_px.y())};
  }
  for (int finer = level - 1; finer >= 0; --finer) {
    const auto at = motion.reference_in_view_2(camera, best.warp);
    const auto start = at ? warp_to(motion, camera, segment, *at) : std::nullopt;
    if (!start) break;
    PatchWarp warp = *start;
    warp.slope_per_m = best.warp.slope_per_m;
    warp.log_scale = best.warp.log_scale;
    best = refinement.run(patch.levels[static_cast<std::size_t>(finer)], planes_2.level(finer),
                          motion, camera, prior_for(warp), warp);
  }
  return judge(image, motion, best);
}

RegistrationResult Registration::State::judge(const ImageView& image, const PatchMotion& motion,
                                              const WarpFit& fit) {
  const auto pixel = motion.reference_in_view_2(camera, fit.warp);
  if (!pixel || !camera.contains(*pixel)) {
    const Pixel at = pixel.value_or(Pixel::Zero());
    return {std::nullopt,
            text("the target would be at (%.0f, %.0f), outside the image", at.x(), at.y())};
  }
  if (fit.visible < visible_min) {
    return {std::nullopt,
            text("only %.0f %% of the target is inside the image", 100.0 * fit.visible)};
  }
  if (!fit.converged) {
    return {std::nullopt, text("the match at (%.1f, %.1f) did not converge, correlation %.2f",
                               pixel->x(), pixel->y(), fit.correlation)};
  }
  if (!(fit.correlation >= settings.correlation_min)) {
    return {std::nullopt, text("correlation %.2f at (%.1f, %.1f) is below %.2f", fit.correlation,
                               pixel->x(), pixel->y(), settings.correlation_min)};
  }
  if (!(fit.gain >= gain_min && fit.gain <= gain_max)) {
    return {std::nullopt, text("the contrast at (%.1f, %.1f) is %.2f times the target's",
                               pixel->x(), pixel->y(), fit.gain)};
  }
  const Eigen::Vector3d contrast =
      colour_contrast(image, patch.levels[0].samples, refinement.pixels_2());
  const double cosine = contrast.normalized().dot(patch.contrast.normalized());
  if (!(cosine >= colour_cosine_min)) {
    return {std::nullopt,
            text("what is at (%.1f, %.1f) has another colour: its contrast differs by %.0f degrees",
                 pixel->x(), pixel->y(), std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29578)};
  }
  RegistrationResult result;
  PatchMatch& match = result.match.emplace();
  match.pixel_2 = *pixel;
  match.covariance_px2 =
      fit.covariance_px2 + sampling_sigma_px * sampling_sigma_px * Eigen::Matrix2d::Identity();
  match.correlation = fit.correlation;
  match.scale = motion.scale(fit.warp);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(match.covariance_px2);
  const double sigma_px = std::sqrt(solver.eigenvalues()[1]);
  if (sigma_px > edge_only_sigma_px) {
    const Eigen::Vector2d along = solver.eigenvectors().col(1);
    result.reason = text("structure in one direction only: sigma %.1f px along (%.2f, %.2f)",
                         sigma_px, along.x(), along.y());
  }
  return result;
}

}  // namespace gazed
