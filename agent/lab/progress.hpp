// "12 of 86" for a person who waits.
#pragma once

#include <chrono>
#include <cstddef>

namespace gazed {

/// Writes to standard error when that is a terminal and the work has taken 2 s.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done);
  /// Takes the line away, before something else is written.
  void clear();

 private:
  std::size_t total_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace gazed
