#include "agent/tracking/registration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "agent/base/text.hpp"
#include "agent/geometry/singular_values.hpp"
#include "agent/tracking/ball.hpp"
#include "agent/tracking/matcher.hpp"
#include "agent/tracking/object.hpp"
#include "agent/tracking/patch.hpp"
#include "agent/tracking/slopes.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

namespace {

// If no area stands out, squares of texture are tried, the smallest first.
constexpr std::array texture_half_sizes_px = {24, 48, 96};
// How far the patch extends beyond the object's outline: the blurred edge, a little of the
// background, and the error of the outline itself.
constexpr double outline_margin_px = 3.0;
constexpr double outline_error_cells = 1.5;
// Distance of the reference point from the frame's border.
constexpr double reference_border_px = 3.0;

// A patch must promise a position to this sigma in both directions, with this camera noise: an arc
// of an outline would slide along itself.
constexpr double predicted_sigma_max_px = 0.1;
// A patch that is this much less certain in one direction is an edge; what remains is its pixel
// steps.
constexpr double along_by_across_max = 20.0;
constexpr double camera_noise_levels = 3.0;

// The search reaches this far from the prediction whatever the sigmas say: it must find the target
// in spite of unreported joint errors (20 mrad in both looks, 2.5 sigma) and leave the judgement to
// the caller.
constexpr double unreported_error_rad = 0.07;
constexpr double margin_sigmas = 3.5;
constexpr double margin_max_rad = 0.2;

// What a match must share with the target: its samples inside the frame, its contrast, and the
// contrast's direction in colour space (26 degrees).
constexpr double visible_share_min = 0.6;
constexpr double contrast_ratio_min = 0.4, contrast_ratio_max = 2.5;
constexpr double colour_cosine_min = 0.9;
// Noise is not the only error: sampling sharp edges on the pixel grid leaves this much.
constexpr double sampling_sigma_px = 0.01;
// The background is read next to the outline and differs a little from what is behind it. With
// drawn objects in front of boards, furniture and textures, the error is this much times the
// background's change relative to the patch's contrast.
constexpr double background_sigma_px = 0.1;
// The depth correction for the object's shape has the same error in every look, but the solver
// takes the looks as independent. The factor is the square root of a typical number of looks.
constexpr double same_in_all_looks = 2.0;
// Above this the position along an edge is unknown, and the reason says so.
constexpr double edge_only_sigma_px = 1.0;

bool fits(const base::ImageView& image, const geometry::CameraModel& camera) {
  return !image.empty() && image.width_px == camera.width_px && image.height_px == camera.height_px;
}

}  // namespace

struct Registration::State {
  RegistrationSettings settings;
  geometry::Rig rig;

  bool chosen = false;
  geometry::HeadAngles head_1;
  Eigen::Vector2d reference = Eigen::Vector2d::Zero();  // normalised
  ObjectMask object;
  Patch patch;
  PatchMatcher matcher;
  BelievedSlopes slopes;
  BelievedBall ball;

  const char* refusal = "";  // why no target was chosen

  bool choose(const base::ImageView& image, const geometry::Pixel& salient);
  bool choose_patch(const base::ImageView& image, const geometry::Pixel& centre,
                    double half_size_px, double margin_px);
  RegistrationResult find(const geometry::View& view_2);
  double search_margin_px(const PatchMotion& motion) const;
  Eigen::Vector2d by_depth_px(double share, const PatchWarp& warp, const PatchMotion& motion) const;
  RegistrationResult judge(const base::ImageView& image, const PatchMotion& motion,
                           const PatchMatcher::Outcome& outcome);
};

Registration::Registration(const geometry::Rig& rig, const RegistrationSettings& settings)
    : state_(std::make_unique<State>()) {
  check(settings, rig.camera);
  state_->settings = settings;
  state_->rig = rig;
  state_->patch.reserve();
  state_->matcher.reserve(rig.camera);
}

Registration::~Registration() = default;
Registration::Registration(Registration&&) noexcept = default;
Registration& Registration::operator=(Registration&&) noexcept = default;

std::optional<geometry::Pixel> Registration::choose_target(const geometry::View& view_1,
                                                           const geometry::Pixel& salient) {
  State& state = *state_;
  state.head_1 = view_1.head;
  state.refusal = "view 1 does not fit the camera";
  state.slopes.clear();
  state.chosen = fits(view_1.image, state.rig.camera) && state.rig.camera.contains(salient) &&
                 state.choose(view_1.image, salient);
  if (!state.chosen) return std::nullopt;
  state.ball.begin(state.patch.relief);
  return state.patch.reference_px;
}

