#include "agent/lab/analysis/plots.hpp"

#include "agent/base/text.hpp"
#include "agent/lab/analysis/estimator.hpp"

namespace gazed::lab::analysis {

namespace {

std::string gnuplot_text(std::string_view text) {
  std::string result(1, '"');
  result.append(text).append(1, '"');
  return result;
}

constexpr const char* preamble = R"(set datafile separator ","
set datafile missing "nan"
set terminal svg size 1000,%d dynamic background "white" font "sans-serif,12"
set logscale y
set format y "%%g"
set grid ytics
set key below samplen 3 font ",10"
)";

/// One plot of the table: `column` of table.csv.
std::string bars(const TwoViewSetup& setup, int column, const std::string& title) {
  std::string out = "set title " + gnuplot_text(setup.name + ": " + title) + "\nplot \\\n";
  const auto place = [](double offset) {
    std::string x = "(";
    for (const Parameter parameter : all_parameters) {
      x += "strcol(3) eq " + gnuplot_text(name(parameter)) + " ? " +
           base::text("%d : ", static_cast<int>(parameter));
    }
    return x + base::text("NaN) + %.2f", offset);
  };
  std::string crosses;           // after the bars, in the key too
  constexpr double width = 0.2;  // of a bar; xrange and xtics count parameters
  for (const Estimator estimator : all_estimators) {
    const double offset = width * (static_cast<double>(estimator) - 1.5);
    const std::string row = "(strcol(1) eq " + gnuplot_text(setup.name) +
                            " && strcol(2) eq draws && strcol(5) eq \"worst\" && strcol(6) eq " +
                            gnuplot_text(name(estimator));
    out += "  \"table.csv\" using (" + place(offset) + "):" + row +
           base::text(" ? $%d : NaN) with boxes linetype %d title ", column,
                      static_cast<int>(estimator) + 1) +
           gnuplot_text(name(estimator)) + ", \\\n";
    const bool reported = column == 9 && setup.name.starts_with("report");
    if (reported && estimator != Estimator::replica) {
      crosses += "  \"\" using (" + place(offset) + "):" + row +
                 " ? $14 : NaN) with points pointtype 2 linecolor \"black\" " +
                 (estimator == Estimator::optimal ? "title \"the report\"" : "notitle") + ", \\\n";
    }
  }
  out += crosses;
  out.resize(out.size() - 4);  // the last comma
  return out + "\n";
}

/// One plot of the figure. The methods lie on top of one another: each is drawn thinner than the
/// one before.
std::string curves(const TwoViewSetup& setup, Parameter parameter) {
  const ShownUnit unit = shown_unit(parameter);
  const double end = 2.0 * unit.scale * setup.error_size(parameter).sigma;
  std::string out =
      base::text("set xrange [%g:%g]\nset xlabel ", -end, end) +
      gnuplot_text(std::string(name(parameter)) + " error, " + std::string(unit.name)) +
      "\nplot \\\n";
  for (const Estimator estimator : all_estimators) {
    const int index = static_cast<int>(estimator);
    const bool cheats = estimator == Estimator::replica;
    out += "  \"sweep.csv\" using 4:(strcol(1) eq " + gnuplot_text(setup.name) +
           " && strcol(2) eq " + gnuplot_text(name(parameter)) +
           base::text(" ? $%d : NaN) with lines linewidth %d linetype %d%s title ", 5 + index,
                      cheats ? 1 : 5 - 2 * index, index + 1, cheats ? " dashtype 2" : "") +
           gnuplot_text(name(estimator)) + (estimator == all_estimators.back() ? "\n" : ", \\\n");
  }
  return out;
}

}  // namespace

std::string table_script(std::span<const TwoViewSetup> setups, Draws draws) {
  constexpr int row_height = 420;
  std::string out = "# Draws table.svg from table.csv.\n";
  out += "draws = " + gnuplot_text(name(draws)) + "\n";
  out += base::text(preamble, row_height * static_cast<int>(setups.size()));
  out +=
      "set output \"table.svg\"\nset style fill solid 0.8 noborder\nset boxwidth 0.18\n"
      "set xrange [-0.6:4.6]\nset ylabel \"mm\"\nset xtics scale 0 font \",10\" (";
  for (const Parameter parameter : all_parameters) {
    if (parameter != Parameter::focal) out += ", ";
    out += gnuplot_text(name(parameter)) + base::text(" %d", static_cast<int>(parameter));
  }
  out += base::text(")\nset multiplot layout %zu,2\n", setups.size());
  for (const TwoViewSetup& setup : setups) {
    out += bars(setup, 9, "RMS, worst point") + bars(setup, 10, "median error, worst point");
  }
  return out + "unset multiplot\n";
}

std::string sweep_script(std::span<const TwoViewSetup> setups) {
  constexpr int height = 1200;
  std::string out = "# Draws sweep-GEOMETRY.svg from sweep.csv.\n";
  out += base::text(preamble, height);
  // At 0 the error is rounding, far below all else.
  out +=
      "set xtics font \",9\"\nset xlabel offset 0,0.5\nset key below spacing 1 height 1\nset "
      "yrange [0.01:*]\nset ylabel \"mean "
      "|error|, mm\"\n";
  for (const TwoViewSetup& setup : setups) {
    out += "\nset output " + gnuplot_text(sweep_figure(setup)) +
           "\nset multiplot layout 3,2 title " + gnuplot_text(setup.name) + "\n";
    for (const Parameter parameter : all_parameters) out += curves(setup, parameter);
    out += "unset multiplot\n";
  }
  return out;
}

std::string sweep_figure(const TwoViewSetup& setup) {
  return "sweep-" + setup.name + ".svg";
}

}  // namespace gazed::lab::analysis
