#include "agent/target/background.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "agent/target/coarse_search.hpp"
#include "agent/target/corners.hpp"
#include "agent/target/flow.hpp"
#include "agent/target/luma.hpp"
#include "agent/target/prediction.hpp"
#include "agent/text.hpp"

namespace gazed {

namespace {

constexpr int size_min_px = 64;
constexpr int corner_level = 1;
constexpr int coarse_level = 2;

// The nearest thing that is background: nearer ones are seen wherever this one may be.
constexpr double inverse_depth_max_per_m = 5.0;
// For the shape of the coarse patch, before any depth is known.
constexpr double inverse_depth_typical_per_m = 0.5;

// The common shift is looked for up to so many of its standard deviations, and never less than
// turn_error_min_rad: time stamps and play add to what the encoders are believed to do.
constexpr double shift_sigmas = 3.0;
constexpr double turn_error_min_rad = 0.02;
// Of shifts from the middle of the frame to its corners: a turn moves pixels by 1 + tan^2.
constexpr double shift_growth = 1.2;
// What is left beside the line when the common shift is known, samples of the coarse level.
constexpr float strip_half_width = 2.0F;

// How far the finer levels may go from where the coarser put them, samples.
constexpr float middle_reach = 3.0F, fine_reach = 2.0F;
constexpr float middle_correlation_min = 0.7F, fine_correlation_min = 0.8F;
// Another place that is as like the patch to within this: ambiguous.
constexpr float ambiguity_margin = 0.04F;
constexpr double same_place_px = 2.0;
// Forward and back again (Kalal, Mikolajczyk, Matas, ICPR 2010).
constexpr double round_trip_max_px = 0.4;

// White noise in the frame is no longer white after the smoothing and reading of both views, and
// slopes are weaker.
constexpr double noise_correlation = 6.0;
// What sampling leaves.
constexpr double sampling_sigma_px = 0.03;

Eigen::Vector2f samples(const Pixel& pixel, const LumaLevel& level) {
  return (pixel / level.step_px).cast<float>();
}
Pixel pixels(const Eigen::Vector2f& at, const LumaLevel& level) {
  return at.cast<double>() * level.step_px;
}

}  // namespace

struct Background::State {
  CameraModel camera;
  HeadGeometry head;
  Uncertainty uncertainty;
  LumaPyramid view_1, view_2;
  CornerPicker picker;
  CoarseSearch search;
  HeadAngles head_1;

  std::size_t count = 0;
  std::array<FeatureTrack, features_max> tracks;
  std::array<Corner, features_max> corners;
  std::array<Eigen::Vector2d, features_max> normalised;  // in view 1
  std::array<double, features_max> variance_sum{};       // over the looks that saw it, px^2
  std::array<int, features_max> seen{};                  // how many did

  // Of the look being followed: those that may be in view, and their features.
  std::array<CoarseQuery, features_max> queries;
  std::array<Prediction, features_max> predictions;
  std::array<std::size_t, features_max> feature_of_query{};
  std::size_t query_count = 0;
  FlowTemplate<8> middle_patch;
  FlowTemplate<12> fine_patch;

  State(const CameraModel& c, const HeadGeometry& h, const Uncertainty& u)
      : camera(c),
        head(h),
        uncertainty(u),
        view_1(c.width_px, c.height_px),
        view_2(c.width_px, c.height_px),
        picker(view_1.level(corner_level).width, view_1.level(corner_level).height),
        search(view_1.level(coarse_level).width, view_1.level(coarse_level).height) {}

