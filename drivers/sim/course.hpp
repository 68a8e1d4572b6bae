// How a quantity changes along a run of pixels.
#pragma once

#include <cstdint>

namespace gazed::sim {

/// A quadratic function of the pixel, stepped from one to the next in Q31.32.
///
/// Where a run of n pixels meets a plane is not quadratic but u / (1 + e u), when the depth changes
/// by the share e from the run's first pixel to its last; the quadratic through the first, the
/// middle and the last is off by up to 0.06 e^2 n pixels for e up to 0.05.
class Course {
 public:
  /// Stands still.
  explicit Course(double value) : value_(fixed(value)) {}
  /// Through the values at pixels 0, middle = last / 2 and last, which may be 0 too.
  Course(double at_first, double at_middle, double at_last, int last) : value_(fixed(at_first)) {
    const int middle = last / 2;
    if (middle == 0) {
      step_ = fixed(at_last - at_first);
      return;
    }
    // Newton's divided differences.
    const double slope = (at_middle - at_first) / middle;
    const double slope_2 = (at_last - at_middle) / (last - middle);
    const double bend = (slope_2 - slope) / last;
    step_ = fixed(slope + bend * (1 - middle));
    change_ = fixed(2.0 * bend);
  }

  /// The value at this pixel in Q15.16, modulo 2^16; then to the next pixel.
  std::int32_t next() {
    const auto value = static_cast<std::int32_t>(value_ >> 16U);
    value_ += step_;
    step_ += change_;
    return value;
  }

 private:
  /// Values beyond +-2^24 are no places on a surface: held there.
  static std::uint64_t fixed(double value) {
    constexpr double most = 0x1p24;
    if (!(value > -most)) value = -most;
    if (value > most) value = most;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value * 0x1p32));
  }

  // Unsigned: what does not fit wraps, as the value may.
  std::uint64_t value_;
  std::uint64_t step_ = 0;
  std::uint64_t change_ = 0;
};

}  // namespace gazed::sim
