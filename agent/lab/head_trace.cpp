#include "agent/lab/head_trace.hpp"

#include <algorithm>
#include <cmath>

namespace gazed::lab {

namespace {

constexpr std::int64_t usual_period_us = 10'000;   // NAO's own cycle (DCM, 100 Hz)
constexpr std::int64_t longest_rest_us = 200'000;  // before a turn, and around the whole log
constexpr std::int64_t longest_turn_us = 200'000;
constexpr std::int64_t least_samples = 15;  // between two frames: 6 rest, 3 turn, 6 rest

geometry::HeadState state_at(std::int64_t utime_us, geometry::HeadAngles angles,
                             geometry::HeadAngles velocity_rad_s = {}) {
  return {.utime_us = utime_us,
          .measured = angles,
          .velocity_rad_s = velocity_rad_s,
          .stiffness = 1.0F};
}

std::vector<geometry::HeadState> resting(geometry::HeadAngles angles, std::int64_t from_us,
                                         std::int64_t to_us) {
  std::vector<geometry::HeadState> states;
  for (std::int64_t t = from_us; t <= to_us; t += usual_period_us) {
    if (t >= 0) states.push_back(state_at(t, angles));
  }
  return states;
}

/// An even turn from one pose to the other.
struct Turn {
  std::int64_t start_us;
  std::int64_t duration_us;
  geometry::HeadAngles from;
  geometry::HeadAngles to;

  [[nodiscard]] geometry::HeadState at(std::int64_t utime_us) const {
    if (utime_us <= start_us) return state_at(utime_us, from);
    if (utime_us >= start_us + duration_us) return state_at(utime_us, to);
    const double part = static_cast<double>(utime_us - start_us) / static_cast<double>(duration_us);
    const geometry::HeadAngles way = to - from;
    const double per_second = 1e6 / static_cast<double>(duration_us);
    return state_at(utime_us, from + geometry::HeadAngles{way.yaw_rad * part, way.pitch_rad * part},
                    {way.yaw_rad * per_second, way.pitch_rad * per_second});
  }
};

}  // namespace

std::vector<geometry::HeadState> head_states_before(const io::RecordedFrame& first) {
  return resting(first.head, first.utime_us - longest_rest_us, first.utime_us);
}

std::vector<geometry::HeadState> head_states_between(const io::RecordedFrame& a,
                                                     const io::RecordedFrame& b) {
  const std::int64_t gap_us = b.utime_us - a.utime_us;
  const std::int64_t period_us = std::min(usual_period_us, gap_us / least_samples);
  const Turn turn{.start_us = a.utime_us + std::min(longest_rest_us, gap_us * 2 / 5),
                  .duration_us = std::min(longest_turn_us, gap_us / 5),
                  .from = a.head,
                  .to = b.head};
  std::vector<geometry::HeadState> states;
  for (std::int64_t back = (gap_us - 1) / period_us; back >= 0; --back) {
    states.push_back(turn.at(b.utime_us - back * period_us));
  }
  return states;
}

std::vector<std::int64_t> early_showings(const io::RecordedFrame& a, const io::RecordedFrame& b) {
  constexpr std::int64_t interval_us = 1'000'000;
  // Three samples after the turn, the head has been still for two.
  constexpr std::int64_t arrived_us = longest_rest_us + longest_turn_us + 3 * usual_period_us;
  constexpr std::int64_t longest_pause_us = 1'500'000;
  static_assert(arrived_us + interval_us <= longest_pause_us);
  std::vector<std::int64_t> times_us;
  if (b.utime_us - a.utime_us <= longest_pause_us) return times_us;
  const std::int64_t count = (b.utime_us - a.utime_us - arrived_us) / interval_us;
  for (std::int64_t back = count; back > 0; --back) {
    times_us.push_back(b.utime_us - back * interval_us);
  }
  return times_us;
}

std::vector<geometry::HeadState> head_states_after(const io::RecordedFrame& last) {
  return resting(last.head, last.utime_us + usual_period_us, last.utime_us + longest_rest_us);
}

}  // namespace gazed::lab
