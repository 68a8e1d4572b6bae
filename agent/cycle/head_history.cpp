#include "agent/cycle/head_history.hpp"

#include <algorithm>
#include <cmath>

#include "agent/base/utime.hpp"

namespace gazed::cycle {

namespace {

// A velocity that the source does not measure is taken over at least this long: over one 12 ms
// sample the encoder's 1.53 mrad step alone looks like 0.13 rad/s.
constexpr std::int64_t difference_us = 40'000;

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
  const geometry::HeadAngles speed = velocity(state);
  const bool still = std::abs(speed.yaw_rad) < still_velocity_rad_s_ &&
                     std::abs(speed.pitch_rad) < still_velocity_rad_s_;
  samples_.push({state, still});
  return true;
}

geometry::HeadAngles HeadHistory::velocity(const geometry::HeadState& state) const {
  if (geometry::finite(state.velocity_rad_s)) return state.velocity_rad_s;
  for (std::size_t i = samples_.size(); i-- > 0;) {
    const geometry::HeadState& earlier = samples_[i].state;
    const std::int64_t elapsed_us = state.utime_us - earlier.utime_us;
    if (elapsed_us < difference_us) continue;
    const double elapsed_s = 1e-6 * static_cast<double>(elapsed_us);
    const geometry::HeadAngles move = state.measured - earlier.measured;
    return {move.yaw_rad / elapsed_s, move.pitch_rad / elapsed_s};
  }
  return {INFINITY, INFINITY};  // nothing to compare with yet: not known to be still
}

bool HeadHistory::settled(std::size_t index) const {
  return index >= 1 && samples_[index].still && samples_[index - 1].still &&
         samples_[index - 1].state.utime_us > restart_utime_us_;
}

bool HeadHistory::still_now() const {
  return !samples_.empty() && settled(samples_.size() - 1);
}

std::optional<HeadAtCapture> HeadHistory::at(std::int64_t utime_us) const {
  if (empty() || newest().utime_us < utime_us || oldest_utime_us() > utime_us) return std::nullopt;
  std::size_t after = samples_.size() - 1;
  while (after > 0 && samples_[after - 1].state.utime_us >= utime_us) --after;
  const std::size_t before = after > 0 ? after - 1 : after;
  return HeadAtCapture{interpolate(samples_[before].state, samples_[after].state, utime_us),
                       settled(before) && samples_[after].still};
}

std::optional<HeadAtCapture> HeadHistory::during(std::int64_t utime_us,
                                                 std::int64_t duration_us) const {
  const auto begin = at(utime_us), end = at(utime_us + duration_us);
  if (!begin || !end) return std::nullopt;
  return HeadAtCapture{at(utime_us + duration_us / 2)->measured, begin->still && end->still,
                       end->measured - begin->measured};
}

}  // namespace gazed::cycle
