// The sigmas of a camera that was calibrated on pictures of a chessboard: is the truth inside?
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <numbers>
#include <opencv2/core/types.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/calibration/board_fit.hpp"
#include "agent/lab/calibration/calibrated_settings.hpp"
#include "agent/lab/calibration/intrinsics.hpp"
#include "agent/settings/settings.hpp"

#include "rendered_board.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::lab::calibration::camera_sigma_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sigmas_of_the_bound = 2.0;
const Chessboard board{.columns = 9, .rows = 6, .square_m = 0.02};

/// Of calibrations that were answered, those with the truth inside two sigmas.
struct Score {
  int answered = 0, refused = 0;
  int focal_inside = 0, centre_inside = 0;

  void add(const Eigen::Vector4d& found, const Eigen::Vector4d& truth, double focal_sigma_px,
           double centre_sigma_px) {
    const Eigen::Vector4d off = (found - truth).cwiseAbs();
    ++answered;
    focal_inside += off.head<2>().maxCoeff() <= sigmas_of_the_bound * focal_sigma_px ? 1 : 0;
    centre_inside += off.tail<2>().maxCoeff() <= sigmas_of_the_bound * centre_sigma_px ? 1 : 0;
  }
  void expect_nine_of_ten_inside(const char* of) const {
    std::printf(
        "%s: %d answered, %d refused; inside two sigmas the focal length in %d, the centre in %d\n",
        of, answered, refused, focal_inside, centre_inside);
    EXPECT_GT(answered, 0);
    // Of 6 or 20, one more may be outside by chance; of one or two, none is.
    const int one_of_few = test::few_trials && answered >= 5 ? 1 : 0;
    EXPECT_GE(10 * (focal_inside + one_of_few), 9 * answered);
    EXPECT_GE(10 * (centre_inside + one_of_few), 9 * answered);
  }
};

Eigen::Vector4d four_numbers(const geometry::CameraModel& camera) {
  return {camera.focal_px.x(), camera.focal_px.y(), camera.centre_px.x(), camera.centre_px.y()};
}

/// What is written of `pictures` pictures at each tilt from 0 to 40 degrees.
Score rendered_sets(int sets, const geometry::CameraModel& truth, const Chessboard& shown,
                    PictureQuality quality, int pictures, std::uint64_t first_seed) {
  const BoardRenderer renderer(truth, shown, quality);
  Score score;
  for (int set = 0; set < sets; ++set) {
    const double tilt_rad = 40.0 * degree * (set + 0.5) / sets;  // of a single set 20 degrees
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(set);
    BoardPictures found{.corners = {}, .names = {}, .size = {640, 480}, .unused = {}};
    for (const BoardPose& pose : board_poses(pictures, tilt_rad, seed)) {
      auto corners = find_corners(renderer.picture(pose, 10 * seed + found.names.size()), shown);
      if (corners.empty()) continue;
      found.corners.push_back(std::move(corners));
      found.names.emplace_back("picture");
    }
    try {
      const settings::Settings told = calibrated_settings(
          settings::default_settings(), calibrated_intrinsics(shown, std::move(found)));
      score.add(four_numbers(told.rig.camera), four_numbers(truth),
                told.rig.uncertainty.focal_sigma_px, told.rig.uncertainty.centre_sigma_px);
    } catch (const std::invalid_argument&) {
      // Nearly parallel to the image they tell no focal length.
      EXPECT_LE(tilt_rad, 10.0 * degree) << set;
      ++score.refused;
    }
  }
  return score;
}

TEST(CameraSigma, HoldsTheTruthAtAnyTilt) {
  constexpr int sets = test::trials(100, 2);
  const Score score = rendered_sets(sets, rendered_camera(), board, {}, 6, 40);
  EXPECT_LE(score.refused, 15 * sets / 100 + 1);
  score.expect_nine_of_ten_inside("six boards");
}

TEST(CameraSigma, HoldsTheTruthOfAnotherLensBoardAndPicture) {
  constexpr int sets = test::trials(40, 1);
  geometry::CameraModel wide = rendered_camera();
  wide.focal_px = {420.0, 420.0};
  wide.centre_px = {311.0, 249.0};
  wide.distortion = {-0.25, 0.06, 0.0, 0.0, 0.0};
  rendered_sets(sets, wide, {.columns = 7, .rows = 5, .square_m = 0.025},
                {.blur_sigma_px = 1.4, .noise = 4.0}, 8, 1000)
      .expect_nine_of_ten_inside("a wide lens, a small board, blur");
}