  [[nodiscard]] bool fits(const ImageView& image) const {
    return !image.empty() && image.width_px == camera.width_px &&
           image.height_px == camera.height_px;
  }
  [[nodiscard]] double shift_reach_px(const Pose& cam2_from_cam1) const;
  void predict(const Pose& cam2_from_cam1, double margin_px);
  struct Found {
    Pixel pixel;
    double variance_px2;
  };
  std::optional<Found> track(std::size_t query, const Pose& cam2_from_cam1,
                             const Eigen::Vector2f& shift);
};

// How far a wrong turn may move the whole picture.
double Background::State::shift_reach_px(const Pose& cam2_from_cam1) const {
  const double turn =
      std::acos(std::clamp(0.5 * (cam2_from_cam1.rotation.trace() - 1.0), -1.0, 1.0));
  const double f = camera.focal_px.maxCoeff();
  const double encoders = std::sqrt(2.0) * uncertainty.encoder_sigma_rad;
  const double mount = turn * uncertainty.mount_rotation_sigma_rad;
  const double focal = turn * uncertainty.focal_sigma_px / f;
  const double sigma = std::sqrt(encoders * encoders + mount * mount + focal * focal);
  return shift_growth * f * std::max(shift_sigmas * sigma, turn_error_min_rad);
}

// The features that may be in view, with their patches as they look there.
void Background::State::predict(const Pose& cam2_from_cam1, double margin_px) {
  const LumaLevel& level = view_1.level(coarse_level);
  query_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto prediction =
        Prediction::make(camera, cam2_from_cam1, normalised[i], inverse_depth_max_per_m, margin_px);
    if (!prediction) continue;
    const Eigen::Matrix2d shape =
        pixel_2_by_pixel_1(camera, cam2_from_cam1, normalised[i], inverse_depth_typical_per_m);
    CoarseQuery& query = queries[query_count];
    if (!read_warped<coarse_side>(level, samples(tracks[i].pixel[0], level),
                                  shape.inverse().cast<float>(), query.patch.value.data()) ||
        !normalise(query.patch)) {
      continue;
    }
    query.far = samples(prediction->far_px(), level).array() - 0.5F * (coarse_side - 1);
    query.span = samples(prediction->span_px(), level);
    predictions[query_count] = *prediction;
    feature_of_query[query_count++] = i;
  }
}

std::optional<Background::State::Found> Background::State::track(std::size_t q,
                                                                 const Pose& cam2_from_cam1,
                                                                 const Eigen::Vector2f& shift) {
  const std::size_t feature = feature_of_query[q];
  const CoarseQuery& query = queries[q];
  const Pixel& pixel_1 = tracks[feature].pixel[0];
  const auto peaks = search.peaks(query, shift, strip_half_width);
  if (peaks.empty()) return std::nullopt;

  // The shape at the depth that the best place means.
  const float span2 = query.span.squaredNorm();
  const float share =
      span2 > 0.0F ? (peaks[0].place - shift - query.far).dot(query.span) / span2 : 0.0F;
  const Eigen::Matrix2d shape =
      pixel_2_by_pixel_1(camera, cam2_from_cam1, normalised[feature],
                         predictions[q].inverse_depth_at(static_cast<double>(share)));
  const Eigen::Matrix2f back = shape.inverse().cast<float>();

  const LumaLevel &middle_1 = view_1.level(corner_level), &middle_2 = view_2.level(corner_level);
  if (!make_template(middle_1, samples(pixel_1, middle_1), back, middle_patch)) {
    return std::nullopt;
  }
  std::optional<Flow> best;
  float second = 0.0F;
  for (const CoarsePeak& peak : peaks) {
    const Eigen::Vector2f start = 2.0F * (peak.place.array() + 0.5F * (coarse_side - 1));
    const auto flow = find_patch(middle_patch, middle_2, start, middle_reach);
    if (!flow) continue;
    if (best && 2.0 * (flow->at - best->at).norm() < same_place_px) continue;
    if (!best || flow->correlation > best->correlation) {
      second = best ? best->correlation : 0.0F;
      best = flow;
    } else {
      second = std::max(second, flow->correlation);
    }
  }
  if (!best || best->correlation < middle_correlation_min ||
      second > best->correlation - ambiguity_margin) {
    return std::nullopt;
  }

  const LumaLevel &fine_1 = view_1.level(0), &fine_2 = view_2.level(0);
  if (!make_template(fine_1, samples(pixel_1, fine_1), back, fine_patch)) return std::nullopt;
  const Pixel start = pixels(best->at, middle_2);
  const auto fine = find_patch(fine_patch, fine_2, samples(start, fine_2), fine_reach);
  if (!fine || fine->correlation < fine_correlation_min) return std::nullopt;
  const Pixel pixel_2 = pixels(fine->at, fine_2);

  // And back, as wrong at the start as on the way here.
  if (!make_template(fine_2, fine->at, shape.cast<float>(), fine_patch)) return std::nullopt;
  const Pixel back_start = pixel_1 + back.cast<double>() * (pixel_2 - start);
  const auto returned = find_patch(fine_patch, fine_1, samples(back_start, fine_1), fine_reach);
  if (!returned || (pixels(returned->at, fine_1) - pixel_1).norm() > round_trip_max_px) {
    return std::nullopt;
  }
  return Found{pixel_2, noise_correlation * static_cast<double>(fine->variance) +
                            sampling_sigma_px * sampling_sigma_px};
}

