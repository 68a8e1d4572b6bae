#include "agent/lab/calibration/delay.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "agent/base/strict_toml.hpp"
#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"
#include "agent/lab/calibration/head_pictures.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"
#include "drivers/log/log_reader.hpp"

namespace gazed::lab::calibration {

namespace {

/// A point of the scene in two frames.
struct Flow {
  geometry::Pixel before, after;
};

struct FramePair {
  std::int64_t before_us = 0, after_us = 0;
  std::vector<Flow> flows;
};

/// The head's angles at any time of the recording.
class HeadCourse {
 public:
  HeadCourse(const std::filesystem::path& log, const lcm::Channels& channels) {
    log::LogHead head(log.string(), channels);
    while (!head.finished()) {
      const auto state = head.next_state();
      if (!state) continue;
      if (!states_.empty() && state->utime_us <= states_.back().utime_us) continue;
      states_.push_back(*state);
    }
  }

  /// None outside the recording, and where nothing was measured for long.
  [[nodiscard]] std::optional<geometry::HeadAngles> at(double utime_us) const {
    const auto after = std::ranges::lower_bound(
        states_, utime_us, {},
        [](const geometry::HeadState& state) { return static_cast<double>(state.utime_us); });
    if (after == states_.begin() || after == states_.end()) return std::nullopt;
    const geometry::HeadState &a = *(after - 1), &b = *after;
    constexpr std::int64_t longest_gap_us = 100'000;
    if (b.utime_us - a.utime_us > longest_gap_us) return std::nullopt;
    const double share =
        (utime_us - static_cast<double>(a.utime_us)) / static_cast<double>(b.utime_us - a.utime_us);
    const geometry::HeadAngles move = b.measured - a.measured;
    return a.measured + geometry::HeadAngles{share * move.yaw_rad, share * move.pitch_rad};
  }

 private:
  std::vector<geometry::HeadState> states_;
};

std::vector<Flow> flows_between(const cv::Mat& before, const cv::Mat& after) {
  constexpr int corners_a_frame = 80, side_px = 21, levels = 4;
  constexpr double quality = 0.02, apart_px = 20.0, there_and_back_px = 0.3;
  std::vector<cv::Point2f> from, to, back;
  cv::goodFeaturesToTrack(before, from, corners_a_frame, quality, apart_px);
  if (from.empty()) return {};
  std::vector<std::uint8_t> found, found_back;
  std::vector<float> error;
  const cv::Size window(side_px, side_px);
  cv::calcOpticalFlowPyrLK(before, after, from, to, found, error, window, levels);
  cv::calcOpticalFlowPyrLK(after, before, to, back, found_back, error, window, levels);
  std::vector<Flow> flows;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (found[i] == 0 || found_back[i] == 0) continue;
    if (cv::norm(back[i] - from[i]) > there_and_back_px) continue;
    flows.push_back({{from[i].x, from[i].y}, {to[i].x, to[i].y}});
  }
  return flows;
}

/// Frames one after the other between which the head moved.
std::vector<FramePair> moving_pairs(log::LogCamera& camera, const HeadCourse& course) {
  constexpr double least_move_rad = 0.01, greatest_move_rad = 0.25;
  constexpr std::int64_t longest_us = 250'000;
  constexpr std::size_t most_pairs = 300, fewest_flows = 8;
  std::vector<FramePair> pairs;
  cv::Mat before;
  std::int64_t before_us = 0;
  while (!camera.finished() && pairs.size() < most_pairs) {
    const auto frame = camera.next_frame();
    if (!frame) continue;
    cv::Mat grey = grey_of(frame->image);
    const auto a = course.at(static_cast<double>(before_us));
    const auto b = course.at(static_cast<double>(frame->utime_us));
    const double move_rad = a && b ? geometry::greatest_difference(*a, *b) : 0.0;
    if (!before.empty() && frame->utime_us - before_us <= longest_us &&
        move_rad >= least_move_rad && move_rad <= greatest_move_rad) {
      FramePair pair{before_us, frame->utime_us, flows_between(before, grey)};
      if (pair.flows.size() >= fewest_flows) pairs.push_back(std::move(pair));
    }
    before = std::move(grey);
    before_us = frame->utime_us;
  }
  return pairs;
}

/// Delay, s; readout, s; the scene's inverse range, 1/m.
using DelayNumbers = Eigen::Vector3d;

class Fit {
 public:
  Fit(const std::vector<FramePair>& pairs, const HeadCourse& course,
      const geometry::CameraModel& camera, const geometry::HeadGeometry& head)
      : pairs_(pairs), course_(course), camera_(camera), head_(head) {}

