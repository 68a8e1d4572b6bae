#include "agent/saliency/map_rays.hpp"

#include <Eigen/Geometry>
#include <limits>

#include "agent/saliency/pyramid.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

namespace {

// A comparison with NaN is false, so nothing is near such a ray.
const Eigen::Vector3d no_ray = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

}  // namespace

std::vector<Eigen::Vector3d> rays_of_map(const geometry::CameraModel& camera) {
  std::vector<Eigen::Vector3d> rays;
  const int width = length_at_level(camera.width_px, map_level);
  const int height = length_at_level(camera.height_px, map_level);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto point = geometry::normalise(camera, saliency_cell_px * geometry::Pixel(x, y));
      rays.push_back(point ? Eigen::Vector3d(point->homogeneous().normalized()) : no_ray);
    }
  }
  return rays;
}

}  // namespace gazed::saliency
