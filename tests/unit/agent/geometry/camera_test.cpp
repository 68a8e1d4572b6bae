#include "agent/geometry/camera.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace gazed::geometry::camera_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// normalise() stops at 1e-13 of the image plane: 6e-11 px at a focal length of 600 px.
constexpr double round_trip_px = 1e-9;
// Two implementations of one polynomial round differently at 1e-13 of a pixel.
constexpr double rounding_px = 1e-10;

struct Lens {
  std::string_view name;
  std::array<double, 5> distortion;
};

constexpr std::array<double, 5> nao_v4_lens{-0.0545, 0.0692, -0.0024, -0.0011, 0.0};

// The coefficients are k1, k2, p1, p2, k3.
const std::vector<Lens> lenses{
    {"none", {}},
    {"nao_v4", nao_v4_lens},  // naoqi_driver, camera_info_definitions.hpp
    {"barrel", {-0.27, -0.04, 0.0018, -0.0003, 0.24}},
    {"pincushion", {0.2, 0.05, 0.0, 0.0, 0.0}},
    {"tangential", {0.0, 0.0, 0.02, -0.015, 0.0}},
    {"sixth_order", {0.0, 0.0, 0.0, 0.0, -0.1}},
};

CameraModel camera_with(const std::array<double, 5>& distortion) {
  return {640, 480, {556.8, 555.9}, {309.4, 230.6}, distortion};
}

// One with an image plane in units of its pixels, for lenses computed by hand.
CameraModel unit_camera(const std::array<double, 5>& distortion) {
  return {640, 480, {1.0, 1.0}, {0.0, 0.0}, distortion};
}

double uniform(std::mt19937_64& bits, double min, double max) {
  return min + (max - min) * (static_cast<double>(bits() >> 11) * 0x1p-53);
}

TEST(Camera, CalibrationMatrix) {
  const Eigen::Matrix3d expected =
      (Eigen::Matrix3d() << 556.8, 0, 309.4, 0, 555.9, 230.6, 0, 0, 1).finished();
  EXPECT_EQ(calibration_matrix(camera_with({})), expected);
}

TEST(Camera, ContainsThePixelsOfItsImage) {
  const CameraModel camera = camera_with({});
  EXPECT_TRUE(camera.contains({0.0, 0.0}));
  EXPECT_TRUE(camera.contains({639.0, 479.0}));
  EXPECT_FALSE(camera.contains({639.5, 100.0}));
  EXPECT_FALSE(camera.contains({100.0, -0.1}));
  EXPECT_TRUE(camera.contains({10.0, 469.0}, 10.0));
  EXPECT_FALSE(camera.contains({9.0, 100.0}, 10.0));
  EXPECT_FALSE(camera.contains({nan, 100.0}));
}

TEST(Camera, ProjectsAsOpenCv) {
  // cv::projectPoints of OpenCV 5.0.0, with no rotation and no translation.
  struct Case {
    std::array<double, 5> distortion;
    Eigen::Vector2d normalised;
    Pixel pixel;
  };
  const std::array<double, 5> barrel{-0.27, -0.04, 0.0018, -0.0003, 0.24};
  for (const Case& c : {Case{nao_v4_lens, {0.3, -0.2}, {475.42236113919995, 119.8708927136}},
                        Case{nao_v4_lens, {-0.5, 0.4}, {33.95952563200001, 449.8486321472}},
                        Case{barrel, {0.3, -0.2}, {470.3800026112, 123.56909528959999}},
                        Case{barrel, {-0.5, 0.4}, {58.53291366399998, 431.32482561439997}}}) {
    const CameraModel camera = camera_with(c.distortion);
    EXPECT_LT((pixel_of(camera, c.normalised) - c.pixel).norm(), rounding_px);
    const auto projected = project(camera, {2.0 * c.normalised.x(), 2.0 * c.normalised.y(), 2.0});
    ASSERT_TRUE(projected);
    EXPECT_LT((*projected - c.pixel).norm(), rounding_px);
  }
}

TEST(Camera, PinholeNormalisesByItsCalibrationMatrix) {
  const CameraModel camera = camera_with({});
  const auto normalised = normalise(camera, {309.4 + 55.68, 230.6 - 111.18});
  ASSERT_TRUE(normalised);
  EXPECT_NEAR(normalised->x(), 0.1, 1e-15);
  EXPECT_NEAR(normalised->y(), -0.2, 1e-15);
}

class LensTest : public testing::TestWithParam<Lens> {};

TEST_P(LensTest, UndoesWhatItDidAllOverTheFrame) {
  const CameraModel camera = camera_with(GetParam().distortion);
  std::mt19937_64 bits(1);
  for (int i = 0; i < 20'000; ++i) {
    const Pixel pixel{uniform(bits, -0.5, 639.5), uniform(bits, -0.5, 479.5)};
    const auto normalised = normalise(camera, pixel);
    ASSERT_TRUE(normalised) << pixel.transpose();
    ASSERT_LT((pixel_of(camera, *normalised) - pixel).norm(), round_trip_px) << pixel.transpose();
    const auto projected = project(camera, 0.7 * Eigen::Vector3d(normalised->homogeneous()));
    ASSERT_TRUE(projected) << pixel.transpose();
    ASSERT_LT((*projected - pixel).norm(), round_trip_px) << pixel.transpose();
  }
}

