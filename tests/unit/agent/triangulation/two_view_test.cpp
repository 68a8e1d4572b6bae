#include "agent/triangulation/two_view.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <set>
#include <string_view>

#include "golden.hpp"

namespace gazed::triangulation::two_view_test {
namespace {

TEST(Status, NamesAreThoseOfTheMessages) {
  EXPECT_EQ(name(Status::located), "LOCATED");
  EXPECT_EQ(name(Status::target_lost), "TARGET_LOST");
  EXPECT_EQ(name(Status::degenerate), "DEGENERATE");
  EXPECT_EQ(name(Status::behind_camera), "BEHIND_CAMERA");
  EXPECT_EQ(name(Status::uncertain), "UNCERTAIN");
  EXPECT_EQ(name(Status::invalid_input), "INVALID_INPUT");
}

TEST(Status, EveryNumberHasItsOwnName) {
  std::set<std::string_view> names;
  for (int i = 0; i < status_count; ++i) names.insert(name(static_cast<Status>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(status_count));
}

TEST(ImagePoint, UndoesDistortion) {
  geometry::CameraModel camera = golden_camera();
  camera.distortion = {-0.2, 0.05, 0.001, -0.002, 0.0};
  const Eigen::Vector2d normalised(0.21, -0.13);
  const auto point =
      image_point(camera, geometry::pixel_of(camera, normalised), Eigen::Matrix2d::Identity());
  ASSERT_TRUE(point);
  constexpr double tolerance = 1e-12;  // of undoing the distortion
  EXPECT_LT((point->normalised - normalised).norm(), tolerance);
  EXPECT_GT((point->distorted - normalised).norm(), 1e-3);
}

TEST(ImagePoint, NoneWhereThereIsNoRay) {
  const geometry::Pixel nowhere(not_a_number, 100.0);
  EXPECT_FALSE(image_point(golden_camera(), nowhere, Eigen::Matrix2d::Identity()));
}

}  // namespace
}  // namespace gazed::triangulation::two_view_test
