// The methods that find the point which two image points show, behind one call
// (agent/triangulation/README.md).
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
  linear_mmse,    // with a prior of where the point is (linear_mmse.hpp)
  lindstrom,      // optimal in two iterations, checked (lindstrom.hpp)
};
inline constexpr std::array all_methods{Method::optimal, Method::rectification, Method::linear_mmse,
                                        Method::lindstrom};

/// "optimal", "rectification", "linear-mmse", "lindstrom".
[[nodiscard]] std::string_view name(Method method);
/// Of all methods.
[[nodiscard]] std::vector<std::string_view> method_names();

/// None for a name that no method has.
[[nodiscard]] std::optional<Method> method_of(std::string_view text);

/// Triangulates one correspondence: nothing is checked, judged or allocated. `mmse` is for linear
/// MMSE alone. None where the method has no answer: zero baseline, a point at its epipole (optimal
/// and Lindstrom's), the baseline along the optical axis (rectification), what is not finite. An
/// answer may be at infinity or behind a camera.
[[nodiscard]] std::optional<geometry::InverseDepthPoint> solve(Method method,
                                                               const geometry::Pose& cam2_from_cam1,
                                                               const Eigen::Vector2d& point_1,
                                                               const Eigen::Vector2d& point_2,
                                                               const MmseModel& mmse = {});

}  // namespace gazed::triangulation::methods
