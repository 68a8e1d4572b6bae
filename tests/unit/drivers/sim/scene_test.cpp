#include "drivers/sim/scene.hpp"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/random.hpp"

#include "complaint.hpp"
#include "picture.hpp"

namespace gazed::sim::scene_test {
namespace {

using ::testing::HasSubstr;

TEST(Scene, TheDefaultIsTheReportsSetUp) {
  const Scene scene = parse_scene(default_scene_toml(), "built-in");
  EXPECT_TRUE(scene.repeat);
  ASSERT_EQ(scene.tests.size(), 2U);
  EXPECT_EQ(scene.tests[0].placement, Placement::image_centre);
  EXPECT_EQ(scene.tests[1].placement, Placement::image_corner);
  EXPECT_EQ(scene.tests[0].range_m, 0.30);
  EXPECT_EQ(scene.joints.encoder_step_rad, 0.00153);
  EXPECT_EQ(scene.joints.encoder_noise_rad, 0.0005);
  EXPECT_EQ(scene.joints.settling_error_rad, 0.02);
  EXPECT_EQ(scene.camera.pixel_noise, 2.0);
  EXPECT_EQ(scene.uncertainty.focal_sigma_px, 0.5);
  EXPECT_EQ(scene.uncertainty.centre_sigma_px, 1.0);
  EXPECT_EQ(scene.uncertainty.mount_offset_sigma_m, 0.001);
  EXPECT_EQ(scene.uncertainty.mount_rotation_sigma_rad, 0.003);
  EXPECT_EQ(scene.uncertainty.zero_sigma_rad, 0.003);
  EXPECT_FALSE(scene.uncertainty.encoder_sigma_rad);
  EXPECT_FALSE(scene.robot.focal_px);
}

TEST(Scene, AnEmptyFileIsAnEmptyRoomWithAPerfectRobot) {
  const Scene scene = parse_scene("", "empty.toml");
  EXPECT_TRUE(scene.tests.empty());
  EXPECT_EQ(scene.joints.settling_error_rad, 0.0);
  EXPECT_EQ(scene.camera.pixel_noise, 0.0);
}

TEST(Scene, ReadsEveryTable) {
  const Scene scene = parse_scene(R"(
repeat = false
[robot]
focal_px = [600, 601.5]
centre_px = [320, 240]
distortion = [-0.05, 0.07, -0.002, -0.001, 0]
neck_offset_m = [0, 0, 0.12]
mount_offset_m = [0.05, 0.001, 0.06]
mount_rotation_rad = [0.03, -0.07, 0]
zero_rad = [0.01, 0.02]
[joints]
max_speed_rad_s = [4, 3]
acceleration_rad_s2 = 10
settle_time_constant_s = 0.05
settling_error_rad = 0.01
encoder_step_rad = 0.001
encoder_noise_rad = 0.002
encoder_sigma_rad = 0.003
backlash_rad = 0.004
velocity_noise_rad_s = 0.006
[camera]
width_px = 320
height_px = 240
fps = 15
format = "yuyv"
pixel_noise = 1
blur_sigma_px = 0.7
exposure = 0.9
exposure_swing = 0.2
exposure_period_s = 4
readout_s = 0.037
delay_s = -0.039
drop_rate = 0.1
[room]
background = [1, 2, 3]
[uncertainty]
pixel_sigma_px = 0.3
encoder_sigma_rad = 0.02
[object]
size_m = [0.1, 0.2]
[[plane]]
centre_m = [1, 0, 0]
texture = { pattern = "checker", colour = [9, 9, 9], colour_2 = [5, 5, 5], cell_m = 0.2 }
[[target]]
centre_m = [1, 0, 0]
up = [0, 1, 0]
velocity_m_s = [0, 0.1, 0]
moving_s = [1, 2.5]
shape = "disc"
mark = "ring"
[[report_test]]
number = 2
range_m = 0.5
object = { size_m = [0.05, 0.05] }
[[target_test]]
pixel = [10, 20]
range_m = 1
wall = false
velocity_m_s = [0.01, 0, 0]
)",
                                  "all.toml");
  EXPECT_FALSE(scene.repeat);
  EXPECT_EQ((*scene.robot.focal_px)[1], 601.5);
  EXPECT_EQ((*scene.robot.zero_rad)[1], 0.02);
  EXPECT_EQ((*scene.joints.max_speed_rad_s)[0], 4.0);
  EXPECT_EQ(scene.joints.backlash_rad, 0.004);
  EXPECT_EQ(scene.camera.width_px, 320);
  EXPECT_EQ(scene.camera.format, base::PixelFormat::yuyv);
  EXPECT_EQ(scene.camera.delay_s, -0.039);
  EXPECT_EQ(scene.camera.exposure_swing, 0.2);
  EXPECT_EQ(scene.camera.exposure_period_s, 4.0);
  EXPECT_EQ(scene.uncertainty.encoder_sigma_rad, 0.02);
  ASSERT_EQ(scene.planes.size(), 2U);
  EXPECT_EQ(scene.planes[0].appearance.texture.pattern, Pattern::checker);
  EXPECT_TRUE(scene.planes[1].target);
  EXPECT_EQ(scene.planes[1].appearance.mark, Mark::ring);
  EXPECT_FALSE(scene.planes[0].motion.moves());
  EXPECT_EQ(scene.planes[1].motion.velocity_m_s, Eigen::Vector3d(0.0, 0.1, 0.0));
  EXPECT_EQ(scene.planes[1].motion.moving_s, (std::array<double, 2>{1.0, 2.5}));
  ASSERT_EQ(scene.tests.size(), 2U);
  EXPECT_EQ(scene.tests[0].object.size_m[0], 0.05);
  EXPECT_EQ(scene.tests[1].object.size_m[1], 0.2);
  EXPECT_EQ(scene.tests[1].pixel, geometry::Pixel(10, 20));
  EXPECT_FALSE(scene.tests[1].wall);
  EXPECT_EQ(scene.tests[1].motion.velocity_m_s, Eigen::Vector3d(0.01, 0.0, 0.0));
}

TEST(Scene, ComplaintsNameFileLineKeyValueAndWhatIsAllowed) {
  EXPECT_EQ(complaint("\n[joints]\nbacklash_rad = 3\n"),
            "room.toml:3: joints.backlash_rad: 3 found; allowed: a number, 0 to 0.2\n"
            "   3:16 | backlash_rad = 3\n"
            "        |                ^");
  EXPECT_THAT(complaint("[joints]\nbacklsh_rad = 0.1\n"),
              HasSubstr("room.toml:2: joints.backlsh_rad: unknown key; the nearest known is "
                        "backlash_rad; allowed: max_speed"));
  EXPECT_THAT(complaint("[jonts]\n"),
              HasSubstr("room.toml:1: jonts: unknown key; the nearest known is joints"));
  EXPECT_THAT(complaint("[camera]\nfps = \"fast\"\n"),
              HasSubstr("camera.fps: 'fast' found; allowed: a number"));
  EXPECT_THAT(complaint("[camera]\nfps = nan\n"), HasSubstr("camera.fps: nan found"));
  EXPECT_THAT(complaint("[camera]\nwidth_px = 640.5\n"),
              HasSubstr("camera.width_px: 640.5 found; allowed: an integer, 16 to 4096"));
  EXPECT_THAT(complaint("[camera]\nformat = \"grey\"\n"),
              HasSubstr("camera.format: 'grey' found; allowed: \"rgb\", \"yuyv\""));
  EXPECT_THAT(complaint("[robot]\nfocal_px = [600]\n"),
              HasSubstr("robot.focal_px: [ 600 ] found; allowed: an array of 2 numbers"));
  EXPECT_THAT(complaint("[robot]\nfocal_px = [600, inf]\n"), HasSubstr("robot.focal_px"));
  EXPECT_THAT(complaint("robot = 1\n"), HasSubstr("robot: 1 found; allowed: a table"));
  EXPECT_THAT(complaint("repeat = 1\n"), HasSubstr("repeat: 1 found; allowed: true or false"));
  EXPECT_THAT(complaint("[report_test]\nnumber = 1\n"),
              HasSubstr("allowed: an array of tables, [[report_test]]"));
  EXPECT_THAT(complaint("[[report_test]]\n"),
              HasSubstr("room.toml:1: report_test.number: nothing found; allowed: 1 or 2"));
  EXPECT_THAT(complaint("[[report_test]]\nnumber = 3\n"), HasSubstr("report_test.number: 3 found"));
  EXPECT_THAT(complaint("[[plane]]\n"), HasSubstr("plane.centre_m: nothing found"));
  EXPECT_THAT(complaint("[[plane]]\ncentre_m = [0, 0, 0]\nnormal = [0, 0, 0]\n"),
              HasSubstr("plane.normal: [ 0, 0, 0 ] found; allowed: a direction, not 0"));
  EXPECT_THAT(complaint("[[plane]]\ncentre_m = [0, 0, 0]\nmoving_s = [2, 1]\n"),
              HasSubstr("plane.moving_s: [ 2, 1 ] found; allowed: [from, to], the second not"));
  EXPECT_THAT(complaint("[[report_test]]\nnumber = 1\nvelocity_m_s = [0, 11, 0]\n"),
              HasSubstr("report_test.velocity_m_s"));
  EXPECT_THAT(complaint("[camera]\nexposure_swing = 1\n"),
              HasSubstr("camera.exposure_swing: 1 found; allowed: a number, 0 to 0.9"));
  EXPECT_THAT(complaint("[camera]\nexposure_period_s = 0\n"),
              HasSubstr("camera.exposure_period_s: 0 found"));
  EXPECT_THAT(complaint("[[target_test]]\nrange_m = 1\n"), HasSubstr("target_test.pixel: nothing"));
  EXPECT_THAT(complaint("[[target_test]]\npixel = [1, 1]\n"), HasSubstr("target_test.range_m"));
  EXPECT_THAT(complaint("[wall]\ntexture = { pattern = \"image\" }\n"),
              HasSubstr("wall.texture.file: nothing found"));
  EXPECT_THAT(complaint("[wall]\ntexture = { file = \"none.ppm\" }\n"),
              HasSubstr("none.ppm: cannot be read: No such file or directory"));
  EXPECT_THAT(complaint("[camera]\nformat = \"yuyv\"\nwidth_px = 321\n"),
              HasSubstr("camera.width_px: 321 found; allowed: an even width"));
  EXPECT_THAT(complaint("repeat = tru\n"), HasSubstr("room.toml:1: "));
}

TEST(Scene, AllThatIsWrongIsSaidInTheOrderOfTheFile) {
  EXPECT_EQ(complaint("[wall]\n"
                      "texture = { pattern = \"brick\", file = \"none.ppm\" }\n"
                      "[camera]\n"
                      "fps = 0\n"
                      "[[target_test]]  # nothing says where\n"
                      "wal = true\n"
                      "[[target_test]]\n"
                      "pixel = [1, 2, 3]\n"
                      "range_m = 1\n"),
            "room.toml:2: wall.texture.pattern: 'brick' found; allowed: \"solid\", \"checker\", "
            "\"noise\", \"natural\", \"leaves\", \"collage\", \"image\"\n"
            "   2:23 | texture = { pattern = \"brick\", file = \"none.ppm\" }\n"
            "        |                       ^^^^^^^\n"
            "room.toml:2: wall.texture.file: none.ppm: cannot be read: No such file or "
            "directory\n"
            "   2:39 | texture = { pattern = \"brick\", file = \"none.ppm\" }\n"
            "        |                                       ^^^^^^^^^^\n"
            "room.toml:4: camera.fps: 0 found; allowed: a number, 0.1 to 200\n"
            "    4:7 | fps = 0\n"
            "        |       ^\n"
            "room.toml:5: target_test.pixel: nothing found; allowed: either pixel and range_m, or "
            "position_m\n"
            "    5:1 | [[target_test]]  # nothing says where\n"
            "        | ^^^^^^^^^^^^^^^\n"
            "room.toml:6: target_test.wal: unknown key; the nearest known is wall; allowed: pixel, "
            "position_m, range_m, wall, wall_gap_m, velocity_m_s, moving_s, object\n"
            "    6:1 | wal = true\n"
            "        | ^^^\n"
            "room.toml:8: target_test.pixel: [ 1, 2, 3 ] found; allowed: an array of 2 numbers, "
            "-10000 to 10000\n"
            "    8:9 | pixel = [1, 2, 3]\n"
            "        |         ^^^^^^^^^");
}

TEST(Scene, TheHardOneHasEveryDifficultySwitchedOn) {
  const Scene scene = load_scene(GAZED_TEST_DATA "/scenes/hard.toml");
  EXPECT_EQ(scene.joints.settling_error_rad, 0.02);
  EXPECT_EQ(scene.joints.encoder_step_rad, 0.00153);
  EXPECT_GT(scene.joints.encoder_noise_rad, 0.0);
  EXPECT_GT(scene.joints.backlash_rad, 0.0);
  EXPECT_TRUE(scene.robot.zero_rad && scene.robot.focal_px && scene.robot.centre_px);
  EXPECT_TRUE(scene.robot.mount_offset_m && scene.robot.mount_rotation_rad);
  EXPECT_TRUE(scene.robot.distortion);
  EXPECT_EQ(scene.camera.readout_s, 0.037);
  EXPECT_NE(scene.camera.delay_s, 0.0);
  EXPECT_GT(scene.camera.exposure_swing, 0.0);
  EXPECT_EQ(scene.wall.texture.pattern, Pattern::leaves);
  int distractors = 0, things_that_stand_out = 0;
  for (const PlacedPlane& plane : scene.planes)
    ++(plane.target ? things_that_stand_out : distractors);
  EXPECT_GE(distractors, 2);
  EXPECT_EQ(things_that_stand_out, 1);
  ASSERT_EQ(scene.tests.size(), 2U);  // the report's
  EXPECT_EQ(scene.tests[0].placement, Placement::image_centre);
  EXPECT_EQ(scene.tests[1].placement, Placement::image_corner);
  for (const SceneTest& test : scene.tests) {
    EXPECT_EQ(test.range_m, 0.30);
    EXPECT_TRUE(test.motion.moves());
  }
}

TEST(Scene, PicturesAreLookedForBesideTheFile) {
  const testing::TemporaryFile picture("beside.ppm", std::string("P6 1 1 255 \x01\x02\x03"));
  const std::string name = picture.path().substr(picture.path().rfind('/') + 1);
  const testing::TemporaryFile file(
      "scene.toml", "[wall]\ntexture = { pattern = \"image\", file = \"" + name + "\" }\n");
  EXPECT_TRUE(load_scene(file.path()).wall.texture.image);
}

TEST(Scene, FilesThatCannotBeRead) {
  for (const char* path : {"/nonexistent.toml", "/", "/dev/zero", ""})
    EXPECT_THROW((void)load_scene(path), std::invalid_argument) << path;
}

TEST(Scene, AnyTextIsAnswered) {
  base::Random random(3, 1);
  const std::string_view letters = "[]{}=.,\"'#\n\r\t _-+0123456789eEinfatruls\\x\xc3\xa9";
  const std::vector<std::string> words{"[[plane]]\n", "[camera]\n", "[robot]\n", "= [",
                                       "nan",         "1e999",      "\"\"\"",    "texture = {",
                                       "repeat",      "a.b.c.",     "\xc3\xa9",  "\xe2\x80\x8b",
                                       "\"\"\"\\\n",  "1979-05-27", "0x",        "[[target]]\n"};
  for (int i = 0; i < 20000; ++i) {
    std::string text(i % 2 == 0 ? default_scene_toml() : std::string_view());
    for (std::uint64_t change = random.bits() % 20; change > 0; --change) {
      const std::size_t place = text.empty() ? 0 : random.bits() % text.size();
      switch (random.bits() % 4) {
        case 0:
          text.insert(place, 1, letters[random.bits() % letters.size()]);
          break;
        case 1:
          text.insert(place, words[random.bits() % words.size()]);
          break;
        case 2:
          text.erase(place, random.bits() % 8);
          break;
        default:
          if (!text.empty()) text[place] = static_cast<char>(random.bits() & 0xFFU);
      }
    }
    try {
      (void)parse_scene(text, "fuzz.toml");
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("fuzz.toml")) << text;
    }
  }
}

TEST(Scene, DeepNestingAndLongTexts) {
  EXPECT_THAT(complaint("a = " + std::string(100'000, '[')), HasSubstr("room.toml"));
  std::string dotted = "a";
  for (int i = 0; i < 100'000; ++i) dotted += ".a";
  EXPECT_THAT(complaint(dotted + " = 1\n"),
              HasSubstr("room.toml:1: not TOML: too many dotted names"));
  EXPECT_THAT(complaint(std::string((1U << 20U) + 1U, '\n')), HasSubstr("longer than 1048576"));
}

}  // namespace
}  // namespace gazed::sim::scene_test