const char* Registration::refusal() const {
  return state_->refusal;
}

double Registration::half_size_px() const {
  return state_->patch.half_size_px;
}

Outline Registration::outline() const {
  const geometry::Pixel& inside = state_->patch.reference_px;
  return outline_of(state_->object, inside,
                    std::numbers::sqrt2 * state_->object.half_size_px(inside));
}

void Registration::believe(const geometry::HeadGeometry& head) {
  state_->rig.head = head;
}

RegistrationResult Registration::find(const geometry::View& view_2) {
  return state_->find(view_2);
}

bool Registration::State::choose(const base::ImageView& image, const geometry::Pixel& salient) {
  if (object.segment(image, salient)) {
    const geometry::Pixel centre = object.interior_point();
    const double margin_px = outline_margin_px + outline_error_cells * object.cell_px();
    if (choose_patch(image, centre, object.half_size_px(centre) + margin_px, margin_px)) {
      return true;
    }
  }
  return std::any_of(texture_half_sizes_px.begin(), texture_half_sizes_px.end(), [&](int half) {
    object.take_square(image, salient, half);
    return choose_patch(image, salient, half, 0.0);
  });
}

bool Registration::State::choose_patch(const base::ImageView& image, const geometry::Pixel& centre,
                                       double half_size_px, double margin_px) {
  if (!rig.camera.contains(centre, reference_border_px)) {
    refusal = "its middle is at the frame's border";
    return false;
  }
  const auto normalised = geometry::normalise(rig.camera, centre);
  if (!normalised) return false;
  reference = *normalised;
  patch.reference_px = centre;
  patch.half_size_px = std::clamp(half_size_px, patch_half_size_min_px, patch_half_size_max_px);
  patch.margin_px = margin_px;
  matcher.swap_full(patch.planes);
  const bool sampled = sample_patch(image, rig.camera, object, patch);
  matcher.swap_full(patch.planes);
  if (!sampled) {
    refusal = "nothing there has any structure";
    return false;
  }
  const PredictedSigma sigma = predicted_sigma(patch, camera_noise_levels);
  if (!(sigma.across_px < predicted_sigma_max_px)) {
    refusal = "nothing there has structure enough to be found again";
    return false;
  }
  if (!(sigma.along_px < std::min(predicted_sigma_max_px, along_by_across_max * sigma.across_px))) {
    refusal =
        "what is there has structure in one direction only: it could be anywhere along an edge";
    return false;
  }
  refusal = "";
  return true;
}

RegistrationResult Registration::State::find(const geometry::View& view_2) {
  const base::ImageView& image = view_2.image;
  if (!chosen) {
    const char* colon = refusal[0] == '\0' ? "" : ": ";
    return {std::nullopt, base::text("no target was chosen%s%s", colon, refusal)};
  }
  if (!fits(image, rig.camera)) {
    return {std::nullopt,
            base::text("view 2 has %d x %d px, the camera model %d x %d", image.width_px,
                       image.height_px, rig.camera.width_px, rig.camera.height_px)};
  }
  if (image.format != patch.format) {
    return {std::nullopt, "view 2 has another pixel format than view 1"};
  }
  if (!geometry::finite(head_1) || !geometry::finite(view_2.head)) {
    return {std::nullopt,
            base::text("head angles are not finite: (%g, %g) and (%g, %g) rad", head_1.yaw_rad,
                       head_1.pitch_rad, view_2.head.yaw_rad, view_2.head.pitch_rad)};
  }
  const PatchMotion motion{geometry::cam2_from_cam1(rig.head, head_1, view_2.head), reference};
  const double range_over_depth = reference.homogeneous().norm();
  const EpipolarSegment segment(motion, rig.camera, range_over_depth / settings.range_max_m,
                                range_over_depth / settings.range_min_m);
  if (!segment.valid()) return {std::nullopt, "the target would be outside view 2's field of view"};
  const double margin_px = search_margin_px(motion);
  if (!segment.any_inside(rig.camera, margin_px)) {
    const geometry::Pixel& at = segment.knot(0);
    return {std::nullopt,
            base::text("the target would be at (%.0f, %.0f), outside the image", at.x(), at.y())};
  }
  return judge(image, motion,
               matcher.run(image, patch, object, motion, rig.camera, segment, margin_px));
}

