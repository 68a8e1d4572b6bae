#include "agent/lab/analysis/tables.hpp"

#include <array>
#include <cmath>

#include "agent/base/text.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::lab::analysis {

namespace {

constexpr double mm_per_m = 1000.0;

std::string number(double value) {
  return std::isnan(value) ? "nan" : base::text("%.6g", value);
}

/// Two sigmas as table 3.3 prints them: "4 px", "2.6 mm".
std::string two_sigma(const TwoViewSetup& setup, Parameter parameter) {
  const ShownUnit unit = shown_unit(parameter);
  return base::text("%g %s", 2.0 * unit.scale * setup.error_size(parameter).sigma,
                    std::string(unit.name).c_str());
}

struct Column {
  const char* title;
  double ErrorStatistics::*value;
  double scale;
  const char* format;
};

constexpr std::array<Column, 4> columns{{
    {"RMS as the report, mm", &ErrorStatistics::rms_m, mm_per_m, "%.2f"},
    {"median error, mm", &ErrorStatistics::median_m, mm_per_m, "%.2f"},
    {"68 % half-width of the range, mm", &ErrorStatistics::half_width_m, mm_per_m, "%.2f"},
    {"failed or over 20 % wrong, %", &ErrorStatistics::over_20_percent, 100.0, "%.1f"},
}};

std::string cell(const Column& column, const ErrorStatistics& statistics) {
  return base::text("%15s",
                    base::text(column.format, column.scale * (statistics.*column.value)).c_str());
}

std::string block(const Column& column, std::span<const TableRow> rows) {
  const bool compared =
      column.value == &ErrorStatistics::rms_m &&
      !std::isnan(reported_rms_mm(*rows.front().setup, Parameter::focal, Estimator::optimal));
  std::string out = base::text("  %-34s", column.title);
  for (const Estimator estimator : all_estimators) {
    out += base::text("%15s", std::string(name(estimator)).c_str());
  }
  if (compared) out += "   the report: optimal, rectification, linear MMSE";
  out += '\n';
  for (const TableRow& row : rows) {
    if (!row.is_worst()) continue;
    out += base::text("    %-12s %-19s", std::string(name(row.parameter)).c_str(),
                      two_sigma(*row.setup, row.parameter).c_str());
    for (const Estimator estimator : all_estimators) out += cell(column, row.of(estimator));
    if (compared) {
      out += "               ";
      for (const Estimator estimator :
           {Estimator::optimal, Estimator::rectification, Estimator::linear_mmse}) {
        out += base::text("%10.2f", reported_rms_mm(*row.setup, row.parameter, estimator));
      }
    }
    out += '\n';
  }
  return out;
}

}  // namespace

double reported_rms_mm(const TwoViewSetup& setup, Parameter parameter, Estimator estimator) {
  // Rows by parameter; optimal, rectification, linear MMSE (Russcher 2011, table 3.3).
  constexpr std::array<std::array<double, 3>, 5> table{{{0.26, 231.22, 80.35},
                                                        {2.15, 7194.32, 472.15},
                                                        {15.89, 38044.77, 780.91},
                                                        {19.01, 145.51, 131.75},
                                                        {29.61, 72.08, 55.38}}};
  if (!setup.name.starts_with("report")) return triangulation::not_a_number;
  const auto& row = table.at(static_cast<std::size_t>(parameter));
  if (estimator == Estimator::replica) return row.front();
  return row.at(static_cast<std::size_t>(estimator));
}

std::string table_csv(std::span<const TableRow> rows) {
  std::string out =
      "geometry,draws,parameter,two_sigma,point,method,systematic_mm,random_mm,rms_mm,median_mm,"
      "half_width_68_mm,failures,over_20_percent,report_rms_mm\n";
  for (const TableRow& row : rows) {
    for (const Estimator estimator : all_estimators) {
      const ErrorStatistics& s = row.of(estimator);
      out.append(row.setup->name).append(",").append(name(row.draws)).append(",");
      out.append(name(row.parameter)).append(",").append(two_sigma(*row.setup, row.parameter));
      out.append(",").append(row.is_worst() ? "worst" : std::to_string(row.point + 1));
      out.append(",").append(name(estimator));
      for (const double value :
           {mm_per_m * s.systematic_m, mm_per_m * s.random_m, mm_per_m * s.rms_m,
            mm_per_m * s.median_m, mm_per_m * s.half_width_m, s.failures, s.over_20_percent,
            row.is_worst() ? reported_rms_mm(*row.setup, row.parameter, estimator)
                           : triangulation::not_a_number}) {
        out.append(",").append(number(value));
      }
      out += '\n';
    }
  }
  return out;
}

std::string table_text(std::span<const TableRow> rows, const MonteCarlo& monte_carlo) {
  if (rows.empty()) return {};
  const TableRow& first = rows.front();
  std::string out = first.setup->name + ": " + first.setup->description + "\n";
  out += base::text("  %s, %zu samples; the worst of five points\n",
                    first.draws == Draws::uniform ? "uniform draws within two sigmas"
                                                  : "Gaussian draws of one sigma",
                    monte_carlo.samples);
  for (const Column& column : columns) out.append("\n").append(block(column, rows));
  return out.append("\n");
}

std::string sweep_csv(std::span<const SweepRow> rows) {
  std::string out = "geometry,parameter,unit,error";
  for (const Estimator estimator : all_estimators) {
    out.append(",").append(name(estimator)).append("_mm");
  }
  out += ",located\n";
  for (const SweepRow& row : rows) {
    out.append(row.setup->name).append(",").append(name(row.parameter)).append(",");
    const ShownUnit unit = shown_unit(row.parameter);
    out.append(unit.name).append(",").append(number(unit.scale * row.error));
    for (const double error_m : row.mean_error_m) {
      out.append(",").append(number(mm_per_m * error_m));
    }
    out += ',';
    for (std::size_t i = 0; i < row.statuses.size(); ++i) {
      if (row.statuses[i] != triangulation::Status::located) continue;
      out.append(out.back() == ',' ? "" : " ").append(std::to_string(i + 1));
    }
    out += '\n';
  }
  return out;
}

}  // namespace gazed::lab::analysis
