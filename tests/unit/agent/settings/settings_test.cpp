#include "agent/settings/settings.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "tests/unit/agent/settings/settings_file.hpp"

namespace gazed::settings::settings_test {
namespace {

// The defaults that users and other programs rely on.

TEST(Settings, DefaultsAreTheSimulatedV6) {
  const Settings settings = load_settings({}, nothing_stated);
  EXPECT_EQ(settings.robot, "nao-v6");
  EXPECT_EQ(settings.camera.source.text(), "sim");
  EXPECT_EQ(settings.head.source.text(), "sim");
  EXPECT_EQ(settings.rig.camera.width_px, 640);
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(608, 608));
  EXPECT_EQ(settings.rig.head.mount_offset_m, Eigen::Vector3d(0.05871, 0, 0.06364));
  EXPECT_EQ(settings.rig.uncertainty.focal_sigma_px, 10.0);
  EXPECT_EQ(settings.cycle.saliency.profile, saliency::SaliencyProfile::surround);
  EXPECT_EQ(settings.cycle.locate.method, cycle::LocateMethod::all_looks);
  EXPECT_EQ(settings.cycle.locate.looks, 6);
  EXPECT_EQ(settings.cycle.locate.looks_min, 3);
  EXPECT_EQ(settings.cycle.locate.relative_sigma_goal, 0.03);
  EXPECT_EQ(settings.cycle.locate.plan, gaze::Plan::parallax);
  EXPECT_DOUBLE_EQ(settings.cycle.motion.move_margin_rad, 0.045);
  EXPECT_EQ(settings.cycle.locate.gate.relative_sigma_max, 0.15);
  EXPECT_EQ(settings.lcm.url, "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(settings.lcm.prefix, "GAZED");
  EXPECT_EQ(settings.run.fixations, 0);
  EXPECT_EQ(settings.run.print, PrintFormat::text);
  EXPECT_EQ(settings.sim.seed, 1U);
}

TEST(Settings, EveryRobotAndPositionLoads) {
  for (const std::string_view robot : geometry::robot_names) {
    for (const std::string position : {"top", "bottom"}) {
      const Settings settings = load_text("robot = \"" + std::string(robot) +
                                          "\"\n[camera]\nposition = \"" + position + "\"\n");
      const geometry::RobotProfile profile =
          *geometry::robot_profile(robot, settings.camera.position);
      EXPECT_EQ(settings.robot, robot);
      EXPECT_EQ(settings.camera.position == geometry::CameraPosition::bottom, position == "bottom");
      EXPECT_EQ(settings.rig.camera.focal_px, profile.rig.camera.focal_px);
      EXPECT_EQ(settings.cycle.camera.delay_s, profile.delay_s);
      EXPECT_EQ(settings.rig.head.mount_offset_m, profile.rig.head.mount_offset_m);
      EXPECT_EQ(settings.rig.uncertainty.centre_sigma_px, profile.rig.uncertainty.centre_sigma_px);
    }
  }
}

TEST(Settings, UnknownRobotHasNoDefaults) {
  EXPECT_THROW(static_cast<void>(default_settings("nao-v2")), SettingsError);
}

TEST(Settings, IntegersDoForNumbers) {
  const Settings settings = load_text("[camera]\nfocal_px = [600, 601.5]\ntimeout_s = 1\n");
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(600, 601.5));
  EXPECT_EQ(settings.cycle.camera.timeout_s, 1.0);
}

TEST(Settings, AProfileSetsTheControlsThatItsNumbersNeed) {
  using enum geometry::CameraPosition;
  const auto controls = [](std::string_view robot, geometry::CameraPosition position) {
    return default_settings(robot, position).camera.controls;
  };
  EXPECT_EQ(controls("nao-v6", top).auto_focus, false);
  EXPECT_EQ(controls("nao-v6", bottom).focus, 0);
  for (const std::string_view robot : {"nao-v4", "nao-v5", "nao-v6"}) {
    EXPECT_EQ(controls(robot, top).flip_horizontal, true) << robot;
    EXPECT_EQ(controls(robot, top).flip_vertical, true) << robot;
    EXPECT_EQ(controls(robot, bottom).flip_vertical, false) << robot;
  }
  EXPECT_EQ(controls("nao-v5", top).auto_focus, std::nullopt);  // its focus is fixed
  EXPECT_EQ(controls("nao-v3", top).flip_vertical, std::nullopt);
}

TEST(Settings, ASimulatedCamerasShutterIsItsScenes) {
  EXPECT_EQ(load_text("").cycle.camera.readout_s, 0.0);
  EXPECT_EQ(load_text("[camera]\nreadout_s = 0.02\n").cycle.camera.readout_s, 0.02);
  for (const std::string source :
       {"lcm", "v4l2", "v4l2:/dev/video2", "naoqi", "naoqi:192.168.1.5", "naoqi:localhost:9560"}) {
    const std::string camera = "[camera]\nsource = \"" + source + "\"\n";
    EXPECT_EQ(load_text(camera).cycle.camera.readout_s,
              geometry::robot_profile("nao-v6")->readout_s)
        << source;
    EXPECT_EQ(load_text(camera + "readout_s = 0.0\n").cycle.camera.readout_s, 0.0) << source;
  }
}

TEST(Settings, ControlsAreUnsetUntilSet) {
  const Settings settings = load_text("[camera.controls]\nauto_focus = true\ngain = 0\n");
  EXPECT_EQ(settings.camera.controls.auto_focus, true);
  EXPECT_EQ(settings.camera.controls.gain, 0);
  EXPECT_EQ(settings.camera.controls.exposure, std::nullopt);
}

// Layers: profile < environment < scene < file < command line.

geometry::UncertaintyOverride calibrated(const std::string&) {
  return {.focal_sigma_px = 0.5, .centre_sigma_px = 1.0};
}

TEST(Layers, SceneIsAboveTheProfileAndBelowTheFile) {
  const SettingsFile file("[uncertainty]\ncentre_sigma_px = 2.5\n");
  const Settings settings = load_settings(file.layers(), calibrated);
  EXPECT_EQ(settings.rig.uncertainty.focal_sigma_px, 0.5);
  EXPECT_EQ(settings.rig.uncertainty.centre_sigma_px, 2.5);
  EXPECT_EQ(settings.rig.uncertainty.zero_sigma_rad, 0.005);  // the profile's
}

TEST(Layers, SceneOfTheCommandLineIsAsked) {
  std::string asked = "nothing";
  const auto scene = [&asked](const std::string& name) {
    asked = name;
    return geometry::UncertaintyOverride{};
  };
  const SettingsFile file("[sim]\nscene = \"file.toml\"\n");
  SettingsLayers layers = file.layers();
  static_cast<void>(load_settings(layers, scene));
  EXPECT_EQ(asked, "file.toml");
  layers.command_line = {{"sim.scene", "line.toml", "--scene"}};
  static_cast<void>(load_settings(layers, scene));
  EXPECT_EQ(asked, "line.toml");
}

TEST(Layers, SceneIsNotAskedWithoutASimulatedCamera) {
  const SettingsFile file("[camera]\nsource = \"lcm\"\n");
  const Settings settings = load_settings(file.layers(), calibrated);
  EXPECT_EQ(settings.rig.uncertainty.focal_sigma_px, 10.0);
}

TEST(Layers, SceneOutOfRangeIsRefusedByItsName) {
  SettingsLayers layers;
  layers.command_line = {{"sim.scene", "room.toml", "--scene"}};
  try {
    static_cast<void>(load_settings(layers, [](const std::string&) {
      return geometry::UncertaintyOverride{.pixel_sigma_px = -1.0};
    }));
    FAIL();
  } catch (const SettingsError& error) {
    EXPECT_STREQ(error.what(),
                 "room.toml: uncertainty.pixel_sigma_px: -1.0 found; allowed: 0 to 100");
  }
}

TEST(Layers, CommandLineIsAboveTheFile) {
  const SettingsFile file("robot = \"nao-v3\"\n[sim]\nseed = 5\n");
  SettingsLayers layers = file.layers();
  layers.command_line = {{"robot", "nao-v4", "--robot"}};
  const Settings settings = load_settings(layers, nothing_stated);
  EXPECT_EQ(settings.robot, "nao-v4");
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(557, 556));  // of the V4, not the V3
  EXPECT_EQ(settings.sim.seed, 5U);
}