double Registration::State::search_margin_px(const PatchMotion& motion) const {
  const double trace = motion.cam2_from_cam1.rotation.trace();
  const double turn_rad = std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0));
  // Errors common to both looks cancel, except for the turn between them.
  const double common_rad = turn_rad * std::hypot(rig.uncertainty.zero_sigma_rad,
                                                  rig.uncertainty.mount_rotation_sigma_rad);
  const double sigma_rad =
      std::hypot(std::numbers::sqrt2 * rig.uncertainty.encoder_sigma_rad, common_rad);
  return rig.camera.focal_px.maxCoeff() *
         std::clamp(margin_sigmas * sigma_rad, unreported_error_rad, margin_max_rad);
}

// How far the reference point moves in view 2 when its inverse depth grows by this share.
Eigen::Vector2d Registration::State::by_depth_px(double share, const PatchWarp& warp,
                                                 const PatchMotion& motion) const {
  PatchWarp nearer = warp;
  nearer.inverse_depth_per_m *= 1.0 + share;
  const auto at = motion.reference_in_view_2(rig.camera, warp);
  const auto moved = motion.reference_in_view_2(rig.camera, nearer);
  if (!at || !moved) return Eigen::Vector2d::Zero();
  return *moved - *at;
}

RegistrationResult Registration::State::judge(const base::ImageView& image,
                                              const PatchMotion& motion,
                                              const PatchMatcher::Outcome& outcome) {
  if (!outcome.fit) return {std::nullopt, outcome.reason};
  const WarpFit& fit = *outcome.fit;
  const double x = outcome.pixel_2.x(), y = outcome.pixel_2.y();
  if (!rig.camera.contains(outcome.pixel_2)) {
    return {std::nullopt, base::text("the target is at (%.0f, %.0f), outside the image", x, y)};
  }
  if (fit.visible < visible_share_min) {
    return {std::nullopt,
            base::text("only %.0f %% of the target is inside the image", 100.0 * fit.visible)};
  }
  if (!fit.converged) {
    return {std::nullopt, base::text("the match at (%.1f, %.1f) did not converge, correlation %.2f",
                                     x, y, fit.correlation)};
  }
  if (!(fit.correlation >= settings.correlation_min)) {
    return {std::nullopt, base::text("correlation %.2f at (%.1f, %.1f) is below %.2f",
                                     fit.correlation, x, y, settings.correlation_min)};
  }
  if (!(fit.gain >= contrast_ratio_min && fit.gain <= contrast_ratio_max)) {
    return {std::nullopt,
            base::text("the contrast at (%.1f, %.1f) is %.2f times the target's", x, y, fit.gain)};
  }
  const Eigen::Vector3d contrast =
      colour_contrast(image, patch.levels[0].samples, matcher.pixels_2());
  const double cosine = contrast.normalized().dot(patch.contrast.normalized());
  if (!(cosine >= colour_cosine_min)) {
    return {std::nullopt,
            base::text(
                "what is at (%.1f, %.1f) has another colour: its contrast differs by %.0f degrees",
                x, y, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi)};
  }
  if (!slopes.believe(fit.warp, motion)) {
    return {std::nullopt,
            base::text("what is at (%.1f, %.1f) has the target's shape squeezed, as in no look "
                       "before: something may cover a part of it",
                       x, y)};
  }
  RegistrationResult result;
  PatchMatch& match = result.match.emplace();
  ball.see(fit, motion);
  match.pixel_2 = outcome.pixel_2 + by_depth_px(-ball.centre_correction(), fit.warp, motion);
  const Eigen::Vector2d shape_sigma_px =
      by_depth_px(same_in_all_looks * ball.centre_correction_sigma(), fit.warp, motion);
  const double model_sigma_px =
      std::hypot(sampling_sigma_px, background_sigma_px * fit.background_change);
  match.covariance_px2 = fit.covariance_px2 +
                         model_sigma_px * model_sigma_px * Eigen::Matrix2d::Identity() +
                         shape_sigma_px * shape_sigma_px.transpose();
  match.correlation = fit.correlation;
  match.scale = motion.scale(fit.warp);
  Eigen::Matrix2d scaled = match.covariance_px2, axes;
  geometry::decompose(scaled, axes);
  const double sigma_px = std::sqrt(scaled.col(1).norm());
  if (sigma_px > edge_only_sigma_px) {
    const Eigen::Vector2d along = axes.col(1);
    result.reason = base::text("structure in one direction only: sigma %.1f px along (%.2f, %.2f)",
                               sigma_px, along.x(), along.y());
  }
  return result;
}

}  // namespace gazed::tracking
