#include "agent/cycle/head_history.hpp"

#include <algorithm>
#include <cmath>

#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"

namespace gazed::cycle {

namespace {

// An encoder's step of 1.53 mrad, which its noise makes come and go, must not look like motion:
// over one sample of 12 ms it is 0.13 rad/s, in the slope of angles over this long 0.01 rad/s.
constexpr std::int64_t slope_us = 96'000;
// Less says nothing about motion.
constexpr std::int64_t slope_min_us = 40'000;
// The sweep is the slope from this long before a capture to its end: the angles of the capture
// alone, three or four, are too few for the encoder's step.
constexpr std::int64_t before_capture_us = 36'000;
// What that leaves: 0.5 mrad in the V6's 37 ms, by the encoder's step and the curvature of a joint
// that creeps into its goal.
constexpr double slope_sigma_rad_s = 0.0135;

// Reported velocities are wrong where their sum differs from the move by more than this, and by
// more than this share of it: samples at other times than the velocity's, and a speed that changes
// in between.
constexpr double velocity_slack_rad = 0.01, velocity_slack_share = 0.5;
constexpr double encoder_sigmas = 4.0;
// Between samples farther apart than this a whole move can have begun and ended.
constexpr std::int64_t velocity_gap_us = 50'000;

geometry::HeadAngles interpolate(const geometry::HeadState& before,
                                 const geometry::HeadState& after, std::int64_t utime_us) {
  if (after.utime_us == before.utime_us) return after.measured;
  const double share = static_cast<double>(utime_us - before.utime_us) /
                       static_cast<double>(after.utime_us - before.utime_us);
  const geometry::HeadAngles move = after.measured - before.measured;
  return before.measured + geometry::HeadAngles{share * move.yaw_rad, share * move.pitch_rad};
}

}  // namespace

bool HeadHistory::add(const geometry::HeadState& state) {
  if (!geometry::finite(state.measured) || !base::plausible_utime(state.utime_us)) return false;
  if (!empty() && state.utime_us <= newest().utime_us) return false;
  samples_.push({.state = state});
  const geometry::HeadAngles velocity = newest_velocity();
  const bool still = std::abs(velocity.yaw_rad) < still_velocity_rad_s_ &&
                     std::abs(velocity.pitch_rad) < still_velocity_rad_s_;
  samples_[samples_.size() - 1] = {state, velocity, still};
  return true;
}

double HeadHistory::kept_s() const {
  constexpr std::size_t fewest = 8;  // that tell a rate
  if (samples_.size() < fewest) return INFINITY;
  const double together_s = base::seconds_between(oldest_utime_us(), newest().utime_us);
  return together_s * static_cast<double>(capacity - 1) / static_cast<double>(samples_.size() - 1);
}

/// The last sample at or before `utime_us`; the oldest where there is none.
std::size_t HeadHistory::last_before(std::int64_t utime_us) const {
  std::size_t index = samples_.size() - 1;
  while (index > 0 && samples_[index].state.utime_us > utime_us) --index;
  return index;
}

/// The first sample at or after `utime_us`; the newest where there is none.
std::size_t HeadHistory::first_since(std::int64_t utime_us) const {
  std::size_t index = samples_.size() - 1;
  while (index > 0 && samples_[index - 1].state.utime_us >= utime_us) --index;
  return index;
}

/// Least squares; none for a single sample.
std::optional<geometry::HeadAngles> HeadHistory::slope(std::size_t first, std::size_t last) const {
  const std::int64_t since_us = samples_[first].state.utime_us;
  const geometry::HeadAngles& from = samples_[first].state.measured;
  const auto count = static_cast<double>(last - first + 1);
  double time_s = 0.0;
  geometry::HeadAngles mean;
  for (std::size_t i = first; i <= last; ++i) {
    time_s += base::seconds_between(since_us, samples_[i].state.utime_us) / count;
    const geometry::HeadAngles move = samples_[i].state.measured - from;
    mean = mean + geometry::HeadAngles{move.yaw_rad / count, move.pitch_rad / count};
  }
  double times_2 = 0.0;
  geometry::HeadAngles products;
  for (std::size_t i = first; i <= last; ++i) {
    const double off_s = base::seconds_between(since_us, samples_[i].state.utime_us) - time_s;
    const geometry::HeadAngles off = samples_[i].state.measured - from - mean;
    times_2 += off_s * off_s;
    products = products + geometry::HeadAngles{off_s * off.yaw_rad, off_s * off.pitch_rad};
  }
  if (!(times_2 > 0.0)) return std::nullopt;
  return geometry::HeadAngles{products.yaw_rad / times_2, products.pitch_rad / times_2};
}

geometry::HeadAngles HeadHistory::newest_velocity() {
  const std::size_t last = samples_.size() - 1;
  const geometry::HeadState& now = samples_[last].state;
  const std::size_t first = last_before(now.utime_us - slope_us);
  if (velocities_are_believed_) {
    const auto reported = reported_move(first, last);
    if (reported)
      compare(*reported, samples_[last].state.measured - samples_[first].state.measured);
    if (reported && velocities_are_believed_) return now.velocity_rad_s;
  }
  constexpr geometry::HeadAngles unknown{INFINITY, INFINITY};
  if (now.utime_us - samples_[first].state.utime_us < slope_min_us) return unknown;
  return slope(first, last).value_or(unknown);
}

/// The sum of the reported velocities; none where they do not tell it.
std::optional<geometry::HeadAngles> HeadHistory::reported_move(std::size_t first,
                                                               std::size_t last) const {
  if (!geometry::finite(samples_[first].state.velocity_rad_s)) return std::nullopt;
  geometry::HeadAngles sum;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const geometry::HeadState &before = samples_[i - 1].state, &now = samples_[i].state;
    if (!geometry::finite(now.velocity_rad_s)) return std::nullopt;
    if (now.utime_us - before.utime_us > velocity_gap_us) return std::nullopt;
    const double half_s = 0.5 * base::seconds_between(before.utime_us, now.utime_us);
    const geometry::HeadAngles both = before.velocity_rad_s + now.velocity_rad_s;
    sum = sum + geometry::HeadAngles{half_s * both.yaw_rad, half_s * both.pitch_rad};
  }
  return sum;
}

