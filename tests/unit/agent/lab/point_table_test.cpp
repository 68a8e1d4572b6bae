#include "agent/lab/point_table.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <iterator>
#include <string>

#include "scratch.hpp"
#include "triangulated.hpp"

namespace gazed::lab::point_table_test {
namespace {

using ::testing::SizeIs;

std::size_t files_in(const ScratchFolder& folder) {
  const std::filesystem::directory_iterator files(folder.path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(PointTable, TwoOfOneNameDoNotShareAFile) {
  const ScratchFolder folder;
  PointTable first(folder / "points.csv"), second(folder / "points.csv");
  for (int i = 0; i < 1000; ++i) first.add("first", {});
  second.add("second", {});
  first.finish();
  EXPECT_THAT(points_of(file_text(folder / "points.csv")), SizeIs(1000));
  second.finish();
  const auto points = points_of(file_text(folder / "points.csv"));
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_EQ(points[0].id, "second");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(PointTable, UnfinishedLeavesWhatWasThere) {
  const ScratchFolder folder;
  write_text(folder / "points.csv", "old");
  { PointTable(folder / "points.csv").add("new", {}); }
  EXPECT_EQ(file_text(folder / "points.csv"), "old");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(PointTable, ALinkStaysOneAndWhatItNamesIsReplaced) {
  const ScratchFolder folder, elsewhere;
  write_text(elsewhere / "points.csv", "old");
  std::filesystem::create_symlink(elsewhere / "points.csv", folder / "link.csv");
  PointTable table(folder / "link.csv");
  table.add("new", {});
  table.finish();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.csv"));
  EXPECT_THAT(points_of(file_text(elsewhere / "points.csv")), SizeIs(1));
}

TEST(PointTable, ColumnsStayColumnsForAnyNumber) {
  triangulation::PointEstimate point;
  point.point_m = {0.02, -0.03, 0.3};
  point.range_m = 0.302;
  point.range_sigma_m = 0.012;
  point.residual_px = 0.25;
  const std::string usual = column_row("lamp", point);
  EXPECT_EQ(usual,
            "lamp          INVALID_INPUT     0.0200     -0.0300      0.3000      0.3020 +- 0.0120"
            "        0.25\n");
  point.point_m.setConstant(-1e300);
  point.range_m = point.range_sigma_m = point.residual_px = 1e150;
  EXPECT_LE(column_row("lamp", point).size(), usual.size() + 8);
}

}  // namespace
}  // namespace gazed::lab::point_table_test
