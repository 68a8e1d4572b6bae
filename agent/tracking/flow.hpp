// A small square patch of one view found in another to sub-pixel: translation, gain and bias by
// the inverse compositional algorithm (Baker and Matthews, IJCV 56(3), 2004), the patch brought
// into the second view's geometry beforehand.
//
// Both views are read by the cubic B-spline of their samples, as plane.hpp reads. Patches have an
// even side: sample (i, j) lies at (i, j) - (side - 1)/2 from the centre.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "agent/tracking/luma.hpp"

namespace gazed::tracking {

/// A patch of `side` x `side` samples, mean removed, grey levels.
template <int side>
struct FlowTemplate {
  static constexpr std::size_t area = static_cast<std::size_t>(side * side);

  std::array<float, area> value;
  // Slopes, less what a change of bias or gain does too.
  std::array<float, area> slope_x, slope_y;
  float energy = 0.0F;                                    // sum of value^2
  Eigen::Matrix2f information = Eigen::Matrix2f::Zero();  // sum of slope slope^T
};

/// Where the patch was found.
struct Flow {
  Eigen::Vector2f at = Eigen::Vector2f::Zero();  // samples of the level
  float correlation = 0.0F;                      // normalised
  float misfit = 0.0F;    // variance of what gain and bias leave, grey levels of the patch
  float variance = 0.0F;  // of a coordinate, samples^2, mean of both; as if residuals were white
};

/// The patch around `centre` (samples of `level`) as it looks in another view: `from_other` maps
/// offsets in the other view to offsets in this one. None where it reaches over the border or has
/// no structure in one direction.
template <int side>
[[nodiscard]] bool make_template(const LumaLevel& level, const Eigen::Vector2f& centre,
                                 const Eigen::Matrix2f& from_other, FlowTemplate<side>& out);

/// Finds the patch near `start`, at most `reach` away from it. None when it leaves that or the
/// level, or does not converge.
template <int side>
[[nodiscard]] std::optional<Flow> find_patch(const FlowTemplate<side>& patch,
                                             const LumaLevel& level, const Eigen::Vector2f& start,
                                             float reach);

/// Reads side x side samples, `step` of this level's offsets for one of the patch's columns and
/// rows. False where it reaches over the border.
template <int side>
[[nodiscard]] bool read_warped(const LumaLevel& level, const Eigen::Vector2f& centre,
                               const Eigen::Matrix2f& step, float* out);

}  // namespace gazed::tracking
