// Why not OpenCV. goodFeaturesToTrack is in imgproc, calcOpticalFlowPyrLK in video. The shared
// video library pulls in calib3d and dnn: 29 libraries and 20.7 MB resident for two calls on one
// 640 x 480 frame. The static archives avoid that, but still cost 14 MB resident and 3.8 MB of code
// (Debian's OpenCV 4.6), most of the daemon's 16 MB, and Debian builds them for i386 without SSE.
// The calls also do too little: LK does not warp its patch by the known turn (a corner seen at the
// opposite edge is stretched by 1/cos^2), and it knows neither epipolar lines nor exposure changes.
// The code here is 60 KB and holds 2 MB. On the same core it takes 1.0 ms to choose
// (goodFeaturesToTrack: 3.5 ms) and 1.5 ms to follow 100 corners forth and back (LK: 1.3 ms).
#include "agent/tracking/background.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/tracking/coarse_search.hpp"
#include "agent/tracking/corner_tracker.hpp"
#include "agent/tracking/corners.hpp"
#include "agent/tracking/luma.hpp"
#include "agent/tracking/prediction.hpp"
#include "agent/tracking/rigidity.hpp"
#include "agent/tracking/row_motion.hpp"

namespace gazed::tracking {

namespace {

constexpr int size_min_px = 64;
constexpr int corner_level = 1;
constexpr int coarse_level = 2;

// Nothing in the background is nearer than this.
constexpr double inverse_depth_max_per_m = 5.0;
// Shapes the coarse patch before any depth is known.
constexpr double inverse_depth_typical_per_m = 0.5;

// The common shift is searched within this many standard deviations, and at least within
// turn_error_min_rad: time stamps and backlash add to the encoders' stated error.
constexpr double shift_sigmas = 3.0, turn_error_min_rad = 0.02;
constexpr double mount_reach_rad = 0.03;  // none of 17 V6 heads exceeds four times this
// Pixels away from the middle of the frame shift more: a turn moves them by 1 + tan^2.
constexpr double shift_growth = 1.2;
// Half width of the strip searched along the line once the common shift is known, in coarse
// samples.
constexpr float strip_half_width = 1.25F;

// A patch is dropped when its misfit (variance of grey levels) exceeds this many times the median
// plus the cost of being misfit_px off everywhere: sampling and slant errors show first at steep
// places.
constexpr float misfit_ratio_max = 9.0F, misfit_px = 0.05F;

}  // namespace

struct Background::State {
  explicit State(const geometry::Rig& believed)
      : rig(believed),
        view_1(rig.camera.width_px, rig.camera.height_px),
        view_2(rig.camera.width_px, rig.camera.height_px),
        picker(view_1.level(corner_level).width, view_1.level(corner_level).height),
        search(view_1.level(coarse_level).width, view_1.level(coarse_level).height) {}

  // A corner chosen in look 1.
  struct Feature {
    // in view 1, as if exposed with the middle row
    Eigen::Vector2d normalised = Eigen::Vector2d::Zero();
    double sigma = 0.0;  // of `normalised`, from the rolling shutter
    std::array<double, triangulation::looks_max> variance_px2{};  // 0: not seen in that look
  };
  // A feature that may be visible in the later look's view.
  struct Candidate {
    std::size_t feature = 0;
    Prediction prediction;
  };
  struct Found {
    std::size_t feature = 0;
    TrackedCorner corner;
  };

  [[nodiscard]] bool fits(const base::ImageView& image) const {
    return !image.empty() && image.width_px == rig.camera.width_px &&
           image.height_px == rig.camera.height_px;
  }
  [[nodiscard]] double shift_reach_px() const;
  void predict(double margin_px);
  std::optional<TrackedCorner> track(std::size_t candidate, const Eigen::Vector2f& shift);
  void find_all(const Eigen::Vector2f& shift);
  void drop_misfits();
  void drop_moving(const geometry::View& seen);
  void keep(const Found& found_one, std::size_t look);

  geometry::Rig rig;
  LumaPyramid view_1, view_2;
  CornerPicker picker;
  CoarseSearch search;
  CornerTracker tracker;

  geometry::HeadAngles head_1;
  std::size_t count = 0;
  std::array<Corner, triangulation::features_max> corners;
  std::array<Feature, triangulation::features_max> features;
  std::array<triangulation::FeatureObservations, triangulation::features_max> observations;

