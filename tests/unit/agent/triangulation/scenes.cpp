#include "scenes.hpp"

#include <stdexcept>

#include "agent/geometry/cholesky.hpp"

namespace gazed::triangulation {

TwoLooks Scene::looks() const {
  return {.head_1 = head_1,
          .head_2 = head_2,
          .pixel_1 = look(head_1).pixel,
          .pixel_2 = look(head_2).pixel};
}

all_looks::Look Scene::look(geometry::HeadAngles angles) const {
  return {.head = angles,
          .pixel = geometry::project(camera, geometry::cam_from_torso(head, angles) * torso_point_m)
                       .value()};
}

double Scene::inverse_range_per_m() const {
  return 1.0 / (geometry::cam_from_torso(head, head_1) * torso_point_m).norm();
}

/// The top camera of the V4 and later at the report's focal length.
Scene report_scene() {
  Scene scene;
  scene.head.mount_offset_m = {0.05871, 0.0, 0.06364};
  scene.camera.focal_px = {752.0, 752.0};
  scene.camera.centre_px = {331.0, 253.0};
  return scene;
}

/// A move on both axes, as the step rule makes it, at a point off the centre of both views.
Scene step_rule_scene() {
  Scene scene = report_scene();
  scene.head.neck_offset_m = {0.0, 0.0, 0.1265};
  scene.head.mount_rotation_rad = {0.0, 0.0209, 0.0};
  scene.camera.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  scene.head_1 = {0.1, 0.1};
  scene.head_2 = {-0.3, 0.4};
  scene.torso_point_m = {0.55, -0.05, 0.1};
  return scene;
}

void PrintTo(const ErrorModel& model, std::ostream* stream) {
  *stream << model.name;
}

std::vector<ErrorModel> every_source_and_all() {
  std::vector<ErrorModel> out(9);
  out[0].name = "Pixels";
  out[0].uncertainty.pixel_sigma_px = 0.7;
  out[1].name = "Registration";
  out[1].pixel_2_covariance_px2 << 1.0, 0.5, 0.5, 0.6;
  out[2].name = "Encoders";
  out[2].uncertainty.encoder_sigma_rad = 1.5e-3;
  out[3].name = "Zero";
  out[3].uncertainty.zero_sigma_rad = 3e-3;
  out[4].name = "FocalLength";
  out[4].uncertainty.focal_sigma_px = 10.0;
  out[5].name = "Centre";
  out[5].uncertainty.centre_sigma_px = 2.0;
  out[6].name = "MountOffset";
  out[6].uncertainty.mount_offset_sigma_m = 2e-3;
  out[7].name = "MountRotation";
  out[7].uncertainty.mount_rotation_sigma_rad = 10e-3;
  out[8].name = "All";
  out[8].uncertainty = {.pixel_sigma_px = 0.3,
                        .encoder_sigma_rad = 1e-3,
                        .zero_sigma_rad = 5e-3,
                        .focal_sigma_px = 5.0,
                        .centre_sigma_px = 4.0,
                        .mount_offset_sigma_m = 2e-3,
                        .mount_rotation_sigma_rad = 10e-3};
  out[8].pixel_2_covariance_px2 << 0.2, 0.05, 0.05, 0.1;
  return out;
}

BelievedRobot believed_robot(const Scene& scene, const geometry::Uncertainty& uncertainty,
                             Random& random) {
  BelievedRobot robot{scene.head, scene.camera};
  robot.head.zero = robot.head.zero + random_angles(uncertainty.zero_sigma_rad, random);
  robot.head.mount_offset_m += uncertainty.mount_offset_sigma_m * random.normal_3();
  robot.head.mount_rotation_rad += uncertainty.mount_rotation_sigma_rad * random.normal_3();
  robot.camera.focal_px.array() += uncertainty.focal_sigma_px * random.normal();
  robot.camera.centre_px += uncertainty.centre_sigma_px * random.normal_2();
  return robot;
}

all_looks::Look measured_look(const all_looks::Look& truth,
                              const geometry::Uncertainty& uncertainty,
                              const Eigen::Matrix2d& registration_px2, Random& random) {
  all_looks::Look look{truth.head + random_angles(uncertainty.encoder_sigma_rad, random),
                       truth.pixel, registration_px2};
  look.pixel += uncertainty.pixel_sigma_px * random.normal_2();
  if (!registration_px2.isZero()) {
    Eigen::Matrix2d root = registration_px2;
    if (!geometry::factorise(root)) throw std::invalid_argument("no covariance");
    root(0, 1) = 0.0;
    look.pixel += root * random.normal_2();
  }
  return look;
}

PointEstimate estimate_with_errors(const Scene& scene, const ErrorModel& model, const Gate& gate,
                                   methods::Method method, Random& random) {
  const BelievedRobot robot = believed_robot(scene, model.uncertainty, random);
  const all_looks::Look first =
      measured_look(scene.look(scene.head_1), model.uncertainty, Eigen::Matrix2d::Zero(), random);
  const all_looks::Look second = measured_look(scene.look(scene.head_2), model.uncertainty,
                                               model.pixel_2_covariance_px2, random);
  const TwoLooks looks{first.head, second.head, first.pixel, second.pixel, second.covariance_px2};
  return estimate_point(robot.head, robot.camera, model.uncertainty, looks, gate, method);
}

}  // namespace gazed::triangulation
