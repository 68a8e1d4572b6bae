// "[=======             ] 30 of 86" for a person who waits.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string_view>

namespace gazed::lab::io {

/// Writes to standard error when that is a terminal and the work has taken 2 s, ten times a second
/// at most.
class Progress {
 public:
  /// `total` counts the same as what is done; none when nobody knows how much will come.
  explicit Progress(std::optional<std::size_t> total);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The bar for `done` of the total, with `label` instead of "30 of 86" where there is one.
  void show(std::size_t done, std::string_view label = {});
  /// Takes the line away, before something else is written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<std::size_t> total_;
  bool to_terminal_;
  bool shown_ = false;
  Clock::time_point next_show_;
};

}  // namespace gazed::lab::io
