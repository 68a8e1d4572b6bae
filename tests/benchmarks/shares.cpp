#include "tests/benchmarks/shares.hpp"

#include <algorithm>
#include <cstdio>

namespace gazed::benchmarks {

Share share_of(const std::vector<bool>& trials) {
  if (trials.empty()) return {};
  const auto n = static_cast<double>(trials.size());
  const double p = static_cast<double>(std::ranges::count(trials, true)) / n;
  return {p, std::sqrt(p * (1.0 - p) / n), trials.size()};
}

Share mean_of(const std::vector<double>& shares) {
  if (shares.empty()) return {};
  const auto n = static_cast<double>(shares.size());
  double sum = 0.0, squares = 0.0;
  for (const double share : shares) {
    sum += share;
    squares += share * share;
  }
  const double mean = sum / n;
  return {mean, std::sqrt((squares / n - mean * mean) / n), shares.size()};
}

std::array<Share, 2> shares_of(const Trials& trials) {
  return {share_of(trials[fitted]), share_of(trials[held_out])};
}

std::array<Share, 2> means_of(const Values& values) {
  return {mean_of(values[fitted]), mean_of(values[held_out])};
}

Table::Table(const std::string& title) {
  std::printf("%-50s %22s %22s\n", title.c_str(), "fitted", "held out");
}

void Table::row(const std::string& what, const std::array<Share, 2>& halves, double least,
                double most) {
  std::printf("  %-48s", what.c_str());
  for (const Share& half : halves) {
    if (half.count == 0)
      std::printf(" %22s", "");
    else
      std::printf(" %8.3f +- %.3f %5zu", half.value, half.error, half.count);
  }
  const Share& judged = halves[held_out].count > 0 ? halves[held_out] : halves[fitted];
  const bool held = judged.value >= least && judged.value <= most;
  if (least > 0.0) std::printf("  >= %.2f %s", least, held ? "ok" : "MISSED");
  if (most < 1.0) std::printf("  <= %.2f %s", most, held ? "ok" : "MISSED");
  std::printf("\n");
  missed_ = missed_ || !held;
}

}  // namespace gazed::benchmarks
