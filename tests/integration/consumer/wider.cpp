// Compiles when Eigen's matrices are aligned as in gazed's libraries, whatever registers there are.
#include <Eigen/Core>

#include "agent/geometry/camera.hpp"

static_assert(alignof(Eigen::Matrix2d) == 16);
static_assert(alignof(Eigen::Matrix4d) == 16);
static_assert(alignof(gazed::geometry::CameraModel) == 16);
