#include "agent/base/nearest.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace gazed::base {
namespace {

constexpr std::size_t longest = 100;  // of a name worth comparing

/// The least number of insertions, deletions and replacements that turn `a` into `b` (Levenshtein
/// 1966).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace

Nearest::Nearest(std::string_view written) : written_(written.substr(0, longest)) {}

void Nearest::offer(std::string_view name, std::string_view meaning) {
  if (name.empty()) return;
  const std::size_t distance = edit_distance(written_, name);
  constexpr std::size_t always_near = 2;
  const std::size_t limit = std::max(always_near, std::max(written_.size(), name.size()) / 3);
  if (distance >= least_ || distance > limit) return;
  least_ = distance;
  meaning_ = meaning;
}

}  // namespace gazed::base
