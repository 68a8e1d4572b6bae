// Registers a small square patch of one view in another to sub-pixel: translation, gain and bias by
// the inverse compositional algorithm (Baker and Matthews, IJCV 56(3), 2004). The patch is warped
// into the second view's geometry beforehand.
//
// Both views are read through the cubic B-spline of their samples, as in plane.hpp. Patches have an
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
  // Slopes, without the part that a change of bias or gain would explain.
  std::array<float, area> slope_x, slope_y;
  float energy = 0.0F;                                    // sum of value^2
  Eigen::Matrix2f information = Eigen::Matrix2f::Zero();  // sum of slope slope^T
};

/// Where the patch was found.
struct Flow {
  Eigen::Vector2f at = Eigen::Vector2f::Zero();  // samples of the level
  float correlation = 0.0F;                      // normalised
  // variance that gain and bias do not explain, grey levels of the patch squared
  float misfit = 0.0F;
  // of one coordinate, samples^2, mean of both axes; assumes white residuals
  float variance = 0.0F;
};

/// The patch around `centre` (samples of `level`) as another view shows it: `from_other` maps
/// offsets in the other view to offsets in this one. None if it reaches beyond the border or lacks
/// structure in one direction.
template <int side>
[[nodiscard]] bool make_template(const LumaLevel& level, const Eigen::Vector2f& centre,
                                 const Eigen::Matrix2f& from_other, FlowTemplate<side>& out);

/// Finds the patch near `start`, at most `reach` away. None if it leaves that range or the level,
/// or does not converge.
template <int side>
[[nodiscard]] std::optional<Flow> find_patch(const FlowTemplate<side>& patch,
                                             const LumaLevel& level, const Eigen::Vector2f& start,
                                             float reach);

/// Reads side x side samples; the columns of `step` are one step along the patch's rows and
/// columns, in this level's samples. False if it reaches beyond the border.
template <int side>
[[nodiscard]] bool read_warped(const LumaLevel& level, const Eigen::Vector2f& centre,
                               const Eigen::Matrix2f& step, float* out);

}  // namespace gazed::tracking
