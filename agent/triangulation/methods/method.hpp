// One function for all triangulation methods (agent/triangulation/README.md).
//
// All image points are normalised: on the plane z = 1, distortion undone. Lengths in metres.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/triangulation/methods/linear_mmse.hpp"

namespace gazed::triangulation::methods {

enum class Method {
  optimal,        // least summed squared image error, for every input (optimal.hpp)
  rectification,  // disparity of rectified views (rectification.hpp)
  linear_mmse,    // with a prior on the point's position (linear_mmse.hpp)
  lindstrom,      // optimal in two iterations, checked (lindstrom.hpp)
};
inline constexpr std::array all_methods{Method::optimal, Method::rectification, Method::linear_mmse,
                                        Method::lindstrom};

/// "optimal", "rectification", "linear-mmse", "lindstrom".
[[nodiscard]] std::string_view name(Method method);
/// The names of all methods.
[[nodiscard]] std::vector<std::string_view> method_names();

/// None if no method has this name.
[[nodiscard]] std::optional<Method> method_of(std::string_view text);

/// Triangulates one correspondence, without checks or allocation. `mmse` is used by linear MMSE
/// alone. None if the method has no answer: zero baseline, a point at its epipole (optimal and
/// Lindstrom's), a baseline along the optical axis (rectification), or anything that is not finite.
/// The answer may be at infinity or behind a camera.
[[nodiscard]] std::optional<geometry::InverseDepthPoint> solve(Method method,
                                                               const geometry::Pose& cam2_from_cam1,
                                                               const Eigen::Vector2d& point_1,
                                                               const Eigen::Vector2d& point_2,
                                                               const MmseModel& mmse = {});

}  // namespace gazed::triangulation::methods