TEST(Layers, FileIsAboveTheEnvironment) {
  SettingsLayers layers;
  layers.environment = {{"lcm.url", "memq://", "LCM_DEFAULT_URL"}};
  EXPECT_EQ(load_settings(layers, nothing_stated).lcm.url, "memq://");
  const SettingsFile file("[lcm]\nurl = \"udpm://239.255.76.67:7700?ttl=1\"\n");
  layers.file = file.path();
  EXPECT_EQ(load_settings(layers, nothing_stated).lcm.url, "udpm://239.255.76.67:7700?ttl=1");
}

TEST(Layers, WrongValueIsRefusedAlsoWhenALaterLayerReplacesIt) {
  const SettingsFile file("[sim]\nseed = -5\n");
  SettingsLayers layers = file.layers();
  layers.command_line = {{"sim.seed", "3", "--seed"}};
  EXPECT_EQ(refusal_of(layers, file), "robot.toml:2: sim.seed: -5 found; allowed: 0 to 4294967295");
}

TEST(Layers, AssignmentToNoKeyIsRefused) {
  SettingsLayers layers;
  layers.command_line = {{"camera.sauce", "sim", "--sauce"}};
  EXPECT_THROW(static_cast<void>(load_settings(layers, nothing_stated)), SettingsError);
}

