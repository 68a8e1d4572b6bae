#include "agent/lab/analysis/setup.hpp"

#include <Eigen/Geometry>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::lab::analysis {

namespace {

/// Element `i` of errors that may be none.
double at(std::span<const double> errors, std::size_t i) {
  return i < errors.size() ? errors[i] : 0.0;
}

// Table 3.2: focal distance 752, centre [331 253], rotation 0.5 rad, translation [28 29 -24] mm.
constexpr double report_angle_rad = 0.5;

Eigen::Vector3d report_translation_m(std::span<const double> errors_m) {
  return {0.028 + at(errors_m, 0), 0.029 + at(errors_m, 1), -0.024 + at(errors_m, 2)};
}

geometry::Pose report_pose(std::span<const double> rotation_rad,
                           std::span<const double> translation_m) {
  return {geometry::about_y(-report_angle_rad + at(rotation_rad, 0)) *
              geometry::about_x(report_angle_rad + at(rotation_rad, 1)),
          report_translation_m(translation_m)};
}

geometry::Pose report_yaw_pose(std::span<const double> rotation_rad,
                               std::span<const double> translation_m) {
  return {geometry::about_y(report_angle_rad + at(rotation_rad, 0)) *
              geometry::about_x(-report_angle_rad),
          report_translation_m(translation_m)};
}

geometry::Pose nao_pose(std::span<const double> rotation_rad,
                        std::span<const double> translation_m) {
  geometry::HeadGeometry head = geometry::robot_profile("nao-v6")->rig.head;
  for (Eigen::Index i = 0; i < 3; ++i) {
    head.mount_offset_m[i] += at(translation_m, static_cast<std::size_t>(i));
  }
  return geometry::cam2_from_cam1(
      head, nao_look_1 + geometry::HeadAngles{at(rotation_rad, 0), at(rotation_rad, 1)},
      nao_look_2 + geometry::HeadAngles{at(rotation_rad, 2), at(rotation_rad, 3)});
}

/// Table 3.2 for `angles` of the rotation.
TwoViewSetup report_setup(std::size_t angles) {
  TwoViewSetup setup;
  setup.focal_px = {752.0, 752.0};
  setup.centre_px = {331.0, 253.0};
  setup.error_sizes = {{{1, 2.0}, {2, 1.6}, {angles, 0.01}, {3, 0.0013}, {4, 0.12}}};
  return setup;
}

TwoViewSetup nao_setup() {
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  const geometry::Uncertainty& sigma = rig.uncertainty;
  TwoViewSetup setup{.name = "nao-v6",
                     .description =
                         "head (yaw, pitch) from (0, 0) to (-0.35, 0.1) rad, f 608 px; rotation: "
                         "encoders of both looks, translation: mount offset",
                     .focal_px = rig.camera.focal_px,
                     .centre_px = rig.camera.centre_px,
                     .error_sizes = {},
                     .cam2_from_cam1 = nao_pose};
  setup.error_sizes = {{{1, sigma.focal_sigma_px},
                        {2, sigma.centre_sigma_px},
                        {4, sigma.encoder_sigma_rad},
                        {3, sigma.mount_offset_sigma_m},
                        {4, sigma.pixel_sigma_px}}};
  return setup;
}

}  // namespace

std::string_view name(Parameter parameter) {
  switch (parameter) {
    case Parameter::focal:
      return "focal";
    case Parameter::centre:
      return "centre";
    case Parameter::rotation:
      return "rotation";
    case Parameter::translation:
      return "translation";
    case Parameter::point:
      break;
  }
  return "point";
}

ShownUnit shown_unit(Parameter parameter) {
  if (parameter == Parameter::rotation) return {"rad"};
  if (parameter == Parameter::translation) return {"mm", 1000.0};
  return {"px"};
}

std::vector<TwoViewSetup> all_setups() {
  TwoViewSetup report = report_setup(2);
  report.name = "report";
  report.description = "R = Ry(-0.5) Rx(0.5), t = [28 29 -24] mm, f 752 px; rotation: both angles";
  report.cam2_from_cam1 = report_pose;
  TwoViewSetup report_yaw = report_setup(1);
  report_yaw.name = "report-yaw";
  report_yaw.description = "R = Ry(0.5) Rx(-0.5), t = [28 29 -24] mm, f 752 px; rotation: the yaw";
  report_yaw.cam2_from_cam1 = report_yaw_pose;
  return {report, report_yaw, nao_setup()};
}

triangulation::ErrorSources error_sources(const TwoViewSetup& setup,
                                          const triangulation::TwoViews& views) {
  constexpr double step = 1e-6;  // rad or m: half of the digits, for a central difference
  triangulation::ErrorSources sources;
  triangulation::add_camera_errors(views, setup.error_size(Parameter::focal).sigma,
                                   setup.error_size(Parameter::centre).sigma, sources);
  for (const Parameter parameter : {Parameter::rotation, Parameter::translation}) {
    const ErrorSize size = setup.error_size(parameter);
    for (std::size_t i = 0; i < size.elements; ++i) {
      const auto pose = [&](double error) {
        std::array<double, most_elements> errors{};
        errors.at(i) = error;
        return parameter == Parameter::rotation ? setup.cam2_from_cam1(errors, {})
                                                : setup.cam2_from_cam1({}, errors);
      };
      const geometry::Pose more = pose(step), less = pose(-step);
      const double steps = size.sigma / (2.0 * step);
      const Eigen::Matrix3d turn = steps * (more.rotation * less.rotation.transpose());
      triangulation::ErrorSource source;
      source.cam2_from_cam1 = {
          .rotation_rad = 0.5 * Eigen::Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0),
                                                turn(1, 0) - turn(0, 1)),
          .translation_m = steps * (more.translation - less.translation)};
      sources.add(source);
    }
  }
  return sources;
}

std::span<const Eigen::Vector3d> scene_points_m() {
  static const std::array<Eigen::Vector3d, 5> points{
      {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.3}, {0.0, -0.025, 0.3}, {0.04, 0.04, 0.75}, {0.25, 0.0, 1.5}}};
  return points;
}

Belief truth(const TwoViewSetup& setup, const Eigen::Vector3d& point_m) {
  Belief belief{.focal_px = setup.focal_px,
                .centre_px = setup.centre_px,
                .cam2_from_cam1 = setup.cam2_from_cam1({}, {}),
                .pixel_1 = {},
                .pixel_2 = {}};
  belief.pixel_1 = belief.pixel(point_m.hnormalized());
  belief.pixel_2 = belief.pixel((belief.cam2_from_cam1 * point_m).hnormalized());
  return belief;
}

Belief with_errors(const TwoViewSetup& setup, const Belief& truth, Parameter parameter,
                   std::span<const double> errors) {
  Belief belief = truth;
  switch (parameter) {
    case Parameter::focal:
      belief.focal_px.array() += errors[0];
      break;
    case Parameter::centre:
      belief.centre_px += Eigen::Vector2d(errors[0], errors[1]);
      break;
    case Parameter::rotation:
      belief.cam2_from_cam1 = setup.cam2_from_cam1(errors, {});
      break;
    case Parameter::translation:
      belief.cam2_from_cam1 = setup.cam2_from_cam1({}, errors);
      break;
    case Parameter::point:
      belief.pixel_1 += geometry::Pixel(errors[0], errors[1]);
      belief.pixel_2 += geometry::Pixel(errors[2], errors[3]);
      break;
  }
  return belief;
}

}  // namespace gazed::lab::analysis