/// A source that fills in zeros, or another unit, is found out in the first move that it reports.
void HeadHistory::compare(geometry::HeadAngles reported_move, geometry::HeadAngles measured_move) {
  const double slack_rad = std::hypot(velocity_slack_rad, encoder_sigmas * encoder_sigma_rad_);
  const auto contradicts = [&](double moved_rad, double sum_rad) {
    return std::abs(moved_rad - sum_rad) >
           slack_rad + velocity_slack_share * std::max(std::abs(moved_rad), std::abs(sum_rad));
  };
  if (!contradicts(measured_move.yaw_rad, reported_move.yaw_rad) &&
      !contradicts(measured_move.pitch_rad, reported_move.pitch_rad)) {
    return;
  }
  velocities_are_believed_ = false;
  warning_ = base::text(
      "the head's velocities contradict its angles: they say (%.3f, %.3f) rad while it moved by "
      "(%.3f, %.3f) rad; the angles are believed",
      reported_move.yaw_rad, reported_move.pitch_rad, measured_move.yaw_rad,
      measured_move.pitch_rad);
}

bool HeadHistory::settled(std::size_t index) const {
  return index >= 1 && samples_[index].still && samples_[index - 1].still &&
         samples_[index - 1].state.utime_us > restart_utime_us_;
}

bool HeadHistory::still_now() const {
  return !samples_.empty() && settled(samples_.size() - 1);
}

bool HeadHistory::may_be_still_at(std::int64_t utime_us) const {
  if (empty() || newest().utime_us < utime_us) return still_now();
  const std::optional<HeadAtCapture> then = at(utime_us);
  return then && then->still;
}

std::optional<HeadAtCapture> HeadHistory::at(std::int64_t utime_us) const {
  if (empty() || newest().utime_us < utime_us || oldest_utime_us() > utime_us) return std::nullopt;
  const std::size_t after = first_since(utime_us);
  const std::size_t before = after > 0 ? after - 1 : after;
  return HeadAtCapture{interpolate(samples_[before].state, samples_[after].state, utime_us),
                       settled(before) && samples_[after].still};
}

std::optional<HeadAtCapture> HeadHistory::during(std::int64_t utime_us,
                                                 std::int64_t duration_us) const {
  const auto begin = at(utime_us), end = at(utime_us + duration_us);
  if (!begin || !end) return std::nullopt;
  HeadAtCapture out{at(utime_us + duration_us / 2)->measured, begin->still && end->still};
  if (duration_us == 0) return out;
  const double duration_s = 1e-6 * static_cast<double>(duration_us);
  const geometry::HeadAngles moving =
      slope(last_before(utime_us - before_capture_us), first_since(utime_us + duration_us))
          .value_or(geometry::HeadAngles{});
  out.sweep = {duration_s * moving.yaw_rad, duration_s * moving.pitch_rad};
  out.sweep_sigma_rad = duration_s * slope_sigma_rad_s;
  return out;
}

}  // namespace gazed::cycle
