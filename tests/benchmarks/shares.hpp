// Shares of two halves of the pictures, that which constants were fitted to and the other, and the
// table that shows them beside their bounds.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gazed::benchmarks {

constexpr std::size_t fitted = 0, held_out = 1;

/// A share, or a mean of numbers from 0 to 1, and its standard error.
struct Share {
  double value = std::nan("");
  double error = std::nan("");
  std::size_t count = 0;
};

/// Of independent trials.
[[nodiscard]] Share share_of(const std::vector<bool>& trials);
/// The mean of the pictures' own shares, whose trials are alike.
[[nodiscard]] Share mean_of(const std::vector<double>& shares);

/// Outcomes, or shares, of both halves.
using Trials = std::array<std::vector<bool>, 2>;
using Values = std::array<std::vector<double>, 2>;
[[nodiscard]] std::array<Share, 2> shares_of(const Trials& trials);
[[nodiscard]] std::array<Share, 2> means_of(const Values& values);

/// Prints as it goes.
class Table {
 public:
  explicit Table(const std::string& title);
  /// What is held out is judged; where there is nothing, what was fitted.
  void row(const std::string& what, const std::array<Share, 2>& halves, double least, double most);
  /// Whether a bound was missed.
  [[nodiscard]] bool missed() const { return missed_; }

 private:
  bool missed_ = false;
};

}  // namespace gazed::benchmarks
