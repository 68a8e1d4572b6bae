#include "agent/lab/explain/charts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "agent/base/text.hpp"

namespace gazed::lab::explain {

namespace {

/// The same picture twice: for a page, and for whoever wants a file of pixels.
std::string drawn_twice(const std::string& name, int height, const std::string& commands) {
  std::string out;
  for (const char* kind : {"svg", "png"}) {
    const bool is_svg = kind[0] == 's';
    out +=
        is_svg
            ? base::text(
                  "set terminal svg size 900,%d dynamic background \"white\" font "
                  "\"sans-serif,13\"\n",
                  height)
            : base::text(
                  "set terminal pngcairo size 900,%d background \"white\" font \"sans-serif,11\"\n",
                  height);
    out += base::text("set output \"%s.%s\"\n", name.c_str(), kind);
    out.append(commands).append("unset output\n");
  }
  return out;
}

/// What is drawn in a row of its own: a range, and how sure it is.
struct Row {
  std::string label;
  double inverse_range_per_m, sigma_per_m;
  int colour;
};

std::vector<Row> rows_of(const cycle::Fixation& fixation) {
  std::vector<Row> rows;
  const triangulation::PointEstimate& all = fixation.estimate;
  if (std::isfinite(all.inverse_range_per_m)) {
    rows.push_back(
        {"all looks together", all.inverse_range_per_m, all.inverse_range_sigma_per_m, 0x0072b2});
  }
  for (std::size_t k = 1; k < fixation.look_count; ++k) {
    const cycle::FixationLook& look = fixation.looks[k];
    if (!std::isfinite(look.pair_inverse_range_per_m)) continue;
    rows.push_back({base::text("looks 1 and %zu alone%s", k + 1, look.used ? "" : " (not used)"),
                    look.pair_inverse_range_per_m, look.pair_inverse_range_sigma_per_m,
                    look.used ? 0x009e73 : 0xd55e00});
  }
  return rows;
}

/// What the axis shows, metres: the answer's 95 % interval, and around it.
RangeInterval shown(const cycle::Fixation& fixation, const std::vector<Row>& rows) {
  RangeInterval out{std::numeric_limits<double>::infinity(), 0.0};
  const auto hold = [&out](double range_m) {
    if (!std::isfinite(range_m) || range_m <= 0.0) return;
    out.near_m = std::min(out.near_m, range_m);
    out.far_m = std::max(out.far_m, range_m);
  };
  for (const Row& row : rows) {
    hold(1.0 / row.inverse_range_per_m);
    if (const auto interval = interval_of(row.inverse_range_per_m, row.sigma_per_m, 2.0)) {
      hold(interval->near_m);
      hold(std::min(interval->far_m, 4.0 / std::abs(row.inverse_range_per_m)));
    }
  }
  hold(fixation.report_range_m);
  constexpr double spare = 1.15, widest = 100.0;
  if (!(out.far_m > 0.0)) return {0.1, 10.0};
  out.far_m = std::min(out.far_m, widest * out.near_m);
  return {out.near_m / spare, out.far_m * spare};
}

}  // namespace

std::optional<RangeInterval> interval_of(double inverse_range_per_m, double sigma_per_m,
                                         double sigmas) {
  const double nearest = inverse_range_per_m + sigmas * sigma_per_m;
  const double farthest = inverse_range_per_m - sigmas * sigma_per_m;
  if (!(nearest > 0.0) || !std::isfinite(nearest)) return std::nullopt;
  return RangeInterval{1.0 / nearest,
                       farthest > 0.0 ? 1.0 / farthest : std::numeric_limits<double>::infinity()};
}

std::vector<Cost> costs_of(const cycle::Fixation& fixation) {
  const auto& variances = fixation.budget.variance_per_m2;
  const double inverse_range = fixation.estimate.inverse_range_per_m;
  const double all = std::accumulate(variances.begin(), variances.end(), 0.0);
  if (!(all > 0.0) || !(inverse_range > 0.0)) return {};
  std::vector<Cost> costs;
  for (std::size_t i = 0; i < variances.size(); ++i) {
    costs.push_back(
        {.cause = triangulation::all_looks::name(static_cast<triangulation::all_looks::Cause>(i)),
         .alone = std::sqrt(variances[i]) / inverse_range,
         .without = std::sqrt(all - variances[i]) / inverse_range,
         .share = variances[i] / all});
  }
  std::ranges::stable_sort(costs, std::ranges::greater(), &Cost::share);
  return costs;
}

std::string interval_script(const cycle::Fixation& fixation, const std::string& name) {
  const std::vector<Row> rows = rows_of(fixation);
  if (rows.empty()) return {};
  const RangeInterval axis = shown(fixation, rows);
  const int count = static_cast<int>(rows.size());
  const bool has_report = fixation.report_range_m > 0.0;
  std::string out = base::text("set logscale x\nset xrange [%g:%g]\nset yrange [-%d.7:0.7]\n",
                               axis.near_m, axis.far_m, count - (has_report ? 0 : 1));
  out +=
      "set xlabel \"range from where look 1 was taken, m\"\nset format x \"%g\"\nset grid xtics "
      "mxtics\n"
      "set xtics add (0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 7)\nset key off\nset "
      "border 1\n"
      "set lmargin 24\nset tics nomirror\nset ytics scale 0 (";
  for (int i = 0; i < count; ++i)
    out += base::text("%s\"%s\" %d", i > 0 ? ", " : "",
                      rows[static_cast<std::size_t>(i)].label.c_str(), -i);
  if (has_report) out += base::text(", \"the report's steps\" %d", -count);
  out += ")\n";
  std::string arrows;
  std::string points;
  for (int i = 0; i < count; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    for (const double sigmas : {2.0, 1.0}) {
      const auto interval = interval_of(row.inverse_range_per_m, row.sigma_per_m, sigmas);
      if (!interval) continue;
      const bool ends = interval->far_m <= axis.far_m;
      arrows += base::text(
          "set arrow from %g,%d to %g,%d %s linewidth %g linecolor rgb \"#%06x\"\n",
          std::max(axis.near_m, interval->near_m), -i, ends ? interval->far_m : axis.far_m, -i,
          ends || sigmas < 2.0 ? "nohead" : "head filled", sigmas > 1.0 ? 2.0 : 9.0,
          static_cast<unsigned>(row.colour));
    }
    if (row.inverse_range_per_m > 0.0)
      points += base::text("%g %d\n", 1.0 / row.inverse_range_per_m, -i);
  }
  std::string report;
  if (has_report) report = base::text("%g %d\n", fixation.report_range_m, -count);
  out += arrows + "$points << END\n" + points + "END\n$report << END\n" + report + "END\n";
  constexpr int row_height = 34, rest = 90;
  return out + drawn_twice(name, rest + row_height * (count + (has_report ? 1 : 0)),
                           std::string("plot ") +
                               (points.empty() ? "1/0"
                                               : "$points using 1:2 with points pointtype 7 "
                                                 "pointsize 0.9 linecolor rgb \"white\", \\\n"
                                                 "  $points using 1:2 with points pointtype 6 "
                                                 "pointsize 0.9 linecolor rgb \"black\"") +
                               (has_report ? ", \\\n  $report using 1:2 with points pointtype 2 "
                                             "pointsize 1.3 linewidth 2 linecolor rgb \"#d55e00\"\n"
                                           : "\n"));
}

std::string costs_script(const std::vector<Cost>& costs, const std::string& name) {
  if (costs.empty()) return {};
  std::string data, labels;
  int row = 0;
  for (const Cost& cost : costs) {
    data += base::text("%g %d\n", 100.0 * cost.alone, -row);
    labels += base::text("%s\"%s\" %d", row > 0 ? ", " : "", std::string(cost.cause).c_str(), -row);
    ++row;
  }
  const std::string out = base::text("set yrange [-%d.7:0.7]\nset xrange [0:*]\n", row - 1) +
                          "set xlabel \"sigma of the range by it alone, % of the range\"\nset grid "
                          "xtics\nset key off\nset border 1\n"
                          "set lmargin 24\nset tics nomirror\nset ytics scale 0 (" +
                          labels + ")\nset style fill solid 0.85 noborder\n$costs << END\n" + data +
                          "END\n";
  constexpr int row_height = 26, rest = 80;
  return out + drawn_twice(name, rest + row_height * row,
                           "plot $costs using (0.5*$1):2:(0.5*$1):(0.36) with boxxyerror linecolor "
                           "rgb \"#0072b2\"\n");
}

}  // namespace gazed::lab::explain
