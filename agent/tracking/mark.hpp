// Whether what looks like a mark on the object is another thing in front of it.
//
// In one picture, a ball in front of a board looks like a disc printed on it. In two, the ball
// moves against the board, and a print does not. What is printed on a ball moves a little, too: it
// stands out of the ball's outline by up to the radius.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/refine.hpp"
#include "agent/tracking/registration.hpp"
#include "agent/tracking/target.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

/// An object as found in view 2.
struct ObjectSeen {
  const Target& target;
  const PatchMatch& match;
  const WarpFit& fit;
  const PatchMotion& motion;
};

/// True if the mark, found in the same view 2, is nearer than anything on the object can be.
[[nodiscard]] bool is_in_front(const Target& mark, const PatchMatch& mark_seen,
                               const ObjectSeen& object, const geometry::CameraModel& camera);

}  // namespace gazed::tracking