std::vector<cv::Point3f> places_of(const Chessboard& shown) {
  std::vector<cv::Point3f> places;
  for (const Eigen::Vector3d& p : corner_places(shown))
    places.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  return places;
}

/// The corners as the camera has them, each with noise, those of a picture with a bend of
/// `together_px` in common, another one in each picture.
std::vector<std::vector<cv::Point2f>> drawn_corners(int pictures, double noise_px,
                                                    double together_px, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<> normal;
  const Eigen::Vector3d middle(0.5 * board.square_m * (board.columns - 1),
                               0.5 * board.square_m * (board.rows - 1), 0.0);
  std::vector<std::vector<cv::Point2f>> all;
  for (const BoardPose& pose : board_poses(pictures, 40.0 * degree, seed)) {
    const double angle_rad = pose.turn_rad.norm();
    const Eigen::AngleAxisd turn(angle_rad, pose.turn_rad.normalized());
    Eigen::Matrix2d bend;
    for (double& number : bend.reshaped()) number = together_px * normal(random);
    auto& corners = all.emplace_back();
    for (const Eigen::Vector3d& place : corner_places(board)) {
      const Eigen::Vector2d at = (place - middle).head<2>() / middle.x();  // -1 to 1
      const auto pixel =
          geometry::project(rendered_camera(), turn * (place - middle) + pose.middle_m);
      const Eigen::Vector2d off =
          bend * at.cwiseAbs2() + noise_px * Eigen::Vector2d(normal(random), normal(random));
      corners.emplace_back(static_cast<float>(pixel->x() + off.x()),
                           static_cast<float>(pixel->y() + off.y()));
    }
  }
  return all;
}

Score drawn_sets(double noise_px, double together_px) {
  constexpr int sets = test::trials(200, 20);
  const auto places = places_of(board);
  Score score;
  for (int set = 0; set < sets; ++set) {
    const BoardFit fit = fit_boards(
        places, drawn_corners(8, noise_px, together_px, 300 + static_cast<std::uint64_t>(set)),
        {640, 480});
    score.add(fit.camera.head<4>(), four_numbers(rendered_camera()), fit.sigma.head<2>().maxCoeff(),
              fit.sigma.segment<2>(2).maxCoeff());
  }
  return score;
}

TEST(CameraSigma, HoldsTheTruthWhereCornersErrIndependently) {
  drawn_sets(0.1, 0.0).expect_nine_of_ten_inside("independent corners");
}

TEST(CameraSigma, HoldsTheTruthWhereThoseOfAPictureErrTogether) {
  drawn_sets(0.1, 0.3).expect_nine_of_ten_inside("corners that err together");
}

// Half of a real set does not know of the other half. A sigma that counts each corner for itself is
// too small by a factor of 1.5 in the focal length, 3.0 in the centre.
TEST(CameraSigma, HalvesOfARealSetAgree) {
  const std::filesystem::path folder = std::filesystem::path(GAZED_SHARED) / "data/opencv_calib";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::vector<std::vector<cv::Point2f>> pictures;
  for (int i = 1; i <= 14; ++i) {
    const std::string name = "left" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".jpg";
    if (!std::filesystem::exists(folder / name)) continue;  // there is no tenth
    const cv::Mat grey = cv::imread((folder / name).string(), cv::IMREAD_GRAYSCALE);
    auto& corners = pictures.emplace_back();
    for (const geometry::Pixel& p : find_corners(grey, board))
      corners.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  ASSERT_EQ(pictures.size(), 13U);
  const auto places = places_of(board);
  const auto middle = pictures.begin() + 6;
  std::mt19937_64 random(1);
  Score score;
  constexpr int splits = test::trials(60, 6);
  for (int split = 0; split < splits; ++split) {
    std::ranges::shuffle(pictures, random);
    const BoardFit a = fit_boards(places, std::vector(pictures.begin(), middle), {640, 480});
    const BoardFit b = fit_boards(places, std::vector(middle, pictures.end()), {640, 480});
    const CameraNumbers sigma = (a.sigma.cwiseAbs2() + b.sigma.cwiseAbs2()).cwiseSqrt();
    score.add(a.camera.head<4>(), b.camera.head<4>(), sigma.head<2>().maxCoeff(),
              sigma.segment<2>(2).maxCoeff());
  }
  score.expect_nine_of_ten_inside("halves of OpenCV's left pictures");
}

}  // namespace
}  // namespace gazed::lab::calibration::camera_sigma_test
