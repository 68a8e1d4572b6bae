#include "agent/lab/pair_file.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>

#include "scratch.hpp"

namespace gazed::lab::pair_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

constexpr const char* k_line = "[[752, 0, 331], [0, 752, 253], [0, 0, 1]]\n";

/// The smallest file that is enough, one key a line.
std::string least_file() {
  return std::string("K1 = ") + k_line + "K2 = " + k_line +
         "R = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nt = [-0.1, 0, 0]\npixel_sigma_px = 0.3\n";
}

/// That with the line of one key replaced, or gone for an empty line.
std::string with(const std::string& key, const std::string& line) {
  std::string text = least_file();
  const std::size_t at = text.find(key + " = ");
  return text.replace(at, text.find('\n', at) - at, line);
}

CameraPair parsed_pair(const std::string& text) {
  return parse_pair(text, "pair.toml");
}

TEST(PairFile, AbsentOptionsMeanNoDistortionNoErrorAndTheUsualGate) {
  const CameraPair pair = parsed_pair(least_file());
  EXPECT_EQ(pair.cameras[0], pair.cameras[1]);
  EXPECT_EQ(pair.cameras[0].model.focal_px, Eigen::Vector2d(752, 752));
  EXPECT_EQ(pair.cameras[0].model.centre_px, Eigen::Vector2d(331, 253));
  EXPECT_EQ(pair.cameras[0].model.distortion, (std::array<double, 5>{}));
  EXPECT_EQ(pair.cam2_from_cam1.translation, Eigen::Vector3d(-0.1, 0, 0));
  EXPECT_EQ(pair.pixel_sigma_px, 0.3);
  EXPECT_EQ(pair.rotation_sigma_rad, 0.0);
  EXPECT_EQ(pair.translation_sigma_m, 0.0);
  EXPECT_EQ(pair.focal_sigma_px, 0.0);
  EXPECT_EQ(pair.centre_sigma_px, 0.0);
  EXPECT_EQ(pair.relative_sigma_max, 0.15);
  EXPECT_THAT(pair.warnings, IsEmpty());
  EXPECT_THAT(error_sources(pair, two_views(pair, {331, 253}, {300, 253})).all(), IsEmpty());
}

TEST(PairFile, DistortionOfFourOrWithZerosBehindIsThatOfFive) {
  for (const char* d1 : {"[0.1, -0.2, 0.001, 0.002]", "[0.1, -0.2, 0.001, 0.002, 0, 0, 0, 0]",
                         "[0.1, -0.2, 0.001, 0.002, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]"}) {
    const CameraPair pair = parsed_pair(least_file() + "D1 = " + d1 + "\n");
    EXPECT_THAT(pair.cameras[0].model.distortion, ElementsAre(0.1, -0.2, 0.001, 0.002, 0.0));
  }
  for (const char* d1 : {"[0.1, -0.2, 0.001]", "[0.1, -0.2, 0, 0, 0, 0.5, 0, 0]"}) {
    EXPECT_THAT([&] { static_cast<void>(parsed_pair(least_file() + "D1 = " + d1 + "\n")); },
                ThrowsMessage<std::invalid_argument>(
                    HasSubstr("the rational model is not gazed's: calibrate with 5")));
  }
}

TEST(PairFile, ReadsEveryOption) {
  const CameraPair pair = parsed_pair(
      least_file() +
      "D1 = [0.1, -0.2, 0.001, 0.002, 0.3]\nD2 = [0, 0, 0, 0, 0.5]\nrotation_sigma_rad = 0.01\n"
      "translation_sigma_m = 0.002\nfocal_sigma_px = 3\ncentre_sigma_px = 4\n"
      "relative_sigma_max = 0.5\n");
  EXPECT_THAT(pair.cameras[0].model.distortion, ElementsAre(0.1, -0.2, 0.001, 0.002, 0.3));
  EXPECT_THAT(pair.cameras[1].model.distortion, ElementsAre(0, 0, 0, 0, 0.5));
  EXPECT_EQ(pair.rotation_sigma_rad, 0.01);
  EXPECT_EQ(pair.translation_sigma_m, 0.002);
  EXPECT_EQ(pair.focal_sigma_px, 3.0);
  EXPECT_EQ(pair.centre_sigma_px, 4.0);
  EXPECT_EQ(pair.relative_sigma_max, 0.5);
}

