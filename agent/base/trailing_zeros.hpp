// Lists of numbers that different programs write with more or fewer zeros at their end, as those of
// a lens: four, five, eight or fourteen.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace gazed::base {

/// Copies `found` into `values`. From number `fewest` on the last ones may be left out, which are
/// then 0, and any number of zeros may follow; false, and nothing copied, for other lists.
inline bool assign_with_zeros(std::span<const double> found, std::size_t fewest,
                              std::span<double> values) {
  const std::size_t given = std::min(found.size(), values.size());
  const auto beyond = found.subspan(given);
  if (given < fewest || std::ranges::any_of(beyond, [](double n) { return n != 0.0; })) {
    return false;
  }
  std::ranges::fill(std::ranges::copy(found.first(given), values.begin()).out, values.end(), 0.0);
  return true;
}

}  // namespace gazed::base
