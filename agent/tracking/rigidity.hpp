// Which of the points followed between two views stood still: those whose image points the turn of
// one head can explain.
#pragma once

#include <Eigen/Core>
#include <span>

#include "agent/geometry/head.hpp"

namespace gazed::tracking {

/// A point seen twice, normalised coordinates.
struct PointPair {
  Eigen::Vector2d normalised_1 = Eigen::Vector2d::Zero();
  Eigen::Vector2d normalised_2 = Eigen::Vector2d::Zero();
  double sigma = 0.0;  // of normalised_2, per axis
  bool rigid = true;
};

/// Corrects the angles between the looks, three unknowns, so that most pairs lie on their epipolar
/// lines (iteratively reweighted least squares, prior `angle_sigma_rad` for each), then sets
/// `rigid` of every pair: false where the distance to the line is more than noise and what most
/// pairs have explain. Depths are free. Pairs stay as they are when they are too few or the looks
/// stand at one place. Such pairs are moving things, wrong matches, and crossings of a near outline
/// with a far edge, which no patch comparison tells from corners.
void mark_rigid(const geometry::HeadGeometry& head, geometry::HeadAngles look_1,
                geometry::HeadAngles look_2, double angle_sigma_rad, std::span<PointPair> pairs);

}  // namespace gazed::tracking