TEST(PairFile, EqualCamerasShareTheirErrorsAndOthersDoNot) {
  const std::string sigmas = "focal_sigma_px = 3\ncentre_sigma_px = 4\n";
  const CameraPair one = parsed_pair(least_file() + sigmas);
  const CameraPair two = parsed_pair(least_file() + sigmas + "D2 = [0.1, 0, 0, 0, 0]\n");
  const auto sources = [](const CameraPair& pair) {
    return error_sources(pair, two_views(pair, {100, 200}, {150, 200})).all().size();
  };
  EXPECT_EQ(sources(one), 3U);  // focal length, x and y of the centre
  EXPECT_EQ(sources(two), 6U);
}

TEST(PairFile, SkewIsUndone) {
  const CameraPair pair = parsed_pair(with("K1", "K1 = [[700, 7, 330], [0, 710, 250], [0, 0, 1]]"));
  const Eigen::Matrix3d k{{700, 7, 330}, {0, 710, 250}, {0, 0, 1}};
  const Eigen::Vector2d normalised(0.2, -0.3);
  const geometry::Pixel pixel = (k * normalised.homogeneous()).hnormalized();
  const triangulation::TwoViews views = two_views(pair, pixel, {331, 253});
  constexpr double rounding = 1e-12;
  EXPECT_LT((views.point_1.normalised - normalised).norm(), rounding);
  EXPECT_TRUE(views.point_1.pixel_jacobian.isApprox(k.topLeftCorner<2, 2>(), rounding));
}

TEST(PairFile, RoundedRotationBecomesTheNearestOne) {
  const CameraPair pair =
      parsed_pair(with("R", "R = [[0.921061, 0, -0.389418], [0, 1, 0], [0.389418, 0, 0.921061]]"));
  const Eigen::Matrix3d& r = pair.cam2_from_cam1.rotation;
  EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  constexpr double decimals = 1e-6;
  EXPECT_NEAR(std::atan2(r(2, 0), r(0, 0)), 0.4, decimals);
}

TEST(PairFile, BaselineInMillimetresIsWarnedOf) {
  EXPECT_THAT(parsed_pair(with("t", "t = [28, 29, -24]")).warnings,
              ElementsAre("pair.toml:4: t: the baseline is 46.9 m: t is in metres; were these "
                          "millimetres or another unit?"));
  EXPECT_THAT(parsed_pair(with("t", "t = [10, 0, 0]")).warnings, IsEmpty());
}

TEST(PairFile, NoBaselineIsWarnedOf) {
  EXPECT_THAT(parsed_pair(with("t", "t = [0, 0, 0]")).warnings,
              ElementsAre("pair.toml:4: t: no baseline: every point will be DEGENERATE"));
}

struct BadPair {
  const char* name;
  const char* key;   // whose line is replaced
  const char* line;  // by this
  const char* message;
};

class PairFileRefuses : public ::testing::TestWithParam<BadPair> {};

