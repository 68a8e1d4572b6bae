// Real pictures, where they are present: fidelity to the reference, and whether the winner and the
// distinctness are of use. Prints what it measures.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "agent/saliency/own_parts.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/comparison.hpp"

namespace gazed::saliency::photographs_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pictures(const std::string& folder, const std::string& name_part = "") {
  std::vector<fs::path> found;
  const fs::path root = fs::path(GAZED_SHARED) / "data" / folder;
  if (!fs::exists(root)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if ((extension == ".jpg" || extension == ".png") &&
        entry.path().filename().string().find(name_part) != std::string::npos)
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string missing(const std::string& folder) {
  return "no pictures in " GAZED_SHARED "/data/" + folder;
}

cv::Mat rgb_of(const fs::path& path) {
  cv::Mat picture = cv::imread(path.string(), cv::IMREAD_COLOR);
  if (!picture.empty()) cv::cvtColor(picture, picture, cv::COLOR_BGR2RGB);
  return picture;
}

// As gazelab does: the longer side becomes 640.
cv::Mat longer_side_640(const cv::Mat& picture) {
  const double scale = 640.0 / std::max(picture.cols, picture.rows);
  cv::Mat out;
  cv::resize(picture, out,
             {static_cast<int>(std::lround(picture.cols * scale)),
              static_cast<int>(std::lround(picture.rows * scale))},
             0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return out;
}

base::ImageView view_of(const cv::Mat& rgb) {
  return {rgb.data, rgb.cols, rgb.rows, static_cast<int>(rgb.step), base::PixelFormat::rgb24};
}

class Photographs : public testing::TestWithParam<SaliencyProfile> {
 protected:
  SaliencyResult look(const fs::path& path) {
    frame = longer_side_640(rgb_of(path));
    SaliencyResult result = Saliency(settings, frame.cols, frame.rows).examine(view_of(frame));
    result.map = {};  // its owner is gone
    return result;
  }
  [[nodiscard]] const char* name() const {
    return profile_names[static_cast<std::size_t>(GetParam())].data();
  }
  [[nodiscard]] bool is(SaliencyProfile profile) const { return GetParam() == profile; }

  SaliencySettings settings = [] {
    SaliencySettings s;
    s.profile = GetParam();
    return s;
  }();
  cv::Mat frame;
};

INSTANTIATE_TEST_SUITE_P(Profiles, Photographs,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust,
                                         SaliencyProfile::surround),
                         profile_name);

TEST_P(Photographs, FollowTheReference) {
  if (is(SaliencyProfile::surround)) GTEST_SKIP() << "its definition: surroundedness_test.cpp";
  const auto files = pictures("osie");
  if (files.empty()) GTEST_SKIP() << missing("osie");
  std::vector<double> correlations;
  int same_winner = 0;
  for (const fs::path& file : files) {
    cv::Mat vga;
    cv::resize(rgb_of(file), vga, {640, 480}, 0, 0, cv::INTER_AREA);
    const Comparison c = compare(view_of(vga), settings);
    correlations.push_back(c.correlation);
    same_winner += c.winner_distance <= 1 ? 1 : 0;
  }
  std::sort(correlations.begin(), correlations.end());
  const double median = correlations[correlations.size() / 2];
  const double share = same_winner / static_cast<double>(files.size());
  std::printf("%s: %zu photographs, correlation median %.6f, minimum %.6f, same winner %.3f\n",
              name(), files.size(), median, correlations.front(), share);
  EXPECT_GE(median, 0.9999);  // these three: agent/saliency/README.md
  EXPECT_GE(correlations.front(), 0.98);
  EXPECT_GE(share, 0.98);
}

TEST_P(Photographs, TheWinnerIsOnTheObject) {
  const auto files = pictures("ecssd/images");
  if (files.empty()) GTEST_SKIP() << missing("ecssd");
  int on_object = 0, distinct = 0;
  for (const fs::path& file : files) {
    const SaliencyResult result = look(file);
    cv::Mat mask =
        cv::imread((file.parent_path().parent_path() / "masks" / file.stem()).string() + ".png",
                   cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(mask.empty());
    cv::resize(mask, mask, frame.size(), 0, 0, cv::INTER_NEAREST);
    const cv::Point at(std::min(static_cast<int>(std::lround(result.peak_px.x())), mask.cols - 1),
                       std::min(static_cast<int>(std::lround(result.peak_px.y())), mask.rows - 1));
    on_object += mask.at<std::uint8_t>(at) > 127 ? 1 : 0;
    distinct += static_cast<double>(result.distinctness) >= settings.distinctness_min ? 1 : 0;
  }
  const auto count = static_cast<double>(files.size());
  std::printf("%s: winner on the object %.3f, distinct %.3f of %zu\n", name(), on_object / count,
              distinct / count, files.size());
  const bool report = is(SaliencyProfile::report);
  EXPECT_GE(on_object / count, is(SaliencyProfile::surround) ? 0.72 : report ? 0.65 : 0.68);
  EXPECT_GE(distinct / count, report ? 0.75 : 0.9);
}

TEST_P(Photographs, WinnersOnTheBorder) {
  const auto files = pictures("nao_canteen");
  if (files.empty()) GTEST_SKIP() << missing("nao_canteen");
  int on_border = 0;
  for (const fs::path& file : files) {
    const geometry::Pixel p = look(file).peak_px;
    on_border += std::min({p.x(), p.y(), frame.cols - 1 - p.x(), frame.rows - 1 - p.y()}) < 24.0;
  }
  std::printf("%s: %d of %zu winners within 24 px of the border\n", name(), on_border,
              files.size());
  if (!is(SaliencyProfile::report)) {
    EXPECT_EQ(on_border, 0);
  }
}

TEST_P(Photographs, TurfHasNoSalientObject) {
  const auto files = pictures("nao_v6_optitrack", "imagebottom");
  if (files.empty()) GTEST_SKIP() << missing("nao_v6_optitrack");
  for (const fs::path& file : files) {
    const double distinctness = look(file).distinctness;
    std::printf("%s: %.3f %s\n", name(), distinctness, file.parent_path().filename().c_str());
    EXPECT_LT(distinctness, settings.distinctness_min) << file;
  }
}

/// HeadYaw and HeadPitch as measured, the only row of record.csv.
geometry::HeadAngles recorded_angles(const fs::path& csv) {
  std::ifstream lines(csv);
  std::string word;
  std::getline(lines, word);  // the names
  std::array<double, 5> numbers{};
  for (std::size_t i = 0; i < numbers.size() && std::getline(lines, word, ','); ++i)
    if (i > 0) numbers[i] = std::stod(word);  // the first is a time of day
  return {numbers[4], numbers[2]};
}

// What is white and below the middle are the robot's feet: the turf is green, but for single blades
// in the sun.
TEST(StandingRobot, ItsFeetAreLeftOut) {
  const auto files = pictures("nao_v6_optitrack", "imagebottom");
  if (files.empty()) GTEST_SKIP() << missing("nao_v6_optitrack");
  constexpr double least_share = 0.95;
  const cv::Size blades(9, 9);
  const geometry::Rig rig =
      geometry::robot_profile("nao-v6", geometry::CameraPosition::bottom)->rig;
  OwnParts parts(rig.camera, false, true);
  int white = 0, left_out = 0;
  for (const fs::path& file : files) {
    const geometry::HeadAngles head = recorded_angles(file.parent_path() / "record.csv");
    const auto kept = parts.kept(geometry::cam_from_torso(rig.head, head));
    cv::Mat frame = rgb_of(file);
    cv::blur(frame, frame, blades);
    ASSERT_EQ(frame.size(), cv::Size(640, 480));
    int white_here = 0, left_out_here = 0;
    for (int y = 240; y < frame.rows; ++y) {
      for (int x = 0; x < frame.cols; ++x) {
        const auto pixel = frame.at<cv::Vec3b>(y, x);
        if (std::min({pixel[0], pixel[1], pixel[2]}) < 170) continue;
        const int column = std::min((x + 8) / saliency_cell_px, 39);
        const int row = std::min((y + 8) / saliency_cell_px, 29);
        ++white_here;
        left_out_here += !kept.empty() && kept[static_cast<std::size_t>(row * 40 + column)] == 0;
      }
    }
    std::printf("%s: %d white pixels, %d left out\n", file.parent_path().filename().c_str(),
                white_here, left_out_here);
    white += white_here;
    left_out += left_out_here;
  }
  EXPECT_GT(white, 10'000);
  EXPECT_GE(left_out, least_share * white);
}

TEST_P(Photographs, ARedObjectIsDistinct) {
  const auto files = pictures("report_like", "red_");
  if (files.empty()) GTEST_SKIP() << missing("report_like");
  for (const fs::path& file : files) {
    const double distinctness = look(file).distinctness;
    std::printf("%s: %.3f %s\n", name(), distinctness, file.filename().c_str());
    EXPECT_GE(distinctness, settings.distinctness_min) << file;
  }
}

}  // namespace
}  // namespace gazed::saliency::photographs_test
