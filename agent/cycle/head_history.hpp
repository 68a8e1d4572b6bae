// The head's recent past: measured angles at any capture time, and whether the head was still then.
//
// Still: the velocity of both joints is under a limit in two consecutive samples. The velocity is
// what the head reports; where it reports none, or one that its angles contradict, it is the slope
// of the last angles. Whether the head was still at a capture depends only on the samples around
// it, not on when they arrived, so that a recording played back gives the same answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "agent/base/ring.hpp"
#include "agent/geometry/head_motion.hpp"

namespace gazed::cycle {

struct HeadAtCapture {
  geometry::HeadAngles measured;  // interpolated between the two samples around the capture
  bool still = false;  // two still samples before the capture, and the one after it still too
  geometry::HeadAngles sweep{};  // from the beginning of the capture to its end
  double sweep_sigma_rad = 0.0;  // of each component
};

class HeadHistory {
 public:
  /// Reported velocities may differ from the angles by what an encoder error explains.
  explicit HeadHistory(double still_velocity_rad_s, double encoder_sigma_rad = 0.0)
      : still_velocity_rad_s_(still_velocity_rad_s), encoder_sigma_rad_(encoder_sigma_rad) {}

  /// False, and nothing is kept, when the time does not advance or an angle is not finite.
  bool add(const geometry::HeadState& state);

  /// From here on only samples after `utime_us` count as still ones: a new fixation begins.
  void restart(std::int64_t utime_us) { restart_utime_us_ = utime_us; }

  /// None while no sample at or after `utime_us` has come, and for times before the oldest sample
  /// kept.
  [[nodiscard]] std::optional<HeadAtCapture> at(std::int64_t utime_us) const;
  /// For a capture that takes time: the angles are those of its middle, the sweep the slope of the
  /// angles around it, and the head was still if it was so at the beginning and at the end. None
  /// while the end is not known.
  [[nodiscard]] std::optional<HeadAtCapture> during(std::int64_t utime_us,
                                                    std::int64_t duration_us) const;

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  /// The newest sample; the history must not be empty.
  [[nodiscard]] const geometry::HeadState& newest() const { return samples_.newest().state; }
  /// How long a sample is kept, at the rate at which they come; infinite while that is not known.
  [[nodiscard]] double kept_s() const;
  [[nodiscard]] std::int64_t oldest_utime_us() const { return samples_.oldest().state.utime_us; }
  /// True when the newest sample is still, and so are the ones before it back to `two samples`.
  [[nodiscard]] bool still_now() const;
  /// False when the samples up to `utime_us`, all of which have come, tell that it was not.
  [[nodiscard]] bool may_be_still_at(std::int64_t utime_us) const;
  /// Of the newest sample, as it was judged; infinite while it is not known.
  [[nodiscard]] geometry::HeadAngles velocity_now_rad_s() const {
    return samples_.newest().velocity_rad_s;
  }
  /// Why the reported velocities are not believed, told once after the sample that contradicts
  /// them; empty else.
  [[nodiscard]] std::string warning() { return std::exchange(warning_, {}); }

 private:
  struct Sample {
    geometry::HeadState state;
    geometry::HeadAngles velocity_rad_s{};
    bool still = false;
  };

  [[nodiscard]] bool settled(std::size_t index) const;
  [[nodiscard]] std::size_t last_before(std::int64_t utime_us) const;
  [[nodiscard]] std::size_t first_since(std::int64_t utime_us) const;
  [[nodiscard]] std::optional<geometry::HeadAngles> slope(std::size_t first,
                                                          std::size_t last) const;
  [[nodiscard]] geometry::HeadAngles newest_velocity();
  [[nodiscard]] std::optional<geometry::HeadAngles> reported_move(std::size_t first,
                                                                  std::size_t last) const;
  void compare(geometry::HeadAngles reported_move, geometry::HeadAngles measured_move);

  static constexpr std::size_t capacity = 256;
  // The newest: 3 s at LoLA's 83 Hz, far more than any image is late.
  base::Ring<Sample, capacity> samples_;
  double still_velocity_rad_s_, encoder_sigma_rad_;
  bool velocities_are_believed_ = true;
  std::string warning_;
  std::int64_t restart_utime_us_ = INT64_MIN;
};

}  // namespace gazed::cycle