  [[nodiscard]] DelayEstimate run();

 private:
  struct Equations {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  // of the pairs' gradients
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    double weighted_squares = 0.0, weights = 0.0;
  };

  [[nodiscard]] std::optional<Eigen::Vector2d> residual(const FramePair& pair, const Flow& flow,
                                                        const DelayNumbers& at) const;
  [[nodiscard]] Equations equations(const DelayNumbers& at, double scale_px) const;
  [[nodiscard]] double median_px(const DelayNumbers& at) const;

  const std::vector<FramePair>& pairs_;
  const HeadCourse& course_;
  const geometry::CameraModel& camera_;
  const geometry::HeadGeometry& head_;
};

/// Where a point is seen in the second frame, less where it should be.
std::optional<Eigen::Vector2d> Fit::residual(const FramePair& pair, const Flow& flow,
                                             const DelayNumbers& at) const {
  const auto angles = [&](std::int64_t stamp_us, double row_px) {
    const double into_frame_s = at[0] + at[1] * row_px / (camera_.height_px - 1);
    return course_.at(static_cast<double>(stamp_us) + 1e6 * into_frame_s);
  };
  const auto q1 = angles(pair.before_us, flow.before.y());
  const auto q2 = angles(pair.after_us, flow.after.y());
  const auto ray = geometry::normalise(camera_, flow.before);
  if (!q1 || !q2 || !ray) return std::nullopt;
  const geometry::Pose motion = geometry::cam2_from_cam1(head_, *q1, *q2);
  const auto pixel =
      geometry::project(camera_, motion.rotation * ray->homogeneous() + at[2] * motion.translation);
  if (!pixel) return std::nullopt;
  return flow.after - *pixel;
}

double Fit::median_px(const DelayNumbers& at) const {
  std::vector<double> norms;
  for (const FramePair& pair : pairs_) {
    for (const Flow& flow : pair.flows) {
      if (const auto r = residual(pair, flow, at)) norms.push_back(r->norm());
    }
  }
  if (norms.empty()) return 0.0;
  const auto middle = norms.begin() + std::ssize(norms) / 2;
  std::ranges::nth_element(norms, middle);
  return *middle;
}

Fit::Equations Fit::equations(const DelayNumbers& at, double scale_px) const {
  const DelayNumbers steps(1e-3, 1e-3, 0.05);  // s, s, 1/m: what bends nothing
  Equations sum;
  for (const FramePair& pair : pairs_) {
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Flow& flow : pair.flows) {
      const auto r = residual(pair, flow, at);
      if (!r) continue;
      Eigen::Matrix<double, 2, 3> jacobian;
      bool smooth = true;
      for (int i = 0; i < 3 && smooth; ++i) {
        DelayNumbers more = at, less = at;
        more[i] += steps[i];
        less[i] -= steps[i];
        const auto r_more = residual(pair, flow, more), r_less = residual(pair, flow, less);
        smooth = r_more && r_less;
        if (smooth) jacobian.col(i) = (*r_more - *r_less) / (2.0 * steps[i]);
      }
      if (!smooth) continue;
      const double weight = 1.0 / (1.0 + r->squaredNorm() / (scale_px * scale_px));  // Cauchy's
      sum.information += weight * jacobian.transpose() * jacobian;
      gradient += weight * jacobian.transpose() * *r;
      sum.weighted_squares += weight * r->squaredNorm();
      sum.weights += weight;
    }
    sum.gradient += gradient;
    sum.scatter += gradient * gradient.transpose();
  }
  return sum;
}

