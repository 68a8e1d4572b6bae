// The viewing rays of a saliency map's samples.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "agent/geometry/camera.hpp"

namespace gazed::saliency {

/// One ray for each sample of the map of the camera's frames, row by row: optical frame, length 1;
/// NaN where the lens distortion cannot be inverted.
[[nodiscard]] std::vector<Eigen::Vector3d> rays_of_map(const geometry::CameraModel& camera);

}  // namespace gazed::saliency
