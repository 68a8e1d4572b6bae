// A target: what is remembered of an object in view 1, and what later views tell of its shape.
#pragma once

#include <Eigen/Core>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/tracking/ball.hpp"
#include "agent/tracking/matcher.hpp"
#include "agent/tracking/object.hpp"
#include "agent/tracking/patch.hpp"
#include "agent/tracking/slopes.hpp"

namespace gazed::tracking {

struct Target {
  ObjectMask object;
  Patch patch;
  Eigen::Vector2d reference = Eigen::Vector2d::Zero();  // of the patch, normalised
  BelievedSlopes slopes;
  BelievedBall ball;

  /// Takes the patch around what `object` holds. Returns why it cannot be found again; empty if it
  /// can. `matcher` lends the memory of a full-size plane.
  [[nodiscard]] const char* take_object(const base::ImageView& image,
                                        const geometry::CameraModel& camera, PatchMatcher& matcher);

  /// Takes a square of texture around `centre`, clipped to the frame; returns as above.
  [[nodiscard]] const char* take_square(const base::ImageView& image,
                                        const geometry::CameraModel& camera, PatchMatcher& matcher,
                                        const geometry::Pixel& centre, int half_size_px);

 private:
  const char* take_patch(const base::ImageView& image, const geometry::CameraModel& camera,
                         PatchMatcher& matcher, const geometry::Pixel& centre, double half_size_px,
                         double margin_px);
};

}  // namespace gazed::tracking
