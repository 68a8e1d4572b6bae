// How large a chi-square may be by chance.
#pragma once

namespace gazed::triangulation {

/// What 99.9 % of chi-squares with this many degrees of freedom do not exceed: Abramowitz and
/// Stegun 1964, table 26.8, up to 30 degrees; beyond, the approximation of Wilson and Hilferty
/// 1931, good to 0.1 % there. None or fewer degrees: 0.
[[nodiscard]] double chi2_999_of(int degrees_of_freedom);

}  // namespace gazed::triangulation
