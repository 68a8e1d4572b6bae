#include <array>
#include <optional>
#include <string_view>

#include "drivers/sim/scene_reading.hpp"

namespace gazed::sim::reading {

void read_robot(std::optional<base::StrictTable> table, RobotTruth& robot) {
  if (!table) return;
  robot.focal_px = table->numbers<2>("focal_px", {10.0, 100'000.0});
  robot.centre_px = table->numbers<2>("centre_px", {-10'000.0, 10'000.0});
  robot.distortion = table->numbers<5>("distortion", {-10.0, 10.0});
  robot.neck_offset_m = table->numbers<3>("neck_offset_m", {-1.0, 1.0});
  robot.mount_offset_m = table->numbers<3>("mount_offset_m", {-1.0, 1.0});
  robot.mount_rotation_rad = table->numbers<3>("mount_rotation_rad", {-3.2, 3.2});
  robot.zero_rad = table->numbers<2>("zero_rad", {-0.5, 0.5});
  table->finish();
}

void read_joints(std::optional<base::StrictTable> table, JointBehaviour& joints) {
  if (!table) return;
  joints.max_speed_rad_s = table->numbers<2>("max_speed_rad_s", {0.1, 100.0});
  take(joints.acceleration_rad_s2, table->number("acceleration_rad_s2", {0.1, 10'000.0}));
  take(joints.settle_time_constant_s, table->number("settle_time_constant_s", {0.0, 1.0}));
  take(joints.settling_error_rad, table->number("settling_error_rad", {0.0, 0.5}));
  take(joints.encoder_step_rad, table->number("encoder_step_rad", {0.0, 0.1}));
  take(joints.encoder_noise_rad, table->number("encoder_noise_rad", {0.0, 0.1}));
  take(joints.encoder_sigma_rad, table->number("encoder_sigma_rad", {0.0, 0.5}));
  take(joints.backlash_rad, table->number("backlash_rad", {0.0, 0.2}));
  take(joints.drift_rad_s, table->number("drift_rad_s", {0.0, 1.0}));
  take(joints.velocity_noise_rad_s, table->number("velocity_noise_rad_s", {0.0, 1.0}));
  take_choice(joints.velocity, *table, "velocity",
              std::array<std::string_view, 3>{"measured", "none", "zero"});
  table->finish();
}

void read_sway(std::optional<base::StrictTable> table, Sway& sway) {
  if (!table) return;
  take(sway.translation_m, table->number("translation_m", {0.0, 0.1}));
  take(sway.rotation_rad, table->number("rotation_rad", {0.0, 0.1}));
  take(sway.frequency_hz, table->number("frequency_hz", {0.01, 10.0}));
  table->finish();
}

void read_camera(std::optional<base::StrictTable> table, CameraBehaviour& camera) {
  if (!table) return;
  camera.width_px = table->integer("width_px", {16, 4096});
  camera.height_px = table->integer("height_px", {16, 4096});
  take(camera.fps, table->number("fps", {0.1, 200.0}));
  constexpr std::array<std::string_view, 2> formats{"rgb", "yuyv"};
  if (const std::optional<std::size_t> format = table->choice("format", formats))
    camera.format = *format == 0 ? base::PixelFormat::rgb24 : base::PixelFormat::yuyv;
  if (camera.format == base::PixelFormat::yuyv && camera.width_px && *camera.width_px % 2 != 0)
    table->fail("width_px", "an even width for format \"yuyv\"");
  take(camera.pixel_noise, table->number("pixel_noise", {0.0, 50.0}));
  take(camera.blur_sigma_px, table->number("blur_sigma_px", {0.0, 5.0}));
  take(camera.exposure, table->number("exposure", {0.01, 10.0}));
  take(camera.exposure_swing, table->number("exposure_swing", {0.0, 0.9}));
  take(camera.exposure_step, table->number("exposure_step", {0.0, 0.9}));
  take(camera.exposure_period_s, table->number("exposure_period_s", {0.1, 1e6}));
  take(camera.readout_s, table->number("readout_s", {0.0, 0.1}));
  take(camera.delay_s, table->number("delay_s", {-0.2, 0.2}));
  take(camera.jpeg_quality, table->integer("jpeg_quality", {0, 100}));
  if (camera.jpeg_quality > 0 && camera.format != base::PixelFormat::yuyv)
    table->fail("jpeg_quality", "0 but for format \"yuyv\"");
  take(camera.drop_rate, table->number("drop_rate", {0.0, 0.9}));
  table->finish();
}

void read_uncertainty(std::optional<base::StrictTable> table,
                      geometry::UncertaintyOverride& uncertainty) {
  if (!table) return;
  constexpr base::Range pixels{0.0, 1000.0}, angles_rad{0.0, 1.0};
  uncertainty.pixel_sigma_px = table->number("pixel_sigma_px", pixels);
  uncertainty.encoder_sigma_rad = table->number("encoder_sigma_rad", angles_rad);
  uncertainty.zero_sigma_rad = table->number("zero_sigma_rad", angles_rad);
  uncertainty.focal_sigma_px = table->number("focal_sigma_px", pixels);
  uncertainty.centre_sigma_px = table->number("centre_sigma_px", pixels);
  uncertainty.distortion_sigma = table->numbers<2>("distortion_sigma", {0.0, 1.0});
  uncertainty.mount_offset_sigma_m = table->number("mount_offset_sigma_m", {0.0, 1.0});
  uncertainty.mount_rotation_sigma_rad = table->number("mount_rotation_sigma_rad", angles_rad);
  uncertainty.torso_rotation_sigma_rad = table->number("torso_rotation_sigma_rad", angles_rad);
  uncertainty.torso_translation_sigma_m = table->number("torso_translation_sigma_m", {0.0, 1.0});
  uncertainty.corner_slip = table->number("corner_slip", {1.0, 10.0});
  table->finish();
}

}  // namespace gazed::sim::reading
