// gazelab analyze as a user runs it.
#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include "scratch.hpp"

namespace gazed::lab::analyze_command_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// No program is found there, gnuplot not either.
const Surroundings without_gnuplot{.standard_input = "/dev/null", .path = "/nowhere"};

bool gnuplot_is_installed() {
  return std::filesystem::exists("/usr/bin/gnuplot");
}

class GazelabAnalyze : public ::testing::Test {
 protected:
  Outcome run(std::vector<std::string> arguments, const Surroundings& surroundings = {}) {
    arguments.insert(arguments.begin(), "analyze");
    arguments.insert(arguments.end(), {"--out", out_.string()});
    return run_gazelab(arguments, surroundings);
  }

  [[nodiscard]] std::string text(const std::string& name) const { return file_text(out_ / name); }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(out_ / name);
  }

  ScratchFolder folder_;
  std::filesystem::path out_ = folder_ / "new folder";
};

TEST_F(GazelabAnalyze, WithoutGnuplotTableAndScriptAreWrittenAndTheMessageHelps) {
  const Outcome outcome = run({"table", "--samples", "20"}, without_gnuplot);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("gnuplot is not installed"), HasSubstr("apt-get install gnuplot-nox"),
                    HasSubstr("gnuplot table.gp")));
  const std::string csv = text("table.csv");
  EXPECT_THAT(csv, StartsWith("geometry,draws,parameter,two_sigma,point,method,systematic_mm,"));
  // 3 geometries, 2 kinds of draws, 5 parameters, 5 points and the worst, 4 methods.
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * 2 * 5 * 6 * 4);
  EXPECT_THAT(csv, HasSubstr("\nnao-v6,gaussian,translation,4 mm,worst,linear-mmse,"));
  EXPECT_THAT(text("table.gp"), HasSubstr("set output \"table.svg\""));
  EXPECT_THAT(outcome.out, HasSubstr("report: R = Ry(-0.5) Rx(0.5)"));
  EXPECT_THAT(outcome.out, HasSubstr("replica"));
  EXPECT_FALSE(exists("table.svg"));
}

TEST_F(GazelabAnalyze, WithoutGnuplotTheSweepIsWritten) {
  const Outcome outcome =
      run({"sweep", "--samples", "3", "--geometry", "report,nao-v6"}, without_gnuplot);
  EXPECT_EQ(outcome.exit_code, 1);
  const std::string csv = text("sweep.csv");
  EXPECT_THAT(csv, StartsWith("geometry,parameter,unit,error,optimal_mm,rectification_mm,"
                              "linear-mmse_mm,replica_mm,located\nreport,focal,px,-4,"));
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 5 * 3);
  EXPECT_THAT(csv, HasSubstr("\nreport,translation,mm,2.6,"));
  EXPECT_THAT(csv, Not(HasSubstr("report-yaw")));
}

TEST_F(GazelabAnalyze, SourcesNeedNoGnuplot) {
  const Outcome outcome = run({"sources"}, without_gnuplot);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("focal length"));
  EXPECT_THAT(text("sources.csv"), StartsWith("source,sigma,unit,at_0.3_m,at_0.75_m,at_1.5_m\n"
                                              "focal length,10,px,"));
}

TEST_F(GazelabAnalyze, GnuplotDraws) {
  if (!gnuplot_is_installed()) GTEST_SKIP() << "needs gnuplot";
  const Outcome table = run({"table", "--samples", "20", "--draws", "uniform"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(text("table.svg"), AllOf(HasSubstr("<svg"), HasSubstr("rectification")));
  const Outcome sweep = run({"sweep", "--samples", "21"});
  EXPECT_EQ(sweep.exit_code, 0) << sweep.err;
  for (const char* name : {"sweep-report.svg", "sweep-report-yaw.svg", "sweep-nao-v6.svg"}) {
    EXPECT_THAT(text(name), AllOf(HasSubstr("<svg"), HasSubstr("rotation error, rad"))) << name;
  }
}

TEST_F(GazelabAnalyze, SameSeedSameFiles) {
  const std::vector<std::string> arguments = {"table", "--samples", "30", "--seed", "7"};
  const std::string shown = run(arguments, without_gnuplot).out;
  const std::string csv = text("table.csv");
  const std::string script = text("table.gp");
  EXPECT_EQ(run(arguments, without_gnuplot).out, shown);
  EXPECT_EQ(text("table.csv"), csv);
  EXPECT_EQ(text("table.gp"), script);
  static_cast<void>(run({"table", "--samples", "30", "--seed", "8"}, without_gnuplot));
  EXPECT_NE(text("table.csv"), csv);
}

TEST_F(GazelabAnalyze, OneGeometryIsTheSameAloneAndAmongOthers) {
  static_cast<void>(run({"table", "--samples", "30"}, without_gnuplot));
  const std::string all = text("table.csv");
  static_cast<void>(run({"table", "--samples", "30", "--geometry", "nao-v6", "--draws", "gaussian"},
                        without_gnuplot));
  const std::string one = text("table.csv");
  EXPECT_THAT(all, HasSubstr(one.substr(one.find('\n'))));
}

TEST_F(GazelabAnalyze, BadArguments) {
  const auto refused = [this](const std::vector<std::string>& arguments, const char* what) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << what;
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(out_));
  };
  refused({}, "WHAT: nothing found; it is needed");
  refused({"figure"}, "figure");
  refused({"table", "--samples", "1"}, "--samples");
  refused({"table", "--samples", "many"}, "many");
  refused({"table", "--geometry", "nao-v9"}, "nao-v9");
  refused({"table", "--draws", "cauchy"}, "cauchy");
  refused({"table", "--seed", "-1"}, "--seed: '-1' found; allowed: 0 to 4294967295");
  refused({"sweep", "--draws", "gaussian"}, "--draws is not for sweep");
  refused({"sweep", "--seed", "3"}, "--seed is not for sweep");
  refused({"sources", "--geometry", "report"}, "--geometry is not for sources");
}

TEST_F(GazelabAnalyze, FolderThatCannotBeMade) {
  write_text(out_, "a file");
  const Outcome outcome = run({"sweep"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("cannot be made a folder"));
}

}  // namespace
}  // namespace gazed::lab::analyze_command_test
