// Where the samples of a saliency map look.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "agent/geometry/camera.hpp"

namespace gazed::saliency {

/// One for each sample of the map of the camera's frames, row by row: optical frame, length 1; not
/// a number where the lens cannot be undone.
[[nodiscard]] std::vector<Eigen::Vector3d> rays_of_map(const geometry::CameraModel& camera);

}  // namespace gazed::saliency