// Another image size than the profile's.

TEST(ImageSize, IntrinsicsScaleWithTheImage) {
  const Settings settings =
      load_text("robot = \"nao-v4\"\n[camera]\nwidth_px = 320\nheight_px = 240\n");
  EXPECT_EQ(settings.rig.camera.width_px, 320);
  EXPECT_EQ(settings.rig.camera.height_px, 240);
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(278.5, 278));
  // Pixel centres: (c + 0.5) / 2 - 0.5 of 309.4 and 230.6.
  EXPECT_DOUBLE_EQ(settings.rig.camera.centre_px.x(), 154.45);
  EXPECT_DOUBLE_EQ(settings.rig.camera.centre_px.y(), 115.05);
  EXPECT_EQ(settings.rig.uncertainty.focal_sigma_px, 2.5);
  EXPECT_EQ(settings.rig.uncertainty.centre_sigma_px, 2.0);
}

TEST(ImageSize, StatedIntrinsicsDoNotScale) {
  const Settings settings =
      load_text("[camera]\nwidth_px = 1280\nheight_px = 960\nfocal_px = [1200, 1201]\n");
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(1200, 1201));
  EXPECT_EQ(settings.rig.camera.centre_px, Eigen::Vector2d(639.5, 479.5));
}

TEST(ImageSize, AnotherAspectAsksForIntrinsics) {
  EXPECT_EQ(refusal_of("[camera]\nwidth_px = 1280\nheight_px = 720\n"),
            "robot.toml:3: camera.height_px: 1280x720 found; allowed: the aspect of 640x480, or "
            "with camera.focal_px and camera.centre_px");
  const Settings settings = load_text(
      "[camera]\nwidth_px = 1280\nheight_px = 720\nfocal_px = [1200, 1200]\n"
      "centre_px = [640, 360]\n");
  EXPECT_EQ(settings.rig.camera.height_px, 720);
}

// Pace of simulated time.

TEST(Pace, FastNeedsASimulatedCameraAndHead) {
  Settings settings;
  EXPECT_FALSE(runs_fast(settings));  // until stopped
  settings.run.fixations = 2;
  EXPECT_TRUE(runs_fast(settings));
  settings.sim.pace = sim::Pace::real;
  EXPECT_FALSE(runs_fast(settings));
  settings.sim.pace = sim::Pace::fast;
  settings.run.fixations = 0;
  EXPECT_TRUE(runs_fast(settings));
  settings.head.source = drivers::Source::parse(drivers::Part::head, "lcm").value();
  EXPECT_FALSE(runs_fast(settings));
}

}  // namespace
}  // namespace gazed::settings::settings_test
