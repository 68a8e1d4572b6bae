// The keys of what real robots, rooms and things have.
#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "drivers/sim/scene.hpp"

#include "complaint.hpp"

namespace gazed::sim::scene_real_test {
namespace {

using ::testing::HasSubstr;

TEST(RealScene, ReadsEveryKey) {
  const Scene scene = parse_scene(R"(
[joints]
velocity = "none"
drift_rad_s = 0.08
[sway]
translation_m = 0.002
rotation_rad = 0.005
frequency_hz = 0.4
[camera]
format = "yuyv"
exposure_step = 0.3
jpeg_quality = 60
[room]
lamp_m = [1, 2, 3]
[object]
shape = "ball"
size_m = [0.1, 0.1]
shading = 0.7
gloss = 0.6
shininess = 100
[[plane]]
centre_m = [1, 0, 0]
shape = "box"
size_m = [0.1, 0.2]
depth_m = 0.3
[[report_test]]
number = 1
)",
                                  "real.toml");
  EXPECT_EQ(scene.joints.velocity, Velocity::none);
  EXPECT_EQ(scene.joints.drift_rad_s, 0.08);
  EXPECT_EQ(scene.sway.translation_m, 0.002);
  EXPECT_EQ(scene.sway.rotation_rad, 0.005);
  EXPECT_EQ(scene.sway.frequency_hz, 0.4);
  EXPECT_EQ(scene.camera.exposure_step, 0.3);
  EXPECT_EQ(scene.camera.jpeg_quality, 60);
  EXPECT_EQ(scene.room.lamp_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.tests[0].object.shape, Shape::ball);
  EXPECT_EQ(scene.tests[0].object.finish.shading, 0.7);
  EXPECT_EQ(scene.tests[0].object.finish.gloss, 0.6);
  EXPECT_EQ(scene.tests[0].object.finish.shininess, 100);
  EXPECT_EQ(scene.planes[0].appearance.shape, Shape::box);
  EXPECT_EQ(scene.planes[0].appearance.depth_m, 0.3);
}

TEST(RealScene, RefusesWhatIsOutOfRange) {
  EXPECT_THAT(complaint("[joints]\nvelocity = \"guessed\"\n"), HasSubstr("joints.velocity"));
  EXPECT_THAT(complaint("[joints]\ndrift_rad_s = -1\n"), HasSubstr("joints.drift_rad_s"));
  EXPECT_THAT(complaint("[sway]\nrotation_rad = 1\n"), HasSubstr("sway.rotation_rad"));
  EXPECT_THAT(complaint("[sway]\nfrequency_hz = 0\n"), HasSubstr("sway.frequency_hz"));
  EXPECT_THAT(complaint("[sway]\nfrequency = 1\n"), HasSubstr("unknown key"));
  EXPECT_THAT(complaint("[camera]\nexposure_step = 1\n"), HasSubstr("camera.exposure_step"));
  EXPECT_THAT(complaint("[camera]\njpeg_quality = 60\n"), HasSubstr("camera.jpeg_quality"));
  EXPECT_THAT(complaint("[camera]\nformat = \"yuyv\"\njpeg_quality = 101\n"),
              HasSubstr("camera.jpeg_quality"));
  EXPECT_THAT(complaint("[object]\nshape = \"ball\"\nsize_m = [0.1, 0.2]\n"),
              HasSubstr("object.size_m"));
  EXPECT_THAT(complaint("[object]\nshape = \"ball\"\nmark = \"ring\"\n"), HasSubstr("object.mark"));
  EXPECT_THAT(complaint("[object]\ngloss = 2\n"), HasSubstr("object.gloss"));
}

}  // namespace
}  // namespace gazed::sim::scene_real_test
