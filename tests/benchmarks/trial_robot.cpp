#include "tests/benchmarks/trial_robot.hpp"

#include <Eigen/Core>
#include <array>
#include <numbers>

#include "agent/base/random.hpp"
#include "agent/geometry/robot.hpp"

#include "tests/benchmarks/accuracy_placing.hpp"

namespace gazed::benchmarks {

namespace {

// Streams of the seed.
enum RobotStream : std::uint64_t {
  robot_stream = 201,
  body_stream = 205,
  strain_stream = 207,
  lens_stream = 209,
};

// A calibrated robot, as the default scene's (drivers/sim/default_scene.cpp).
constexpr geometry::UncertaintyOverride calibrated{.encoder_sigma_rad = {},
                                                   .zero_sigma_rad = 0.003,
                                                   .focal_sigma_px = 0.5,
                                                   .centre_sigma_px = 1.0,
                                                   .distortion_sigma = {{0.003, 0.01}},
                                                   .mount_offset_sigma_m = 0.001,
                                                   .mount_rotation_sigma_rad = 0.003};

// Joints miss their commands by up to this much (Russcher 2011, chapter 5): an error of the motion,
// not of what is measured.
constexpr double settling_error_rad = 0.02;

// By how much the cameras of real heads are turned about their mean. What the agent is told is
// more, since their mean is not the datasheet's.
constexpr double mount_spread_rad = 0.03;

/// What the agent is told of a calibrated robot's errors.
geometry::Uncertainty calibrated_of(const geometry::Uncertainty& uncalibrated) {
  geometry::Uncertainty told = uncalibrated;
  told.zero_sigma_rad = *calibrated.zero_sigma_rad;
  told.focal_sigma_px = *calibrated.focal_sigma_px;
  told.centre_sigma_px = *calibrated.centre_sigma_px;
  told.distortion_sigma = *calibrated.distortion_sigma;
  told.mount_offset_sigma_m = *calibrated.mount_offset_sigma_m;
  told.mount_rotation_sigma_rad = *calibrated.mount_rotation_sigma_rad;
  return told;
}

/// Each error is drawn with its sigma.
void draw_truth(sim::RobotTruth& robot, const geometry::Rig& rig, const geometry::Uncertainty& told,
                base::Random& random) {
  const auto error = [&random](double sigma) { return sigma * random.normal(); };
  const double focal_error_px = error(told.focal_sigma_px);  // of fx and fy together
  robot.focal_px = {rig.camera.focal_px.x() + focal_error_px,
                    rig.camera.focal_px.y() + focal_error_px};
  const auto off = [&](const Eigen::Vector3d& nominal, double sigma) {
    const double x = nominal.x() + error(sigma), y = nominal.y() + error(sigma);
    return std::array<double, 3>{x, y, nominal.z() + error(sigma)};
  };
  const double centre_x_px = rig.camera.centre_px.x() + error(told.centre_sigma_px);
  robot.centre_px = {centre_x_px, rig.camera.centre_px.y() + error(told.centre_sigma_px)};
  robot.mount_offset_m = off(rig.head.mount_offset_m, told.mount_offset_sigma_m);
  robot.mount_rotation_rad = off(rig.head.mount_rotation_rad, told.mount_rotation_sigma_rad);
  const double zero_yaw_rad = error(told.zero_sigma_rad);
  robot.zero_rad = {zero_yaw_rad, error(told.zero_sigma_rad)};
}

void draw_lens(sim::RobotTruth& robot, const std::array<double, 2>& sigma, base::Random& random) {
  const double k1 = sigma[0] * random.normal(), k2 = sigma[1] * random.normal();
  robot.distortion = {k1, k2, 0.0, 0.0, 0.0};
}

/// How joints and camera behave.
void draw_body(Trial& trial, Body body, const geometry::RobotProfile& profile) {
  sim::JointBehaviour& joints = trial.scene.joints;
  sim::CameraBehaviour& camera = trial.scene.camera;
  joints.encoder_sigma_rad = trial.settings.rig.uncertainty.encoder_sigma_rad;
  joints.settling_error_rad = settling_error_rad;
  camera.pixel_noise = 2.0;
  camera.blur_sigma_px = 0.5;
  if (body == Body::calm) return;
  base::Random random(trial.seed, body_stream);
  joints.settle_time_constant_s = 0.08;
  joints.encoder_step_rad = 0.00153;  // 12 bits
  joints.encoder_noise_rad = 0.0002;  // flickers where two steps meet
  joints.velocity = sim::Velocity::none;
  camera.format = base::PixelFormat::yuyv;
  camera.pixel_noise = random.uniform(1.5, 3.0);
  camera.blur_sigma_px = random.uniform(0.5, 0.8);
  camera.readout_s = profile.readout_s;
  camera.delay_s = 0.002 * random.normal();  // what is left of the delay that drivers add
  trial.settings.cycle.camera.readout_s = profile.readout_s;
}

/// How the camera is turned in the head against what the profile says: roll, pitch, yaw. The top
/// cameras of 17 V6 heads, HULKs 2024, head.*.json, there in the optical axes and in degrees.
void turn_mount(Trial& trial, base::Random& random) {
  constexpr double degree = std::numbers::pi / 180.0;
  constexpr std::array<double, 3> mean{-0.15, 4.02, -1.25}, spread{0.78, 1.92, 2.04};
  const Eigen::Vector3d& believed = trial.settings.rig.head.mount_rotation_rad;
  std::array<double, 3> mount{believed.x(), believed.y(), believed.z()};
  for (std::size_t i = 0; i < 3; ++i) mount[i] += degree * (mean[i] + spread[i] * random.normal());
  trial.scene.robot.mount_rotation_rad = mount;
}

/// What robot and camera suffer beside.
void add_strain(Trial& trial, const Row& row, base::Random& random) {
  sim::Scene& scene = trial.scene;
  switch (row.strain) {
    case Strain::sway:
      scene.sway = {.translation_m = 0.002, .rotation_rad = 0.005, .frequency_hz = 0.3};
      break;
    case Strain::lens: {
      // Half a field of view is 0.66 focal lengths long: 608 x 0.66^3 x 0.012 px in the corners.
      const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
      const double k1 = sign * random.uniform(0.008, 0.016), k2 = 0.004 * random.normal();
      scene.robot.distortion = {k1, k2, 0.0, 0.0, 0.0};
      break;
    }
    case Strain::exposure:
      scene.camera.exposure_step = 0.3;
      break;
    case Strain::jpeg:
      scene.camera.jpeg_quality = 60;
      break;
    case Strain::sweep:
      scene.joints.drift_rad_s = 0.003 / scene.camera.readout_s;
      [[fallthrough]];
    case Strain::no_sweep:
      scene.joints.settle_time_constant_s = 0.02;
      trial.settings.cycle.motion.settle_velocity_rad_s = 0.15;
      break;
    case Strain::real_mount:
      turn_mount(trial, random);
      break;
    default:
      break;
  }
}

/// The same lens over another number of pixels; (0, 0) is the centre of a pixel.
void scale(geometry::Rig& rig, int width_px) {
  const double share = static_cast<double>(width_px) / rig.camera.width_px;
  rig.camera.height_px = rig.camera.height_px * width_px / rig.camera.width_px;
  rig.camera.width_px = width_px;
  rig.camera.focal_px *= share;
  rig.camera.centre_px = (rig.camera.centre_px.array() + 0.5) * share - 0.5;
  rig.uncertainty.focal_sigma_px *= share;
  rig.uncertainty.centre_sigma_px *= share;
}

}  // namespace

void draw_robot(Trial& trial, const Row& row) {
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  geometry::Rig& believed = trial.settings.rig;
  geometry::Uncertainty& told = believed.uncertainty;
  const std::array<double, 2> any_lens = told.distortion_sigma;
  if (row.body != Body::uncalibrated) told = calibrated_of(told);
  // A calm robot is held by a stand, and the agent is told so.
  if (row.body == Body::calm) told.torso_rotation_sigma_rad = told.torso_translation_sigma_m = 0.0;
  if (row.width_px != believed.camera.width_px) {
    scale(believed, row.width_px);
    trial.scene.camera.width_px = believed.camera.width_px;
    trial.scene.camera.height_px = believed.camera.height_px;
  }
  base::Random random(trial.seed, robot_stream);
  geometry::Uncertainty drawn = told;
  if (row.body == Body::uncalibrated) drawn.mount_rotation_sigma_rad = mount_spread_rad;
  draw_truth(trial.scene.robot, believed, drawn, random);
  base::Random lens(trial.seed, lens_stream);
  draw_lens(trial.scene.robot, told.distortion_sigma, lens);
  if (row.strain == Strain::lens) told.distortion_sigma = any_lens;  // nobody looked at it
  believed.uncertainty.encoder_sigma_rad = one_of(random, row.encoder_sigmas_rad);
  // Where a row says how many, the point does not decide.
  cycle::LocateSettings& locate = trial.settings.cycle.locate;
  if (!row.looks.empty()) locate.looks = locate.looks_min = one_of(random, row.looks);
  draw_body(trial, row.body, profile);
  base::Random strain(trial.seed, strain_stream);
  add_strain(trial, row, strain);
}

}  // namespace gazed::benchmarks
