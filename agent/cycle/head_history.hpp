// The head's recent past: measured angles at any capture time, and whether the head was still then.
//
// Still: the velocity of both joints is under a limit in two consecutive samples. Whether the head
// was still at a capture depends only on the samples around it, not on when they arrived, so that a
// recording played back gives the same answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "agent/base/ring.hpp"
#include "agent/geometry/head_motion.hpp"

namespace gazed::cycle {

struct HeadAtCapture {
  geometry::HeadAngles measured;  // interpolated between the two samples around the capture
  bool still = false;  // two still samples before the capture, and the one after it still too
  geometry::HeadAngles sweep{};  // from the beginning of the capture to its end
};

class HeadHistory {
 public:
  explicit HeadHistory(double still_velocity_rad_s) : still_velocity_rad_s_(still_velocity_rad_s) {}

  /// False, and nothing is kept, when the time does not advance or an angle is not finite.
  bool add(const geometry::HeadState& state);

  /// From here on only samples after `utime_us` count as still ones: a new fixation begins.
  void restart(std::int64_t utime_us) { restart_utime_us_ = utime_us; }

  /// None while no sample at or after `utime_us` has come, and for times before the oldest sample
  /// kept.
  [[nodiscard]] std::optional<HeadAtCapture> at(std::int64_t utime_us) const;
  /// For a capture that takes time: the angles are those of its middle, and the head was still if
  /// it was so at the beginning and at the end. None while the end is not known.
  [[nodiscard]] std::optional<HeadAtCapture> during(std::int64_t utime_us,
                                                    std::int64_t duration_us) const;

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  /// The newest sample; the history must not be empty.
  [[nodiscard]] const geometry::HeadState& newest() const { return samples_.newest().state; }
  [[nodiscard]] std::int64_t oldest_utime_us() const { return samples_.oldest().state.utime_us; }
  /// True when the newest sample is still, and so are the ones before it back to `two samples`.
  [[nodiscard]] bool still_now() const;

 private:
  struct Sample {
    geometry::HeadState state;
    bool still = false;
  };

  [[nodiscard]] bool settled(std::size_t index) const;
  [[nodiscard]] geometry::HeadAngles velocity(const geometry::HeadState& state) const;

  // The newest: 3 s at LoLA's 83 Hz, far more than any image is late.
  base::Ring<Sample, 256> samples_;
  double still_velocity_rad_s_;
  std::int64_t restart_utime_us_ = INT64_MIN;
};

}  // namespace gazed::cycle
