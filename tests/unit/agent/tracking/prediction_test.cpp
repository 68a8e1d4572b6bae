#include "agent/tracking/prediction.hpp"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::tracking::prediction_test {
namespace {

constexpr double inverse_depth_max_per_m = 5.0;

struct PredictionTest : testing::Test {
  geometry::RobotProfile robot = *geometry::robot_profile("nao-v6");
  geometry::Pose motion = geometry::cam2_from_cam1(robot.head, {-0.1, 0.05}, {0.15, 0.25});
  Eigen::Vector2d seen_1{-0.2, 0.1};

  [[nodiscard]] geometry::Pixel seen_2(const Eigen::Vector2d& normalised,
                                       double inverse_depth) const {
    return geometry::project(robot.camera, motion.rotation * normalised.homogeneous() +
                                               inverse_depth * motion.translation)
        .value();
  }
};

TEST_F(PredictionTest, FromInfinityToTheNearest) {
  const auto prediction =
      Prediction::make(robot.camera, motion, seen_1, inverse_depth_max_per_m, 0.0);
  ASSERT_TRUE(prediction);
  EXPECT_LT((prediction->far_px() - seen_2(seen_1, 0.0)).norm(), 1e-9);
  const geometry::Pixel near_px = prediction->far_px() + prediction->span_px();
  EXPECT_LT((near_px - seen_2(seen_1, inverse_depth_max_per_m)).norm(), 1e-9);
}

TEST_F(PredictionTest, InverseDepthOfAPlaceOnTheLine) {
  const auto prediction =
      Prediction::make(robot.camera, motion, seen_1, inverse_depth_max_per_m, 0.0);
  ASSERT_TRUE(prediction);
  for (const double inverse_depth : {0.0, 0.3, 1.0, 3.3, 5.0}) {
    const Eigen::Vector2d along = seen_2(seen_1, inverse_depth) - prediction->far_px();
    const double share = along.dot(prediction->span_px()) / prediction->span_px().squaredNorm();
    EXPECT_NEAR(prediction->inverse_depth_at(share), inverse_depth, 1e-9);
  }
  // Beside the line's ends.
  EXPECT_EQ(prediction->inverse_depth_at(-0.2), 0.0);
  EXPECT_NEAR(prediction->inverse_depth_at(1.3), inverse_depth_max_per_m, 1e-12);
}

TEST_F(PredictionTest, OutOfView) {
  const geometry::Pose turned = geometry::cam2_from_cam1(robot.head, {0.0, 0.0}, {1.5, 0.0});
  EXPECT_FALSE(Prediction::make(robot.camera, turned, seen_1, inverse_depth_max_per_m, 60.0));
  const geometry::Pose behind = geometry::cam2_from_cam1(robot.head, {-2.0, 0.0}, {1.1, 0.0});
  EXPECT_FALSE(Prediction::make(robot.camera, behind, seen_1, inverse_depth_max_per_m, 60.0));
}

TEST_F(PredictionTest, NearEndStaysInView) {
  // Seen near the border that near points move towards.
  const geometry::Pose sideways = geometry::cam2_from_cam1(robot.head, {0.0, 0.0}, {0.3, 0.1});
  const Eigen::Vector2d at(0.18, 0.0);
  const auto prediction =
      Prediction::make(robot.camera, sideways, at, inverse_depth_max_per_m, 10.0);
  ASSERT_TRUE(prediction);
  EXPECT_TRUE(robot.camera.contains(prediction->far_px() + prediction->span_px(), -10.0));
}

TEST_F(PredictionTest, ShapeIsTheDerivative) {
  constexpr double step_px = 1e-4, tolerance = 1e-5;
  robot.camera.distortion = {-0.2, 0.05, 1e-3, -2e-3, 0.0};
  for (const double inverse_depth : {0.0, 2.0}) {
    const Eigen::Matrix2d shape = pixel_2_by_pixel_1(robot.camera, motion, seen_1, inverse_depth);
    const geometry::Pixel pixel_1 = geometry::pixel_of(robot.camera, seen_1);
    for (int k = 0; k < 2; ++k) {
      const geometry::Pixel beside = pixel_1 + step_px * geometry::Pixel::Unit(k);
      const geometry::Pixel change =
          seen_2(geometry::normalise(robot.camera, beside).value(), inverse_depth) -
          seen_2(seen_1, inverse_depth);
      EXPECT_LT((change / step_px - shape.col(k)).norm(), tolerance);
    }
  }
}

}  // namespace
}  // namespace gazed::tracking::prediction_test