  // For the look being followed.
  geometry::Pose cam2_from_cam1;
  std::size_t candidate_count = 0, found_count = 0;
  std::array<Candidate, triangulation::features_max> candidates;
  std::array<CoarseQuery, triangulation::features_max> queries;  // one per candidate
  std::array<Found, triangulation::features_max> found;
  std::array<PointPair, triangulation::features_max> pairs;
};

// How far an error of the turn may move the whole picture.
double Background::State::shift_reach_px() const {
  const double turn =
      std::acos(std::clamp(0.5 * (cam2_from_cam1.rotation.trace() - 1.0), -1.0, 1.0));
  const double f = rig.camera.focal_px.maxCoeff();
  const double encoders = std::sqrt(2.0) * rig.uncertainty.encoder_sigma_rad;
  const double mount = turn * std::min(rig.uncertainty.mount_rotation_sigma_rad, mount_reach_rad);
  const double focal = turn * rig.uncertainty.focal_sigma_px / f;
  const double sigma = std::sqrt(encoders * encoders + mount * mount + focal * focal);
  const double reach = shift_growth * f * std::max(shift_sigmas * sigma, turn_error_min_rad);
  const double reach_max = CoarseSearch::reach_max * view_1.level(coarse_level).step_px;
  return std::min(reach, reach_max);
}

// Predicts which features may be in view, and warps their patches to how they look there.
void Background::State::predict(double margin_px) {
  const LumaLevel& level = view_1.level(coarse_level);
  candidate_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& normalised = features[i].normalised;
    const auto prediction = Prediction::make(rig.camera, cam2_from_cam1, normalised,
                                             inverse_depth_max_per_m, margin_px);
    if (!prediction) continue;
    const Eigen::Matrix2f back =
        pixel_2_by_pixel_1(rig.camera, cam2_from_cam1, normalised, inverse_depth_typical_per_m)
            .inverse()
            .cast<float>();
    const auto samples = [&](const Eigen::Vector2d& pixels) {
      return Eigen::Vector2f((pixels / level.step_px).cast<float>());
    };
    CoarseQuery& query = queries[candidate_count];
    if (!read_warped<coarse_side>(level, samples(observations[i].pixel[0]), back,
                                  query.patch.value.data()) ||
        !normalise(query.patch)) {
      continue;
    }
    query.far = samples(prediction->far_px()).array() - coarse_centre;
    query.span = samples(prediction->span_px());
    candidates[candidate_count++] = {i, *prediction};
  }
}

std::optional<TrackedCorner> Background::State::track(std::size_t candidate,
                                                      const Eigen::Vector2f& shift) {
  const auto& [feature, prediction] = candidates[candidate];
  const CoarseQuery& query = queries[candidate];
  const auto peaks = search.peaks(query, shift, strip_half_width);
  if (peaks.empty()) return std::nullopt;
  std::array<geometry::Pixel, CoarseSearch::peaks_max> starts;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    starts[i] = (peaks[i].place.array() + coarse_centre).cast<double>() *
                view_2.level(coarse_level).step_px;
  }
  // Warps the patch again, now for the depth that the best place implies.
  const float length2 = query.span.squaredNorm();
  const float share =
      length2 > 0.0F ? (peaks[0].place - shift - query.far).dot(query.span) / length2 : 0.0F;
  const Eigen::Matrix2d shape =
      pixel_2_by_pixel_1(rig.camera, cam2_from_cam1, features[feature].normalised,
                         prediction.inverse_depth_at(static_cast<double>(share)));
  return tracker.track(view_1, view_2, observations[feature].pixel[0], shape,
                       std::span(starts).first(peaks.size()));
}

void Background::State::find_all(const Eigen::Vector2f& shift) {
  found_count = 0;
  for (std::size_t i = 0; i < candidate_count; ++i) {
    if (const auto corner = track(i, shift))
      found[found_count++] = {candidates[i].feature, *corner};
  }
}

// Drops patches that fit much worse than the rest: they also contain something else, as at the edge
// of a nearer object.
void Background::State::drop_misfits() {
  if (found_count == 0) return;
  std::array<float, triangulation::features_max> misfits{};
  for (std::size_t i = 0; i < found_count; ++i) misfits[i] = found[i].corner.misfit;
  const auto middle = misfits.begin() + static_cast<std::ptrdiff_t>(found_count / 2);
  std::nth_element(misfits.begin(), middle,
                   misfits.begin() + static_cast<std::ptrdiff_t>(found_count));
  const float common = misfit_ratio_max * *middle;
  const auto end = std::remove_if(
      found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found_count),
      [common](const Found& one) {
        return one.corner.misfit > common + misfit_px * misfit_px * one.corner.steepness;
      });
  found_count = static_cast<std::size_t>(end - found.begin());
}

// Drops features whose motion the head's turn does not explain.
void Background::State::drop_moving(const geometry::View& seen) {
  const RowMotion motion(rig.head, seen);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found_count; ++i) {
    const geometry::Pixel& pixel = found[i].corner.pixel_2;
    const auto normalised_2 = geometry::normalise(rig.camera, pixel);
    if (!normalised_2) continue;
    const Feature& feature = features[found[i].feature];
    const double tracking_sigma =
        std::sqrt(found[i].corner.variance_px2) / rig.camera.focal_px.mean();
    found[kept] = found[i];
    pairs[kept++] = {feature.normalised, motion.undone(*normalised_2, pixel.y()),
                     std::hypot(tracking_sigma, feature.sigma, motion.sigma(pixel.y())), true};
  }
  const double angle_sigma_rad = std::max(rig.uncertainty.encoder_sigma_rad, turn_error_min_rad);
  mark_rigid(rig.head, head_1, seen.head, angle_sigma_rad, std::span(pairs).first(kept));
  found_count = 0;
  for (std::size_t i = 0; i < kept; ++i) {
    if (pairs[i].rigid) found[found_count++] = found[i];
  }
}

