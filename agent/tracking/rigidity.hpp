// Decides which of the points followed between two views stood still: those whose motion a single
// turn of the head explains.
#pragma once

#include <Eigen/Core>
#include <span>

#include "agent/geometry/head.hpp"

namespace gazed::tracking {

/// A point seen in both views, normalised coordinates.
struct PointPair {
  Eigen::Vector2d normalised_1 = Eigen::Vector2d::Zero();
  Eigen::Vector2d normalised_2 = Eigen::Vector2d::Zero();
  double sigma = 0.0;  // of normalised_2, per axis
  bool rigid = true;
};

/// Corrects the angles between the looks (three unknowns, prior `angle_sigma_rad` each) so that
/// most pairs lie on their epipolar lines, by iteratively reweighted least squares. Then sets
/// `rigid` of every pair: false if its distance from the line exceeds what noise and the other
/// pairs explain. Depths are free. Does nothing if there are too few pairs or no baseline. Pairs
/// that are not rigid are moving objects, wrong matches, and crossings of a near outline with a far
/// edge, which no patch comparison tells from corners.
void mark_rigid(const geometry::HeadGeometry& head, geometry::HeadAngles look_1,
                geometry::HeadAngles look_2, double angle_sigma_rad, std::span<PointPair> pairs);

}  // namespace gazed::tracking
