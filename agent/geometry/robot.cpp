#include "agent/geometry/robot.hpp"

namespace gazed::geometry {

namespace {

// Of 640x480 pixels, without distortion.
struct Optics {
  double focal_x_px, focal_y_px, centre_x_px, centre_y_px;
};

// Of a camera in the middle of the head, pitched down.
struct Mount {
  double forward_m, up_m, pitch_rad;
};

// Rolling shutter: the times of RobotProfile.
struct Shutter {
  double readout_s, delay_s;
};

// Intrinsics of V3: Russcher 2011, table 3.2, the one calibration there is. Mounting:
// manufacturer's documentation 1.14, "Video". Nobody published the timing of its shutter: left at
// 0.
constexpr Optics v3_optics{752.0, 752.0, 331.0, 253.0};
constexpr Mount v3_top_mount{0.0539, 0.0679, 0.0};
constexpr Mount v3_bottom_mount{0.0488, 0.02381, 0.6981};
constexpr Shutter v3_shutter{0.0, 0.0};

// Mounting, V4 and later: manufacturer's documentation 2.1, "Video" (1.2 and 39.7 degrees).
constexpr Mount v4_top_mount{0.05871, 0.06364, 0.0209};
constexpr Mount v4_bottom_mount{0.05071, 0.01774, 0.6929};

// Intrinsics of V4 and V5: naoqi_driver, camera_info_definitions.hpp (focal length of the top
// camera 556.8 and 555.9, rounded).
//
// Shutter: B-Human 2017, coordinateSystemProvider.cfg. imageRecordingTime is the readout, and the
// first row is exposed imageRecordingTime + imageRecordingDelay before the stamp
// (CoordinateSystemProvider.cpp, calcScaleFactors()), here 34 - 3 ms: the stamp is one of the end.
constexpr Optics v4_top_optics{557.0, 556.0, 309.4, 230.6};
constexpr Optics v4_bottom_optics{558.6, 556.1, 308.9, 247.6};
constexpr Shutter v4_shutter{0.034, -0.031};

// Intrinsics of V6: HULKs 2024, default parameters (0.95 x 640 px, the middle of the image).
// Shutter: B-Human 2024, coordinateSystemProvider.cfg, 37 - 39 and 45 - 36 ms before the stamp: it
// is one of the beginning.
constexpr Optics v6_optics{608.0, 608.0, 319.5, 239.5};
constexpr Shutter v6_top_shutter{0.037, 0.002};
constexpr Shutter v6_bottom_shutter{0.045, -0.009};

// A robot that nobody calibrated: its encoders and image points are worth the same in all versions,
// its datasheet is not. No profile knows its lens: with k1 = 0.03 the corners are 5 px off.
// Corners slip: of 1.0 to 2.0, on 240 trials of the accuracy benchmark's row real_10, the least
// error and intervals that are true.
constexpr Uncertainty uncalibrated(double focal_sigma_px, double centre_sigma_px,
                                   double mount_rotation_sigma_rad) {
  return {.pixel_sigma_px = 0.3,
          .encoder_sigma_rad = 0.001,
          .zero_sigma_rad = 0.005,
          .focal_sigma_px = focal_sigma_px,
          .centre_sigma_px = centre_sigma_px,
          .distortion_sigma = {0.03, 0.05},
          .mount_offset_sigma_m = 0.002,
          .mount_rotation_sigma_rad = mount_rotation_sigma_rad,
          .torso_rotation_sigma_rad = 0.012,
          .torso_translation_sigma_m = 0.005,
          .corner_slip = 1.5};
}

// Focal length and centre of V3: the standard deviations of its calibration, Russcher 2011, table
// 3.2. The others are the spread of uncalibrated heads; V6: the tops of 17 are pitched by 4.0
// +- 1.9 degrees against the datasheet, HULKs 2024, head.*.json.
constexpr Uncertainty v3_uncertainty = uncalibrated(2.0, 1.6, 0.02);
constexpr Uncertainty v4_uncertainty = uncalibrated(5.0, 4.0, 0.02);
constexpr Uncertainty v6_uncertainty = uncalibrated(10.0, 8.0, 0.07);

// Devices. V6: the names that its udev rules give (B-Human 2024, 99-nao.rules). V3 to V5: in the
// order in which they are connected, the top one first (B-Human 2017).
//
// The top camera of V4 to V6 is built in upside down; only the V6's focus moves
// (drivers/README.md).
constexpr VideoProfile v3_top_video{.device = "/dev/video0"};
constexpr VideoProfile v3_bottom_video{.device = "/dev/video1"};
constexpr VideoProfile v4_top_video{.device = "/dev/video0", .upside_down = true};
constexpr VideoProfile v4_bottom_video{.device = "/dev/video1", .upside_down = false};
constexpr VideoProfile v6_top_video{.device = "/dev/video-top",
                                    .upside_down = true,
                                    .has_auto_focus = true,
                                    .flips_by_extension_unit = true};
constexpr VideoProfile v6_bottom_video{.device = "/dev/video-bottom",
                                       .upside_down = false,
                                       .has_auto_focus = true,
                                       .flips_by_extension_unit = true};

struct Entry {
  std::string_view name;
  CameraPosition position;
  const Optics& optics;
  const Mount& mount;
  const Shutter& shutter;
  const Uncertainty& uncertainty;
  const VideoProfile& video;
};

constexpr std::string_view v3 = robot_names[0], v4 = robot_names[1], v5 = robot_names[2],
                           v6 = robot_names[3];

using enum CameraPosition;
constexpr std::array<Entry, 8> entries{{
    {v3, top, v3_optics, v3_top_mount, v3_shutter, v3_uncertainty, v3_top_video},
    {v3, bottom, v3_optics, v3_bottom_mount, v3_shutter, v3_uncertainty, v3_bottom_video},
    {v4, top, v4_top_optics, v4_top_mount, v4_shutter, v4_uncertainty, v4_top_video},
    {v4, bottom, v4_bottom_optics, v4_bottom_mount, v4_shutter, v4_uncertainty, v4_bottom_video},
    {v5, top, v4_top_optics, v4_top_mount, v4_shutter, v4_uncertainty, v4_top_video},
    {v5, bottom, v4_bottom_optics, v4_bottom_mount, v4_shutter, v4_uncertainty, v4_bottom_video},
    {v6, top, v6_optics, v4_top_mount, v6_top_shutter, v6_uncertainty, v6_top_video},
    {v6, bottom, v6_optics, v4_bottom_mount, v6_bottom_shutter, v6_uncertainty, v6_bottom_video},
}};

RobotProfile profile_of(const Entry& entry) {
  RobotProfile profile;
  profile.name = entry.name;
  profile.rig.camera.focal_px = {entry.optics.focal_x_px, entry.optics.focal_y_px};
  profile.rig.camera.centre_px = {entry.optics.centre_x_px, entry.optics.centre_y_px};
  // Joint axes above the torso origin, all versions: manufacturer's documentation, "Links",
  // NeckOffsetZ 126.50 mm.
  profile.rig.head.neck_offset_m = {0.0, 0.0, 0.1265};
  profile.rig.head.mount_offset_m = {entry.mount.forward_m, 0.0, entry.mount.up_m};
  profile.rig.head.mount_rotation_rad = {0.0, entry.mount.pitch_rad, 0.0};
  profile.rig.uncertainty = entry.uncertainty;
  profile.video = entry.video;
  profile.readout_s = entry.shutter.readout_s;
  profile.delay_s = entry.shutter.delay_s;
  // No-load speeds, all versions: velocity limits of the NAO's URDFs, V3.2 to V6.
  profile.max_speed_rad_s = {8.26797, 7.19407};
  // Settling, all versions: up to 0.02 rad off the command (Russcher 2011, chapter 5), uniform:
  // 0.02 / sqrt(3). Play: a worn gear's 0.03 rad from end to end, a choice, uniform: 0.03 /
  // sqrt(12).
  profile.settling_sigma_rad = 0.012;
  profile.play_sigma_rad = 0.009;
  return profile;
}

}  // namespace

std::optional<RobotProfile> robot_profile(std::string_view name, CameraPosition position) {
  for (const Entry& entry : entries) {
    if (entry.name == name && entry.position == position) return profile_of(entry);
  }
  return std::nullopt;
}

}  // namespace gazed::geometry