TEST_P(LensTest, JacobianIsTheLimitOfDifferences) {
  // Central differences of step 1e-6: truncation 1e-12 f, rounding 1e-13 px / 1e-6.
  constexpr double step = 1e-6, tolerance_px = 1e-5;
  const CameraModel camera = camera_with(GetParam().distortion);
  std::mt19937_64 bits(2);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d u{uniform(bits, -0.6, 0.6), uniform(bits, -0.45, 0.45)};
    Eigen::Matrix2d differences;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d h = step * Eigen::Vector2d::Unit(k);
      differences.col(k) = (pixel_of(camera, u + h) - pixel_of(camera, u - h)) / (2.0 * step);
    }
    ASSERT_LT((pixel_jacobian(camera, u) - differences).norm(), tolerance_px) << u.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, LensTest, testing::ValuesIn(lenses),
                         [](const auto& test) { return std::string(test.param.name); });

// r (1 - r^2 / 2) rises to 0.5443 at r = sqrt(2/3) and falls from there.
TEST(Camera, PixelBeyondTheFoldHasNoRay) {
  const CameraModel camera = unit_camera({-0.5, 0.0, 0.0, 0.0, 0.0});
  const double fold = std::sqrt(2.0 / 3.0), fold_px = fold * 2.0 / 3.0;
  for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    const auto inside = normalise(camera, direction * (fold_px - 1e-6));
    ASSERT_TRUE(inside);
    EXPECT_LT(inside->norm(), fold);
    EXPECT_FALSE(normalise(camera, direction * (fold_px + 1e-6)));
  }
}

TEST(Camera, PointBeyondTheFoldHasNoPixel) {
  // At r = 1.2 the polynomial gives 0.336, which is the pixel of r = 0.357 as well.
  const CameraModel camera = unit_camera({-0.5, 0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(project(camera, {0.8, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {0.83, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {1.2, 0.0, 1.0}));
}

// r (1 - 0.8 r^2 + 0.25 r^4) rises to 0.4727 at r = 0.782, falls to r = 1.144 and rises again.
TEST(Camera, BranchBeyondAFoldThatOpensAgainIsNotTaken) {
  const CameraModel camera = unit_camera({-0.8, 0.25, 0.0, 0.0, 0.0});
  const auto inside = normalise(camera, {0.47, 0.0});
  ASSERT_TRUE(inside);
  EXPECT_LT(inside->x(), 0.782);
  EXPECT_FALSE(normalise(camera, {0.6, 0.0}));  // only r = 1.42 gives it
  EXPECT_FALSE(project(camera, {1.42, 0.0, 1.0}));
}

TEST(Camera, TangentialDistortionTooStrongForTheRadiusIsRefused) {
  // p2 alone: x' = x + p2 (3 x^2 + y^2) has no slope left at x = -1 / (6 p2) = -0.833.
  const CameraModel camera = unit_camera({0.0, 0.0, 0.0, 0.2, 0.0});
  EXPECT_TRUE(project(camera, {-0.83, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {-0.84, 0.0, 1.0}));
  EXPECT_FALSE(normalise(camera, {-0.5, 0.0}));  // least x' on the axis: -0.417
}

TEST(Camera, PixelThatIsNoNumberOrOverflowsHasNoRay) {
  for (const auto& lens : lenses) {
    const CameraModel camera = camera_with(lens.distortion);
    EXPECT_FALSE(normalise(camera, {nan, 1.0})) << lens.name;
    EXPECT_FALSE(normalise(camera, {1.0, nan})) << lens.name;
    EXPECT_FALSE(normalise(camera, {infinity, 1.0})) << lens.name;
    EXPECT_FALSE(normalise(camera, {1.0, -infinity})) << lens.name;
    EXPECT_FALSE(normalise(camera, {1e200, 1.0})) << lens.name;
  }
}

TEST(Camera, FocalLengthOfZeroHasNoRay) {
  CameraModel camera = camera_with({});
  camera.focal_px.setZero();
  EXPECT_FALSE(normalise(camera, {1.0, 1.0}));
}

TEST(Camera, DistortionThatIsNotANumberHasNoRayAndNoPixel) {
  const CameraModel camera = camera_with({nan, 0.0, 0.0, 0.0, 0.0});
  EXPECT_FALSE(normalise(camera, {1.0, 1.0}));
  EXPECT_FALSE(project(camera, {0.1, 0.1, 1.0}));
}

TEST(Camera, PointNotInFrontHasNoPixel) {
  const CameraModel camera = camera_with({});
  EXPECT_FALSE(project(camera, {0.1, 0.1, 0.0}));
  EXPECT_FALSE(project(camera, {0.1, 0.1, -1.0}));
  EXPECT_FALSE(project(camera, {0.1, 0.1, nan}));
  EXPECT_FALSE(project(camera, {nan, 0.1, 1.0}));
  EXPECT_FALSE(project(camera, {infinity, 0.1, 1.0}));
}

}  // namespace
}  // namespace gazed::geometry::camera_test
