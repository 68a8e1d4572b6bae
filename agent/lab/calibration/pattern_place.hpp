// A first guess of where a pattern stands, from all looks at it together.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "agent/geometry/pose.hpp"
#include "agent/lab/calibration/bundle.hpp"

namespace gazed::lab::calibration {

/// The pose that maps pattern coordinates to those of the neck, as if all pictures were taken from
/// one place by a perfect head: a perspective-n-point problem (Terzakis and Lourakis 2020). None
/// when the points determine none.
[[nodiscard]] std::optional<geometry::Pose> first_pattern_place(
    const HeadModel& model, std::span<const geometry::HeadAngles> looks,
    std::span<const PointSighting> sightings, std::span<const Eigen::Vector3d> pattern_m);

/// The direction of a pixel from the neck, unit length; none when the lens has no ray there.
[[nodiscard]] std::optional<Eigen::Vector3d> direction_in_neck(const HeadModel& model,
                                                               geometry::HeadAngles measured,
                                                               const geometry::Pixel& pixel);

}  // namespace gazed::lab::calibration
