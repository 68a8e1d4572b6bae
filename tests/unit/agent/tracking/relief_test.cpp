#include "agent/tracking/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

#include "agent/base/image.hpp"

namespace gazed::tracking::relief_test {
namespace {

constexpr double focal_px = 600.0, radius_m = 0.03, distance_m = 0.3;

// The inverse depth of a ball's surface by that of its centre, along rays through the disc that it
// is seen as.
TEST(Relief, IsThatOfABallsSurface) {
  const geometry::Pixel centre(320.0, 240.0);
  const double sine = radius_m / distance_m;
  const double outline_px = focal_px * sine / std::sqrt(1.0 - sine * sine);
  base::Image image(640, 480, base::PixelFormat::grey);
  std::ranges::fill(image.pixels(), std::uint8_t{200});
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      if ((geometry::Pixel(x, y) - centre).norm() < outline_px) image.row(y)[x] = 40;
    }
  }
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), centre));
  geometry::CameraModel camera;
  camera.focal_px = {focal_px, focal_px};
  camera.centre_px = centre;
  const Relief dut(object, camera);
  EXPECT_TRUE(dut.is_round());
  EXPECT_NEAR(dut.radius_rad(), sine, 0.03 * sine);
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    const double off = share * outline_px / focal_px, cosine = 1.0 / std::hypot(1.0, off);
    const double ray_m =
        distance_m * cosine -
        std::sqrt(radius_m * radius_m - distance_m * distance_m * (1.0 - cosine * cosine));
    const double stands_out = distance_m / (ray_m * cosine) - 1.0;
    const geometry::Pixel at = centre + geometry::Pixel(share * outline_px, 0.0);
    EXPECT_NEAR(dut.radius_rad() * dut.at(at), stands_out, 0.06 * sine) << share;
  }
  EXPECT_EQ(dut.at(centre + geometry::Pixel(0.0, 1.2 * outline_px)), 0.0);
}

TEST(Relief, OfNoObjectIsNone) {
  EXPECT_EQ(Relief().at({320.0, 240.0}), 0.0);
}

}  // namespace
}  // namespace gazed::tracking::relief_test