TEST_P(PairFileRefuses, WithLineKeyWhatWasFoundAndWhatIsAllowed) {
  EXPECT_THAT([&] { static_cast<void>(parsed_pair(with(GetParam().key, GetParam().line))); },
              ThrowsMessage<std::invalid_argument>(HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Files, PairFileRefuses,
    ::testing::Values(
        BadPair{"UnknownKey", "pixel_sigma_px", "pixl_sigma_px = 1",
                "pair.toml:5: pixl_sigma_px: unknown key; the nearest known is pixel_sigma_px; "
                "allowed: K1, K2, R, t, "},
        BadPair{"UnknownTable", "t", "[camera]", "unknown key"},
        BadPair{"NoK1", "K1", "", "K1: nothing found; allowed: 3 rows, [[...], ...]"},
        BadPair{"NoK2", "K2", "", "pair.toml: K2: nothing found; allowed: 3 rows"},
        BadPair{"NoR", "R", "", "R: nothing found; allowed: 3 rows"},
        BadPair{"NoT", "t", "", "t: nothing found; allowed: an array of 3 numbers, metres"},
        BadPair{"NoSigma", "pixel_sigma_px", "",
                "pixel_sigma_px: nothing found; allowed: a number, 1e-06 to 1000"},
        BadPair{"FlatK", "K1", "K1 = [752, 0, 331, 0, 752, 253, 0, 0, 1]",
                "pair.toml:1: K1: [ 752, 0, 331"},
        BadPair{
            "SingularK", "K2", "K2 = [[752, 0, 331], [0, 0, 253], [0, 0, 1]]",
            "pair.toml:2: K2: [ [ 752, 0, 331 ], [ 0, 0, 253 ], [ 0, 0, 1 ] ] found; allowed: a "
            "calibration matrix, [[fx, skew, cx], [0, fy, cy], [0, 0, 1]], not singular"},
        BadPair{"ZeroK", "K1", "K1 = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]", "K1: [ [ 0, 0, 0 ], "},
        BadPair{"NotANumberInK", "K1", "K1 = [[nan, 0, 331], [0, 752, 253], [0, 0, 1]]",
                "K1: [ [ nan, 0, 331"},
        BadPair{"TransposedK", "K1", "K1 = [[752, 0, 0], [0, 752, 0], [331, 253, 1]]",
                "found; allowed: [[fx, skew, cx], [0, fy, cy], [0, 0, 1]]"},
        BadPair{"ScaledK", "K1", "K1 = [[1504, 0, 662], [0, 1504, 506], [0, 0, 2]]",
                "found; allowed: [[fx, skew, cx], [0, fy, cy], [0, 0, 1]]"},
        BadPair{"NegativeFocalLength", "K1", "K1 = [[-752, 0, 331], [0, 752, 253], [0, 0, 1]]",
                "K1: focal lengths -752 and 752 found; allowed: from 1 px"},
        BadPair{"TinyFocalLength", "K1", "K1 = [[1e-9, 0, 331], [0, 752, 253], [0, 0, 1]]",
                "K1: focal lengths 1e-09 and 752 found; allowed: from 1 px"},
        BadPair{
            "NoRotation", "R", "R = [[1, 0, 0], [0, 1.1, 0], [0, 0, 1]]",
            "pair.toml:3: R: no rotation: R^T R is up to 0.21 off the identity, the determinant "
            "is 1.1; allowed: up to 1e-05 off, determinant 1"},
        BadPair{"Reflection", "R", "R = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
                "R: no rotation: R^T R is up to 0 off the identity, the determinant is -1"},
        BadPair{"ZeroRotation", "R", "R = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]",
                "R: no rotation: R^T R is up to 1 off"},
        BadPair{"RotationVector", "R", "R = [0, 0.5, 0]",
                "R: [ 0, 0.5, 0 ] found; allowed: 3 rows"},
        BadPair{"TwoNumbersInT", "t", "t = [1, 2]", "t: [ 1, 2 ] found; allowed: an array of 3"},
        BadPair{"InfiniteT", "t", "t = [1, 2, inf]", "t: [ 1, 2, inf ] found"},
        BadPair{"ZeroSigma", "pixel_sigma_px", "pixel_sigma_px = 0",
                "pixel_sigma_px: 0 found; allowed: a number, 1e-06 to 1000"},
        BadPair{"SigmaAsText", "pixel_sigma_px", "pixel_sigma_px = '0.3'", "'0.3' found"},
        BadPair{"ThreeDistortions", "pixel_sigma_px", "pixel_sigma_px = 1\nD1 = [0.1, 0, 0]",
                "pair.toml:6: D1: [ 0.1, 0, 0 ] found; allowed: "},
        BadPair{"NegativeSigma", "pixel_sigma_px", "pixel_sigma_px = 1\nfocal_sigma_px = -1",
                "focal_sigma_px: -1 found; allowed: a number, 0 to 1000"},
        BadPair{"RotationSigmaInDegrees", "pixel_sigma_px",
                "pixel_sigma_px = 1\nrotation_sigma_rad = 1.15",
                "rotation_sigma_rad: 1.15 found; allowed: a number, 0 to 1"},
        BadPair{"Gate", "pixel_sigma_px", "pixel_sigma_px = 1\nrelative_sigma_max = 0",
                "relative_sigma_max: 0 found; allowed: a number, 0.001 to 10"},
        BadPair{"NoToml", "t", "t: [1, 2, 3]", "pair.toml:4: not TOML: "},
        BadPair{"TwiceTheSame", "t", "R = 1", "pair.toml:4: not TOML: "}),
    [](const auto& pair) { return pair.param.name; });

TEST(PairFile, EmptyFileMissesItsFirstKey) {
  EXPECT_THAT([] { static_cast<void>(parsed_pair("")); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("K1: nothing found")));
}

TEST(PairFile, MissingFileIsNamed) {
  EXPECT_THAT([] { static_cast<void>(read_pair_file("/nowhere/pair.toml")); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("/nowhere/pair.toml: cannot be read: No such file or directory")));
}

}  // namespace
}  // namespace gazed::lab::pair_file_test