Background::Background(const CameraModel& camera, const HeadGeometry& head,
                       const Uncertainty& uncertainty) {
  if (!(camera.focal_px.minCoeff() > 0.0)) {
    throw std::invalid_argument(text("focal length (%g, %g) px found; allowed: positive",
                                     camera.focal_px.x(), camera.focal_px.y()));
  }
  if (camera.width_px < size_min_px || camera.height_px < size_min_px) {
    throw std::invalid_argument(text("image size %d x %d px found; allowed: %d x %d or more",
                                     camera.width_px, camera.height_px, size_min_px, size_min_px));
  }
  state_ = std::make_unique<State>(camera, head, uncertainty);
}
Background::~Background() = default;
Background::Background(Background&&) noexcept = default;
Background& Background::operator=(Background&&) noexcept = default;

std::size_t Background::choose(const View& view_1, const Pixel& target, double target_radius_px) {
  State& state = *state_;
  state.count = 0;
  if (!state.fits(view_1.image)) return 0;
  state.head_1 = view_1.head;
  state.view_1.build(view_1.image);
  const LumaLevel& level = state.view_1.level(corner_level);
  const auto pixel_of_sample = [&](int column, int row) {
    return Pixel(column * level.step_px, row * level.step_px);
  };
  const std::size_t picked = state.picker.pick(level, state.corners, [&](int column, int row) {
    return !((pixel_of_sample(column, row) - target).norm() < target_radius_px);
  });
  for (const Corner& corner : std::span(state.corners).first(picked)) {
    const Pixel pixel = pixel_of_sample(corner.column, corner.row);
    const auto normalised = normalise(state.camera, pixel);
    if (!normalised) continue;
    state.normalised[state.count] = *normalised;
    state.variance_sum[state.count] = 0.0;
    state.seen[state.count] = 0;
    FeatureTrack& track = state.tracks[state.count++];
    track = FeatureTrack();
    track.pixel[0] = pixel;
  }
  return state.count;
}

std::size_t Background::follow(const View& view, std::size_t look) {
  State& state = *state_;
  if (look == 0 || look >= looks_max) {
    throw std::invalid_argument(text("look %zu found; allowed: 1 to %zu", look, looks_max - 1));
  }
  if (!state.fits(view.image) || state.count == 0) return 0;
  const Pose cam2_from_cam1 = gazed::cam2_from_cam1(state.head, state.head_1, view.head);
  const double reach_px = state.shift_reach_px(cam2_from_cam1);
  state.predict(cam2_from_cam1, reach_px);
  if (state.query_count == 0) return 0;
  state.view_2.build(view.image);
  const LumaLevel& level = state.view_2.level(coarse_level);
  state.search.view().set(level);
  const Eigen::Vector2f shift =
      state.search.common_shift(std::span(state.queries).first(state.query_count),
                                static_cast<int>(std::ceil(reach_px / level.step_px)));
  std::size_t found = 0;
  for (std::size_t q = 0; q < state.query_count; ++q) {
    const auto place = state.track(q, cam2_from_cam1, shift);
    if (!place) continue;
    const std::size_t i = state.feature_of_query[q];
    FeatureTrack& track = state.tracks[i];
    track.pixel[look] = place->pixel;
    state.variance_sum[i] += place->variance_px2;
    track.sigma_px = std::sqrt(state.variance_sum[i] / ++state.seen[i]);
    ++found;
  }
  return found;
}

std::span<const FeatureTrack> Background::tracks() const {
  return {state_->tracks.data(), state_->count};
}

}  // namespace gazed