void Background::State::keep(const Found& found_one, std::size_t look) {
  triangulation::FeatureObservations& observed = observations[found_one.feature];
  observed.pixel[look] = found_one.corner.pixel_2;
  auto& all_px2 = features[found_one.feature].variance_px2;
  all_px2[look] = found_one.corner.variance_px2;
  const auto seen = all_px2.size() - static_cast<std::size_t>(std::ranges::count(all_px2, 0.0));
  const double sum_px2 = std::accumulate(all_px2.begin(), all_px2.end(), 0.0);
  observed.sigma_px = std::sqrt(sum_px2 / static_cast<double>(seen));
}

Background::Background(const geometry::Rig& rig) {
  const geometry::CameraModel& camera = rig.camera;
  if (!(camera.focal_px.minCoeff() > 0.0)) {
    throw std::invalid_argument(base::text("focal length (%g, %g) px found; allowed: positive",
                                           camera.focal_px.x(), camera.focal_px.y()));
  }
  if (camera.width_px < size_min_px || camera.height_px < size_min_px) {
    throw std::invalid_argument(base::text("image size %d x %d px found; allowed: %d x %d or more",
                                           camera.width_px, camera.height_px, size_min_px,
                                           size_min_px));
  }
  state_ = std::make_unique<State>(rig);
}
Background::~Background() = default;
Background::Background(Background&&) noexcept = default;
Background& Background::operator=(Background&&) noexcept = default;

std::size_t Background::choose(const geometry::View& view_1, const geometry::Pixel& target,
                               double target_radius_px) {
  State& state = *state_;
  state.count = 0;
  if (!state.fits(view_1.image)) return 0;
  state.head_1 = view_1.head;
  const RowMotion motion(state.rig.head, view_1);
  state.view_1.build(view_1.image);
  const LumaLevel& level = state.view_1.level(corner_level);
  const auto pixel_of = [&](int column, int row) {
    return geometry::Pixel(column * level.step_px, row * level.step_px);
  };
  const std::size_t picked = state.picker.pick(level, state.corners, [&](int column, int row) {
    return !((pixel_of(column, row) - target).norm() < target_radius_px);
  });
  for (const Corner& corner : std::span(state.corners).first(picked)) {
    const geometry::Pixel pixel = pixel_of(corner.column, corner.row);
    const auto normalised = geometry::normalise(state.rig.camera, pixel);
    if (!normalised) continue;
    state.features[state.count] = {.normalised = motion.undone(*normalised, pixel.y()),
                                   .sigma = motion.sigma(pixel.y())};
    triangulation::FeatureObservations& observed = state.observations[state.count++];
    observed = triangulation::FeatureObservations();
    observed.pixel[0] = pixel;
  }
  return state.count;
}

std::size_t Background::follow(const geometry::View& view, std::size_t look) {
  State& state = *state_;
  if (look == 0 || look >= triangulation::looks_max) {
    throw std::invalid_argument(
        base::text("look %zu found; allowed: 1 to %zu", look, triangulation::looks_max - 1));
  }
  for (std::size_t i = 0; i < state.count; ++i) {
    state.features[i].variance_px2[look] = 0.0;
    state.observations[i].pixel[look].setConstant(triangulation::not_a_number);
  }
  if (!state.fits(view.image)) return 0;
  state.cam2_from_cam1 = geometry::cam2_from_cam1(state.rig.head, state.head_1, view.head);
  const double reach_px = state.shift_reach_px();
  state.predict(reach_px);
  if (state.candidate_count == 0) return 0;
  state.view_2.build(view.image);
  const LumaLevel& level = state.view_2.level(coarse_level);
  state.search.view().set(level);
  const Eigen::Vector2f shift =
      state.search.common_shift(std::span(state.queries).first(state.candidate_count),
                                static_cast<int>(std::ceil(reach_px / level.step_px)));
  state.find_all(shift);
  state.drop_misfits();
  state.drop_moving(view);
  for (std::size_t i = 0; i < state.found_count; ++i) state.keep(state.found[i], look);
  return state.found_count;
}

void Background::believe(const geometry::HeadGeometry& head) {
  state_->rig.head = head;
}

std::span<const triangulation::FeatureObservations> Background::features() const {
  return {state_->observations.data(), state_->count};
}

}  // namespace gazed::tracking
