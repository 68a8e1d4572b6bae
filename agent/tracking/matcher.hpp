// Finds the patch in view 2, from the search on reduced images down to full resolution.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "agent/tracking/object.hpp"
#include "agent/tracking/patch.hpp"
#include "agent/tracking/plane.hpp"
#include "agent/tracking/refine.hpp"
#include "agent/tracking/search.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

class PatchMatcher {
 public:
  /// The best fit at full resolution and where it puts the reference point, or the reason why there
  /// is none.
  struct Outcome {
    std::optional<WarpFit> fit;
    geometry::Pixel pixel_2 = geometry::Pixel::Zero();
    std::string reason;
  };

  /// Allocates for a camera's images.
  void reserve(const geometry::CameraModel& camera);

  /// Lends out, or takes back, the memory of view 2's full resolution, which run() does not need
  /// between calls; view 1 uses it when the patch is chosen.
  void swap_full(PlanePyramid& planes) noexcept { planes_2_.swap_full(planes); }

  /// Searches within margin_px of `segment`. Refuses when nothing resembles the patch and when two
  /// places do; the caller judges how good the match is.
  Outcome run(const base::ImageView& image_2, const Patch& patch, const ObjectMask& object,
              const PatchMotion& motion, const geometry::CameraModel& camera,
              const EpipolarSegment& segment, double margin_px);

  /// Where the samples of the patch's level 0 lie in view 2 after a match; NaN if outside.
  [[nodiscard]] std::span<const geometry::Pixel> pixels_2() const { return refinement_.pixels_2(); }

 private:
  struct Problem {
    const Patch& patch;
    const PatchMotion& motion;
    const geometry::CameraModel& camera;
    const EpipolarSegment& segment;
  };
  struct Place {
    WarpFit fit;
    geometry::Pixel pixel = geometry::Pixel::Zero();
  };

  void build_planes(const base::ImageView& image_2, const Problem& problem, double margin_px,
                    int levels);
  [[nodiscard]] Place refine(const Problem& problem, int level, const Place& start);
  [[nodiscard]] Place refine_to_full(const Problem& problem, int from_level, Place place);

  PlanePyramid planes_2_;
  PatchSearch search_;
  WarpRefinement refinement_;
};

}  // namespace gazed::tracking
