#include "agent/tracking/target.hpp"

#include <algorithm>

namespace gazed::tracking {

namespace {

// How far the patch extends beyond the object's outline: the blurred edge, a little of the
// background, and the error of the outline itself.
constexpr double outline_margin_px = 3.0;
constexpr double outline_error_cells = 1.5;
// Distance of the reference point from the frame's border.
constexpr double reference_border_px = 3.0;

// A patch must promise a position to this sigma in both directions, with this camera noise: an arc
// of an outline would slide along itself.
constexpr double predicted_sigma_max_px = 0.1;
// A patch that is this much less certain in one direction is an edge; what remains is its pixel
// steps.
constexpr double along_by_across_max = 20.0;
constexpr double camera_noise_levels = 3.0;

}  // namespace

const char* Target::take_object(const base::ImageView& image, const geometry::CameraModel& camera,
                                PatchMatcher& matcher) {
  const geometry::Pixel centre = object.interior_point();
  const double margin_px = outline_margin_px + outline_error_cells * object.cell_px();
  return take_patch(image, camera, matcher, centre, object.half_size_px(centre) + margin_px,
                    margin_px);
}

const char* Target::take_square(const base::ImageView& image, const geometry::CameraModel& camera,
                                PatchMatcher& matcher, const geometry::Pixel& centre,
                                int half_size_px) {
  object.take_square(image, centre, half_size_px);
  return take_patch(image, camera, matcher, centre, half_size_px, 0.0);
}

const char* Target::take_patch(const base::ImageView& image, const geometry::CameraModel& camera,
                               PatchMatcher& matcher, const geometry::Pixel& centre,
                               double half_size_px, double margin_px) {
  const auto normalised = geometry::normalise(camera, centre);
  if (!camera.contains(centre, reference_border_px) || !normalised) {
    return "its middle is at the frame's border";
  }
  reference = *normalised;
  patch.reference_px = centre;
  patch.half_size_px = std::clamp(half_size_px, patch_half_size_min_px, patch_half_size_max_px);
  patch.margin_px = margin_px;
  matcher.swap_full(patch.planes);
  const bool sampled = sample_patch(image, camera, object, patch);
  matcher.swap_full(patch.planes);
  if (!sampled) return "nothing there has any structure";
  const PredictedSigma sigma = predicted_sigma(patch, camera_noise_levels);
  if (!(sigma.across_px < predicted_sigma_max_px)) {
    return "nothing there has structure enough to be found again";
  }
  if (!(sigma.along_px < std::min(predicted_sigma_max_px, along_by_across_max * sigma.across_px))) {
    return "what is there has structure in one direction only: it could be anywhere along an edge";
  }
  slopes.clear();
  ball.begin(patch.relief);
  return "";
}

}  // namespace gazed::tracking
