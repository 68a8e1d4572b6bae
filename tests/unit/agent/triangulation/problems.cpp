#include "problems.hpp"

#include <Eigen/Geometry>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::triangulation {

using Eigen::Vector3d;

std::string geometry_name(Geometry geometry) {
  switch (geometry) {
    case Geometry::head_turn:
      return "HeadTurn";
    case Geometry::forward:
      return "ForwardWithTheEpipoleInView";
    case Geometry::general:
      return "General";
    case Geometry::noisy:
      break;
  }
  return "EightPixelNoise";
}

geometry::Pose random_pose(Geometry geometry, Random& random) {
  const auto angle = [&](double most) { return random.uniform(-most, most); };
  if (geometry == Geometry::head_turn || geometry == Geometry::noisy) {
    geometry::HeadGeometry head;
    head.mount_offset_m = {0.05871, 0.0, 0.06364};
    const geometry::HeadAngles first{angle(1.0), angle(0.4)};
    return geometry::cam2_from_cam1(head, first,
                                    first + geometry::HeadAngles{angle(0.7), angle(0.4)});
  }
  const Eigen::Matrix3d rotation =
      geometry::about_x(angle(0.3)) * geometry::about_y(angle(0.3)) * geometry::about_z(angle(0.3));
  if (geometry == Geometry::forward) {
    return {geometry::about_x(angle(0.02)) * geometry::about_y(angle(0.02)),
            Vector3d(angle(0.01), angle(0.01), -random.uniform(0.05, 0.2))};
  }
  return {rotation, Vector3d(angle(0.3), angle(0.3), angle(0.3))};
}

Problem random_problem(Geometry geometry, Random& random) {
  const double noise = (geometry == Geometry::noisy ? 8.0 : 1.0) / problem_focal_px;
  for (;;) {
    const geometry::Pose pose = random_pose(geometry, random);
    const double depth_m = random.uniform(0.25, 3.0);
    const Vector3d x1(depth_m * random.uniform(-0.4, 0.4), depth_m * random.uniform(-0.3, 0.3),
                      depth_m);
    const Vector3d x2 = pose * x1;
    if (x2.z() < 0.05 || pose.translation.norm() < 1e-3) continue;
    return {pose, x1.hnormalized() + noise * random.normal_2(),
            x2.hnormalized() + noise * random.normal_2()};
  }
}

}  // namespace gazed::triangulation
