// How large a chi-square may be by chance.
#pragma once

namespace gazed::triangulation {

/// The 99.9 % quantile of chi-square with this many degrees of freedom: Abramowitz and Stegun 1964,
/// table 26.8, up to 30 degrees; the approximation of Wilson and Hilferty 1931 beyond, where it is
/// accurate to 0.1 %. 0 for zero or fewer degrees.
[[nodiscard]] double chi2_999_of(int degrees_of_freedom);

}  // namespace gazed::triangulation
