#include "rooms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "agent/geometry/limits.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::triangulation {

namespace {

constexpr double border_px = 20.0;

/// Agent/gaze's step rule, where no limit is near: towards the target, at least 0.1 rad.
geometry::HeadAngles step_rule(const geometry::CameraModel& camera, const geometry::Pixel& pixel) {
  const auto change = [](double to_the_right, double half_field_rad) {
    const double wanted = to_the_right * half_field_rad;
    return std::copysign(std::max(0.1, std::abs(wanted)), wanted);
  };
  const double x_c = 0.5 * (camera.width_px - 1), y_c = 0.5 * (camera.height_px - 1);
  return {-change((pixel.x() - x_c) / x_c, std::atan(0.5 * camera.width_px / camera.focal_px.x())),
          change((pixel.y() - y_c) / y_c, std::atan(0.5 * camera.height_px / camera.focal_px.y()))};
}

bool sees(const Room& room, geometry::HeadAngles reading) {
  const auto pixel = geometry::project(
      room.true_camera, geometry::cam_from_torso(room.true_head, reading) * room.torso_point_m);
  return pixel && room.true_camera.contains(*pixel, border_px);
}

/// From `aim` as far to a corner as the target stays in view.
geometry::HeadAngles corner(const Room& room, geometry::HeadAngles aim, std::size_t k) {
  static const geometry::HeadLimits limits(0.02);
  const double x = k % 2 == 0 ? 1.0 : -1.0, y = k % 4 < 2 ? x : -x;
  for (double share = 1.0; share > 0.1; share -= 0.02) {
    const geometry::HeadAngles there =
        limits.clamp(aim + geometry::HeadAngles{x * 0.484 * share, y * 0.376 * share});
    if (sees(room, there)) return there;
  }
  return aim + geometry::HeadAngles{0.1 * x, 0.1 * y};
}

void draw_robot(Room& room, const geometry::Uncertainty& u, Random& random) {
  room.true_head = room.rig.head;
  room.true_camera = room.rig.camera;
  room.true_head.zero = room.true_head.zero + random_angles(u.zero_sigma_rad, random);
  room.true_head.mount_offset_m += u.mount_offset_sigma_m * random.normal_3();
  room.true_head.mount_rotation_rad += u.mount_rotation_sigma_rad * random.normal_3();
  room.true_camera.focal_px.array() += u.focal_sigma_px * random.normal();
  room.true_camera.centre_px += u.centre_sigma_px * random.normal_2();
  if (u.distortion_sigma == std::array<double, 2>{}) return;
  for (std::size_t i = 0; i < 2; ++i) {
    room.true_camera.distortion[i] += u.distortion_sigma[i] * random.normal();
  }
}

/// The target at or below the camera's level, anywhere in look 1's frame.
void draw_target(Room& room, const RoomModel& model, Random& random) {
  const geometry::HeadAngles head_1{random.uniform(-0.3, 0.3), random.uniform(0.0, 0.2)};
  const geometry::Pose torso_from_cam1 = geometry::cam_from_torso(room.true_head, head_1).inverse();
  const double spread = model.centred ? 0.0 : 1.0;
  const geometry::Pixel pixel{320.0 + 260.0 * spread * random.uniform(-1.0, 1.0),
                              240.0 + 180.0 * spread * random.uniform(-1.0, 1.0)};
  const Eigen::Vector3d ray = geometry::normalise(room.true_camera, pixel).value().homogeneous();
  room.torso_point_m = torso_from_cam1 * (model.range_m * ray.normalized());
  room.inverse_range_per_m = 1.0 / model.range_m;
  room.true_readings.push_back(head_1);
  if (model.moves == Moves::pair) {
    room.true_readings.push_back(head_1 + step_rule(room.true_camera, pixel));
    return;
  }
  // Where the target is in the middle.
  const geometry::HeadAngles aim =
      head_1 + geometry::HeadAngles{-std::atan(ray.x()), std::atan(ray.y())};
  while (room.true_readings.size() < model.looks) {
    room.true_readings.push_back(corner(room, aim, room.true_readings.size()));
  }
}

void move_torso(Room& room, const RoomModel& model, Random& random) {
  room.true_torso_from_torso_1.resize(room.true_readings.size());
  if (model.torso_translation_m == 0.0) return;
  for (std::size_t k = 1; k < room.true_readings.size(); ++k) {
    const Eigen::Vector3d turn = model.torso_rotation_rad * random.normal_3();
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    const Eigen::Vector3d& neck_m = room.true_head.neck_offset_m;
    room.true_torso_from_torso_1[k] = {
        rotation, neck_m - rotation * neck_m + model.torso_translation_m * random.normal_3()};
  }
}

void measure_sweeps(Room& room, const RoomModel& model, Random& random) {
  room.true_sweeps.resize(room.looks.size());
  if (model.sweep_sigma_rad == 0.0) return;
  for (std::size_t k = 0; k < room.looks.size(); ++k) {
    all_looks::Look& look = room.looks[k];
    look.sweep_sigma_rad = model.sweep_measured_sigma_rad;
    room.true_sweeps[k] = random_angles(model.sweep_sigma_rad, random);
    look.sweep = room.true_sweeps[k] + random_angles(look.sweep_sigma_rad, random);
  }
}

/// Where a point of the room is seen in a look when its own row is exposed.
std::optional<geometry::Pixel> seen_in_its_row(const Room& room, std::size_t k,
                                               const Eigen::Vector3d& point_m) {
  const int last_row = room.true_camera.height_px - 1;
  std::optional<geometry::Pixel> pixel;
  double row_px = room.looks[k].pixel.y();
  for (int i = 0; i < 4; ++i) {  // each time hundreds of times nearer
    const double share = (row_px - room.looks[k].pixel.y()) / last_row;
    const geometry::HeadAngles& sweep = room.true_sweeps[k];
    const geometry::HeadAngles then =
        room.true_readings[k] +
        geometry::HeadAngles{share * sweep.yaw_rad, share * sweep.pitch_rad};
    pixel = geometry::project(room.true_camera, geometry::cam_from_torso(room.true_head, then) *
                                                    (room.true_torso_from_torso_1[k] * point_m));
    if (!pixel) return pixel;
    row_px = pixel->y();
  }
  return pixel;
}

void measure_target(Room& room, const geometry::Uncertainty& u, double registration_sigma_px,
                    Random& random) {
  for (std::size_t k = 0; k < room.true_readings.size(); ++k) {
    const geometry::HeadAngles reading = room.true_readings[k];
    all_looks::Look look;
    look.head = reading + random_angles(u.encoder_sigma_rad, random);
    look.pixel = geometry::project(room.true_camera,
                                   geometry::cam_from_torso(room.true_head, reading) *
                                       (room.true_torso_from_torso_1[k] * room.torso_point_m))
                     .value();
    if (!room.looks.empty()) {
      look.covariance_px2 = 0.16 * Eigen::Matrix2d::Identity();
      look.pixel +=
          u.pixel_sigma_px * random.normal_2() + registration_sigma_px * random.normal_2();
    }
    room.looks.push_back(look);
  }
}

FeatureObservations random_track(const Room& room, double noise, bool wrong, Random& random) {
  const geometry::Pixel start{random.uniform(10.0, 630.0), random.uniform(10.0, 470.0)};
  const double depth_m = 0.3 * std::pow(5.0 / 0.3, random.uniform());
  const double sigma_px = random.uniform(0.3, 0.5);
  const Eigen::Vector3d point_1_m =
      depth_m * geometry::normalise(room.true_camera, start).value().homogeneous();
  const double share = (start.y() - room.looks[0].pixel.y()) / (room.true_camera.height_px - 1);
  const geometry::HeadAngles& sweep_1 = room.true_sweeps[0];
  const geometry::HeadAngles then_1 =
      room.true_readings[0] +
      geometry::HeadAngles{share * sweep_1.yaw_rad, share * sweep_1.pitch_rad};
  const Eigen::Vector3d point_m =
      geometry::cam_from_torso(room.true_head, then_1).inverse() * point_1_m;
  FeatureObservations track;
  track.sigma_px = sigma_px * std::sqrt(2.0);
  track.pixel[0] = start + noise * sigma_px * random.normal_2();
  for (std::size_t k = 1; k < room.true_readings.size(); ++k) {
    const auto pixel = seen_in_its_row(room, k, point_m);
    if (!pixel || !room.true_camera.contains(*pixel, 5.0)) continue;
    track.pixel[k] = *pixel + noise * sigma_px * random.normal_2();
    if (wrong)
      track.pixel[k] +=
          15.0 * geometry::Pixel(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  }
  return track;
}

}  // namespace

all_looks::Estimate Room::locate(const Gate& gate) const {
  return all_looks::locate(rig, looks, features, gate);
}

all_looks::Estimate Room::locate_without_features(const Gate& gate) const {
  return all_looks::locate(rig, looks, {}, gate);
}

Room random_room(const RoomModel& model, Random& random) {
  Room room;
  room.rig = geometry::robot_profile("nao-v6")->rig;
  room.rig.uncertainty = {.pixel_sigma_px = 0.3,
                          .encoder_sigma_rad = model.encoder_sigma_rad,
                          .zero_sigma_rad = 3e-3,
                          .focal_sigma_px = 0.5,
                          .centre_sigma_px = 1.0,
                          .distortion_sigma = model.distortion_sigma,
                          .mount_offset_sigma_m = 1e-3,
                          .mount_rotation_sigma_rad = 3e-3,
                          .torso_rotation_sigma_rad = model.torso_may_move ? 12e-3 : 0.0,
                          .torso_translation_sigma_m = model.torso_may_move ? 5e-3 : 0.0};
  const double noise = model.exact ? 0.0 : 1.0;
  const geometry::Uncertainty errors = model.exact ? geometry::Uncertainty{} : room.rig.uncertainty;
  draw_robot(room, errors, random);
  draw_target(room, model, random);
  move_torso(room, model, random);
  measure_target(room, errors, 0.4 * noise, random);
  measure_sweeps(room, model, random);
  for (std::size_t i = 0; i < model.features; ++i) {
    const bool wrong =
        static_cast<double>(i) < model.wrong_share * static_cast<double>(model.features);
    room.features.push_back(random_track(room, noise, wrong, random));
  }
  return room;
}

}  // namespace gazed::triangulation
