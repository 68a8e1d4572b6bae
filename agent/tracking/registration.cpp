#include "agent/tracking/registration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/geometry/singular_values.hpp"
#include "agent/tracking/mark.hpp"
#include "agent/tracking/matcher.hpp"
#include "agent/tracking/target.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

namespace {

// If no area stands out, squares of texture are tried, the smallest first.
constexpr std::array texture_half_sizes_px = {24, 48, 96};

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
  std::array<Target, 2> targets;
  Target* target = &targets[0];
  Target* mark = &targets[1];  // on the target, or in front of it
  bool has_mark = false;
  PatchMatcher matcher;
  const char* refusal = "";  // why no target was chosen

  bool choose(const base::ImageView& image, const geometry::Pixel& salient);
  RegistrationResult find(const geometry::View& view_2);
  struct Found {
    RegistrationResult result;
    std::optional<WarpFit> fit;
    PatchMotion motion;
  };
  Found find(Target& sought, const geometry::View& view_2);
  void prefer_what_is_in_front(const geometry::View& view_2, Found& found);
  double search_margin_px(const PatchMotion& motion) const;
  Eigen::Vector2d by_depth_px(double share, const PatchWarp& warp, const PatchMotion& motion) const;
  RegistrationResult judge(Target& sought, const base::ImageView& image, const PatchMotion& motion,
                           const PatchMatcher::Outcome& outcome);
};

Registration::Registration(const geometry::Rig& rig, const RegistrationSettings& settings)
    : state_(std::make_unique<State>()) {
  check(settings, rig.camera);
  state_->settings = settings;
  state_->rig = rig;
  state_->target->patch.reserve();
  state_->mark->patch.reserve();
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
  state.chosen = fits(view_1.image, state.rig.camera) && state.rig.camera.contains(salient) &&
                 state.choose(view_1.image, salient);
  if (!state.chosen) return std::nullopt;
  return state.target->patch.reference_px;
}

std::optional<geometry::Pixel> Registration::mark() const {
  if (!state_->chosen || !state_->has_mark) return std::nullopt;
  return state_->mark->patch.reference_px;
}

const char* Registration::refusal() const {
  return state_->refusal;
}

double Registration::half_size_px() const {
  return state_->target->patch.half_size_px;
}

Outline Registration::outline() const {
  const Target& target = *state_->target;
  const geometry::Pixel& inside = target.patch.reference_px;
  return outline_of(target.object, inside,
                    std::numbers::sqrt2 * target.object.half_size_px(inside));
}

void Registration::believe(const geometry::HeadGeometry& head) {
  state_->rig.head = head;
}

RegistrationResult Registration::find(const geometry::View& view_2) {
  return state_->find(view_2);
}

bool Registration::State::choose(const base::ImageView& image, const geometry::Pixel& salient) {
  has_mark = false;
  const auto taken = [this](const char* why_not) { return (refusal = why_not)[0] == '\0'; };
  if (target->object.segment(image, salient) &&
      taken(target->take_object(image, rig.camera, matcher))) {
    has_mark = mark->object.take_mark_on(target->object, image, salient) &&
               mark->take_object(image, rig.camera, matcher)[0] == '\0';
    return true;
  }
  return std::any_of(texture_half_sizes_px.begin(), texture_half_sizes_px.end(), [&](int half) {
    return taken(target->take_square(image, rig.camera, matcher, salient, half));
  });
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
  if (image.format != target->patch.format) {
    return {std::nullopt, "view 2 has another pixel format than view 1"};
  }
  if (!geometry::finite(head_1) || !geometry::finite(view_2.head)) {
    return {std::nullopt,
            base::text("head angles are not finite: (%g, %g) and (%g, %g) rad", head_1.yaw_rad,
                       head_1.pitch_rad, view_2.head.yaw_rad, view_2.head.pitch_rad)};
  }
  Found found = find(*target, view_2);
  if (has_mark) prefer_what_is_in_front(view_2, found);
  return std::move(found.result);
}

Registration::State::Found Registration::State::find(Target& sought, const geometry::View& view_2) {
  Found found;
  const PatchMotion& motion =
      found.motion = {geometry::cam2_from_cam1(rig.head, head_1, view_2.head), sought.reference};
  const double range_over_depth = sought.reference.homogeneous().norm();
  const EpipolarSegment segment(motion, rig.camera, range_over_depth / settings.range_max_m,
                                range_over_depth / settings.range_min_m);
  if (!segment.valid()) {
    found.result.reason = "the target would be outside view 2's field of view";
    return found;
  }
  const double margin_px = search_margin_px(motion);
  if (!segment.any_inside(rig.camera, margin_px)) {
    const geometry::Pixel& at = segment.knot(0);
    found.result.reason =
        base::text("the target would be at (%.0f, %.0f), outside the image", at.x(), at.y());
    return found;
  }
  const PatchMatcher::Outcome outcome = matcher.run(view_2.image, sought.patch, sought.object,
                                                    motion, rig.camera, segment, margin_px);
  found.result = judge(sought, view_2.image, motion, outcome);
  found.fit = outcome.fit;
  return found;
}

/// The first view that finds the object decides: what later views show must be what this one does.
void Registration::State::prefer_what_is_in_front(const geometry::View& view_2, Found& found) {
  if (!found.result.match) return;
  has_mark = false;
  Found of_mark = find(*mark, view_2);
  const auto& match = of_mark.result.match;
  const ObjectSeen object{*target, *found.result.match, *found.fit, found.motion};
  if (!match || !is_in_front(*mark, *match, object, rig.camera)) return;
  std::swap(target, mark);
  found = std::move(of_mark);
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

RegistrationResult Registration::State::judge(Target& sought, const base::ImageView& image,
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
      colour_contrast(image, sought.patch.levels[0].samples, matcher.pixels_2());
  const double cosine = contrast.normalized().dot(sought.patch.contrast.normalized());
  if (!(cosine >= colour_cosine_min)) {
    return {std::nullopt,
            base::text(
                "what is at (%.1f, %.1f) has another colour: its contrast differs by %.0f degrees",
                x, y, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi)};
  }
  if (!sought.slopes.believe(fit.warp, motion)) {
    return {std::nullopt,
            base::text("what is at (%.1f, %.1f) has the target's shape squeezed, as in no look "
                       "before: something may cover a part of it",
                       x, y)};
  }
  RegistrationResult result;
  PatchMatch& match = result.match.emplace();
  BelievedBall& ball = sought.ball;
  ball.see(fit, motion);
  match.pixel_1 = sought.patch.reference_px;
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
