// The known name that somebody who misspelt one may have meant.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace gazed::base {

/// "; the nearest known is NAME", for the end of a message; empty for no name.
[[nodiscard]] inline std::string nearest_clause(const std::string& name) {
  return name.empty() ? "" : "; the nearest known is " + name;
}

/// Of all names offered, the one nearest to what was written; the first of equals. None where more
/// than a third of the letters differ: it would say nothing.
class Nearest {
 public:
  explicit Nearest(std::string_view written);

  /// result() is `meaning` when `name` is nearest. An empty name is none.
  void offer(std::string_view name, std::string_view meaning);
  [[nodiscard]] std::string result() const { return meaning_; }
  /// "; the nearest known is RESULT", for the end of a message; empty for none.
  [[nodiscard]] std::string clause() const { return nearest_clause(meaning_); }

 private:
  std::string written_;
  std::string meaning_;
  std::size_t least_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace gazed::base
