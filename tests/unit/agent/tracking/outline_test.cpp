#include "agent/tracking/outline.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <span>

#include "agent/base/image.hpp"

namespace gazed::tracking::outline_test {
namespace {

/// A red disc on a grey wall.
base::Image disc(const geometry::Pixel& centre, double radius_px) {
  base::Image image(640, 480, base::PixelFormat::rgb24);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const bool inside = (geometry::Pixel(x, y) - centre).norm() <= radius_px;
      std::uint8_t* pixel = image.row(y) + 3 * x;
      pixel[0] = 190;
      pixel[1] = pixel[2] = inside ? 30 : 190;
    }
  }
  return image;
}

TEST(Outline, GoesAroundADiscOnce) {
  const geometry::Pixel centre(300.3, 250.8);
  for (const double radius_px : {6.0, 15.0, 40.0, 120.0}) {
    const base::Image image = disc(centre, radius_px);
    ObjectMask object;
    ASSERT_TRUE(object.segment(image.view(), centre));
    const Outline outline = outline_of(object, centre, 2.0 * radius_px + 8.0);
    ASSERT_EQ(outline.count, Outline::points_max);
    double turned = 0.0;
    for (std::size_t i = 0; i < outline.count; ++i) {
      const Eigen::Vector2d from = outline.points_px[i].cast<double>() - centre;
      const Eigen::Vector2d to = outline.points_px[(i + 1) % outline.count].cast<double>() - centre;
      EXPECT_NEAR(from.norm(), radius_px, 1.5 * object.cell_px());
      turned += std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    }
    EXPECT_NEAR(turned, 2.0 * std::acos(-1.0), 1e-6);
  }
}

// Half of it lies outside the frame.
TEST(Outline, EndsAtTheFrame) {
  const geometry::Pixel centre(2.0, 240.0);
  const base::Image image = disc(centre, 40.0);
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), geometry::Pixel(15.0, 240.0)));
  const Outline outline = outline_of(object, geometry::Pixel(15.0, 240.0), 100.0);
  ASSERT_GT(outline.count, 0U);
  for (const Eigen::Vector2f& point : std::span(outline.points_px).first(outline.count))
    EXPECT_GE(point.x(), -0.5F * static_cast<float>(object.cell_px()));
}

}  // namespace
}  // namespace gazed::tracking::outline_test
