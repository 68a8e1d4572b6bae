// Limits that a triangulated point must satisfy.
#pragma once

namespace gazed::triangulation {

/// 99.9 % of chi-square with one degree of freedom: Abramowitz and Stegun 1964, table 26.8.
inline constexpr double chi2_999 = 10.828;

struct Gate {
  double relative_sigma_max = 0.15;  // of the inverse range; above this the point is UNCERTAIN
  double epipolar_chi2_max = chi2_999;
  double baseline_sigmas =
      3.0;  // a baseline or parallax within this many sigmas of 0 is DEGENERATE
};

}  // namespace gazed::triangulation
