// What a number may be.
#pragma once

namespace gazed::base {

/// The ends included.
struct Range {
  double min = 0.0;
  double max = 0.0;

  /// False for NaN.
  [[nodiscard]] constexpr bool contains(double number) const {
    return number >= min && number <= max;
  }
};

}  // namespace gazed::base
