#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "agent/daemon/message_fields.hpp"
#include "agent/daemon/publisher.hpp"

namespace gazed::daemon {

namespace {

std::vector<float> pair_of(const Eigen::Vector2f& point) {
  return {point.x(), point.y()};
}

look_t to_message(const cycle::FixationLook& look) {
  look_t message{};
  message.utime = look.utime_us;
  copy(look.measured, message.measured_rad);
  copy(look.refined, message.refined_rad);
  const Eigen::AngleAxisd turn(look.torso_1_from_torso.rotation);
  copy(Eigen::Vector3d(turn.angle() * turn.axis()), message.torso_rad);
  copy(look.torso_1_from_torso.translation, message.torso_m);
  copy(look.pixel, message.pixel);
  copy(look.covariance_px2, &message.pixel_covariance_px2[0][0]);
  copy(look.epipole, message.epipole);
  message.chi2 = static_cast<float>(look.chi2);
  message.used = look.used ? 1 : 0;
  message.reason = look.reason;
  message.ncorners = static_cast<std::int32_t>(look.corner_count);
  for (const cycle::LookCorner& corner : std::span(look.corners).first(look.corner_count)) {
    message.corner_px.push_back(pair_of(corner.pixel));
    message.corner_used.push_back(corner.used ? 1 : 0);
  }
  return message;
}

/// In the order of fixation_t.
void fill_robot(const triangulation::all_looks::BelievedRobot& robot, fixation_t& message) {
  const auto& [camera, head, focal_sigma_px, centre_sigma_px, distortion_sigma,
               mount_rotation_sigma_rad, mount_offset_sigma_m, zero_sigma_rad] = robot;
  double *value = message.robot, *sigma = message.robot_sigma;
  const auto add = [&](double believed, double its_sigma) {
    *value++ = believed;
    *sigma++ = its_sigma;
  };
  add(camera.focal_px.mean(), focal_sigma_px);
  for (int i = 0; i < 2; ++i) add(camera.centre_px(i), centre_sigma_px(i));
  for (int i = 0; i < 2; ++i)
    add(camera.distortion[static_cast<std::size_t>(i)], distortion_sigma(i));
  for (int i = 0; i < 3; ++i) add(head.mount_rotation_rad(i), mount_rotation_sigma_rad(i));
  for (int i = 0; i < 3; ++i) add(head.mount_offset_m(i), mount_offset_sigma_m(i));
  add(head.zero.yaw_rad, zero_sigma_rad(0));
  add(head.zero.pitch_rad, zero_sigma_rad(1));
}

}  // namespace

fixation_t to_fixation_message(const cycle::Fixation& fixation, const std::string& robot) {
  fixation_t message{};
  message.utime = fixation.utime_us;
  message.fixation = fixation.number;
  message.status = static_cast<std::int8_t>(fixation.status);
  message.status_name = cycle::name(fixation.status);
  message.method = cycle::locate_method_names[static_cast<std::size_t>(fixation.method)];
  message.nlooks = static_cast<std::int16_t>(fixation.look_count);
  for (const cycle::FixationLook& look : std::span(fixation.looks).first(fixation.look_count))
    message.looks.push_back(to_message(look));
  if (!message.looks.empty()) {
    look_t& first = message.looks.front();
    first.noutline = static_cast<std::int32_t>(fixation.outline.count);
    for (const Eigen::Vector2f& point :
         std::span(fixation.outline.points_px).first(fixation.outline.count))
      first.outline_px.push_back(pair_of(point));
  }
  copy(fixation.report_position_m, message.report_position_m);
  message.robot_name = robot;
  fill_robot(fixation.robot, message);
  message.features_used = static_cast<std::int32_t>(fixation.features_used);
  message.features_rejected = static_cast<std::int32_t>(fixation.features_rejected);
  return message;
}

}  // namespace gazed::daemon
