#include "agent/triangulation/report_answer.hpp"

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/triangulation/methods/method.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

Eigen::Vector3d report_answer_m(const geometry::Rig& rig, const TwoLooks& looks) {
  const Eigen::Vector3d none_m = Eigen::Vector3d::Constant(not_a_number);
  const auto point_1 = geometry::normalise(rig.camera, looks.pixel_1);
  const auto point_2 = geometry::normalise(rig.camera, looks.pixel_2);
  if (!point_1 || !point_2) return none_m;
  const auto found = methods::solve(methods::Method::optimal,
                                    geometry::cam2_from_cam1(rig.head, looks.head_1, looks.head_2),
                                    *point_1, *point_2);
  if (!found) return none_m;
  const Eigen::Vector3d point_m = found->point_m();
  if (!point_m.allFinite()) return none_m;
  return geometry::cam_from_torso(rig.head, looks.head_1).inverse() * point_m;
}

}  // namespace gazed::triangulation
