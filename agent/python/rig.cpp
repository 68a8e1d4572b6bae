#include "agent/geometry/rig.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>

#include "agent/base/text.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/python/module.hpp"
#include "agent/triangulation/estimate.hpp"
#include "agent/triangulation/methods/method.hpp"

namespace gazed::python {
namespace {

namespace py = pybind11;
using geometry::Rig;
using triangulation::PointEstimate;
using Angles = std::array<double, 2>;  // yaw, pitch, rad

Rig rig_of(const std::string& robot, const std::string& position) {
  if (position != "top" && position != "bottom") {
    throw std::invalid_argument("position: '" + position + "' found; allowed: top, bottom");
  }
  const auto camera =
      position == "top" ? geometry::CameraPosition::top : geometry::CameraPosition::bottom;
  const auto profile = geometry::robot_profile(robot, camera);
  if (!profile) {
    throw std::invalid_argument("robot: '" + robot +
                                "' found; allowed: " + base::listed(geometry::robot_names));
  }
  return profile->rig;
}

geometry::HeadAngles angles_of(const Angles& angles) {
  if (!std::isfinite(angles[0]) || !std::isfinite(angles[1])) {
    throw std::invalid_argument("head angles: not finite; allowed: (yaw, pitch) in radians");
  }
  return {angles[0], angles[1]};
}

Eigen::Matrix4d cam_from_torso(const Rig& rig, const Angles& head) {
  const geometry::Pose pose = geometry::cam_from_torso(rig.head, angles_of(head));
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation;
  matrix.topRightCorner<3, 1>() = pose.translation;
  return matrix;
}

std::optional<geometry::Pixel> project(const Rig& rig, const Eigen::Vector3d& point,
                                       const Angles& head) {
  return geometry::project(rig.camera, geometry::cam_from_torso(rig.head, angles_of(head)) * point);
}

PointEstimate triangulate(const Rig& rig, const Angles& head_1, const geometry::Pixel& pixel_1,
                          const Angles& head_2, const geometry::Pixel& pixel_2,
                          const std::string& method, double relative_sigma_max) {
  const auto chosen = triangulation::methods::method_of(method);
  if (!chosen) {
    throw std::invalid_argument("method: '" + method + "' found; allowed: " +
                                base::listed(triangulation::methods::method_names()));
  }
  triangulation::TwoLooks looks;
  looks.head_1 = angles_of(head_1);
  looks.head_2 = angles_of(head_2);
  looks.pixel_1 = pixel_1;
  looks.pixel_2 = pixel_2;
  triangulation::Gate gate;
  gate.relative_sigma_max = relative_sigma_max;
  return triangulation::estimate_point(rig, looks, gate, *chosen);
}

/// A property of what a Rig is made of.
template <class Part, class Field>
void add_field(py::class_<Rig>& type, const char* name, Part Rig::*part, Field Part::*field,
               const char* doc) {
  type.def_property(
      name, [=](const Rig& rig) { return rig.*part.*field; },
      [=](Rig& rig, const Field& value) { rig.*part.*field = value; }, doc);
}

void add_numbers(py::class_<Rig>& type) {
  using geometry::CameraModel, geometry::HeadGeometry, geometry::Uncertainty;
  const auto camera = [&](const char* name, auto field, const char* doc) {
    add_field(type, name, &Rig::camera, field, doc);
  };
  const auto head = [&](const char* name, auto field, const char* doc) {
    add_field(type, name, &Rig::head, field, doc);
  };
  const auto sigma = [&](const char* name, auto field, const char* doc) {
    add_field(type, name, &Rig::uncertainty, field, doc);
  };
  camera("width_px", &CameraModel::width_px, "image width");
  camera("height_px", &CameraModel::height_px, "image height");
  camera("focal_px", &CameraModel::focal_px, "fx, fy");
  camera("centre_px", &CameraModel::centre_px, "cx, cy");
  camera("distortion", &CameraModel::distortion, "k1, k2, p1, p2, k3 (Brown-Conrady, as OpenCV)");
  head("neck_offset_m", &HeadGeometry::neck_offset_m, "torso origin to joint axes, torso frame");
  head("mount_offset_m", &HeadGeometry::mount_offset_m, "joint axes to camera, head frame");
  head("mount_rotation_rad", &HeadGeometry::mount_rotation_rad, "roll, pitch, yaw");
  type.def_property(
      "zero_rad",
      [](const Rig& rig) {
        return Angles{rig.head.zero.yaw_rad, rig.head.zero.pitch_rad};
      },
      [](Rig& rig, const Angles& zero) { rig.head.zero = angles_of(zero); },
      "yaw, pitch; added to what the sensor says");
  sigma("pixel_sigma_px", &Uncertainty::pixel_sigma_px, "of an image point, per axis");
  sigma("encoder_sigma_rad", &Uncertainty::encoder_sigma_rad, "of a joint angle, per look");
  sigma("zero_sigma_rad", &Uncertainty::zero_sigma_rad, "of a joint's zero");
  sigma("focal_sigma_px", &Uncertainty::focal_sigma_px, "of the focal length");
  sigma("centre_sigma_px", &Uncertainty::centre_sigma_px, "of the principal point, per axis");
  sigma("distortion_sigma", &Uncertainty::distortion_sigma, "of k1 and k2");
  sigma("mount_offset_sigma_m", &Uncertainty::mount_offset_sigma_m, "per axis");
  sigma("mount_rotation_sigma_rad", &Uncertainty::mount_rotation_sigma_rad, "per axis");
}

void add_point(py::module_& module) {
  py::class_<PointEstimate>(module, "Point", "A point and how sure it is; NaN: no such number.")
      .def_property_readonly(
          "status",
          [](const PointEstimate& p) { return std::string(triangulation::name(p.status)); },
          "LOCATED, UNCERTAIN, TARGET_LOST, DEGENERATE, BEHIND_CAMERA or INVALID_INPUT")
      .def_readonly("reason", &PointEstimate::reason, "in words, with the numbers that decided")
      .def_readonly("position_m", &PointEstimate::torso_point_m, "torso frame")
      .def_readonly("covariance_m2", &PointEstimate::torso_covariance_m2, "torso frame, 3 x 3")
      .def_readonly("camera_position_m", &PointEstimate::point_m, "camera 1's optical frame")
      .def_readonly("camera_covariance_m2", &PointEstimate::covariance_m2, "the same, 3 x 3")
      .def_readonly("range_m", &PointEstimate::range_m)
      .def_readonly("range_sigma_m", &PointEstimate::range_sigma_m)
      .def_readonly("inverse_range_per_m", &PointEstimate::inverse_range_per_m)
      .def_readonly("inverse_range_sigma_per_m", &PointEstimate::inverse_range_sigma_per_m)
      .def_readonly("parallax_rad", &PointEstimate::parallax_rad)
      .def_readonly("residual_px", &PointEstimate::residual_px)
      .def("__repr__", [](const PointEstimate& p) {
        return "<gazed.Point " + std::string(triangulation::name(p.status)) +
               (p.reason.empty() ? "" : ": " + p.reason) + ">";
      });
}

}  // namespace

void add_rig(py::module_& module) {
  add_point(module);
  py::class_<Rig> type(module, "Rig",
                       "A camera in a head that turns, and how well both are known.");
  type.def(py::init(&rig_of), py::arg("robot") = "nao-v6", py::arg("position") = "top",
           "A robot that nobody calibrated: nao-v3 to nao-v6; its top or bottom camera.");
  add_numbers(type);
  type.def("cam_from_torso", &cam_from_torso, py::arg("head_rad"),
           "4 x 4: maps torso coordinates to the camera's, at (yaw, pitch).");
  type.def("project", &project, py::arg("point_m"), py::arg("head_rad"),
           "The pixel of a point of the torso frame; None behind the camera.");
  type.def(
      "triangulate", &triangulate, py::arg("head_1_rad"), py::arg("pixel_1"), py::arg("head_2_rad"),
      py::arg("pixel_2"), py::arg("method") = "optimal",
      py::arg("relative_sigma_max") = triangulation::Gate{}.relative_sigma_max,
      "Where the point is that was seen at pixel_1 with the head at head_1_rad, and at pixel_2 "
      "with it at head_2_rad.");
}

}  // namespace gazed::python