DelayEstimate Fit::run() {
  constexpr int most_steps = 30;
  constexpr double least_scale_px = 0.3, cauchy_medians = 2.0;
  DelayNumbers at(0.0, 0.0, 0.5);
  // A scene between 0.25 m and infinity; beside it neither time has a prior.
  constexpr double inverse_range_mean = 0.7, inverse_range_sigma = 1.0;
  Equations e;
  for (int step = 0; step < most_steps; ++step) {
    e = equations(at, std::max(least_scale_px, cauchy_medians * median_px(at)));
    const double noise_px2 = e.weighted_squares / std::max(1.0, 2.0 * e.weights);
    const double prior = noise_px2 / (inverse_range_sigma * inverse_range_sigma);
    e.information(2, 2) += prior;
    e.gradient[2] += prior * (at[2] - inverse_range_mean);
    DelayNumbers change = e.information.ldlt().solve(-e.gradient);
    constexpr double longest_step_s = 0.05;  // the angles are no straight line
    const double length_s = change.head<2>().cwiseAbs().maxCoeff();
    if (length_s > longest_step_s) change *= longest_step_s / length_s;
    at += change;
    constexpr double negligible_s = 1e-6;
    if (length_s < negligible_s) break;
  }
  const Eigen::Matrix3d inverse = e.information.inverse();
  const Eigen::Matrix3d covariance = inverse * e.scatter * inverse;
  DelayEstimate result{.delay_s = at[0],
                       .delay_sigma_s = std::sqrt(covariance(0, 0)),
                       .readout_s = at[1],
                       .readout_sigma_s = std::sqrt(covariance(1, 1)),
                       .pairs = pairs_.size(),
                       .rms_px = std::sqrt(e.weighted_squares / std::max(1e-9, e.weights))};
  for (const FramePair& pair : pairs_) result.points += pair.flows.size();
  return result;
}

}  // namespace

DelayEstimate estimate_delay(const std::filesystem::path& log, const std::string& channel_prefix,
                             const geometry::CameraModel& camera,
                             const geometry::HeadGeometry& head) {
  const lcm::Channels channels(log::recorded_prefix(log.string(), channel_prefix));
  const HeadCourse course(log, channels);
  log::LogCamera frames(log.string(), channels, camera.width_px, camera.height_px);
  const std::vector<FramePair> pairs = moving_pairs(frames, course);
  constexpr std::size_t fewest_pairs = 10;
  if (pairs.size() < fewest_pairs) {
    throw std::invalid_argument(base::text(
        "%s: %zu pairs of frames with texture between which the head turned by 0.01 to 0.25 rad; "
        "allowed: from %zu. Record while the head looks about, both joints, 10 s or more",
        log.c_str(), pairs.size(), fewest_pairs));
  }
  const DelayEstimate result = Fit(pairs, course, camera, head).run();
  constexpr double greatest_s = 1.0;  // of the keys
  if (!(std::abs(result.delay_s) <= greatest_s && std::abs(result.readout_s) <= greatest_s)) {
    throw std::runtime_error(log.string() +
                             ": what is seen does not turn as the head's angles say, at any delay "
                             "up to 1 s");
  }
  return result;
}

double recorded_delay_s(const std::filesystem::path& log, const std::string& channel_prefix) {
  const std::string toml = log::recorded_configuration(log.string(), channel_prefix);
  if (toml.empty()) return 0.0;
  base::TomlDocument document(toml, log.string(), base::longest_written_toml);
  base::StrictTable root(document);
  auto camera = root.table("camera");
  return camera ? camera->number("delay_s", {-1.0, 1.0}).value_or(0.0) : 0.0;
}

}  // namespace gazed::lab::calibration
