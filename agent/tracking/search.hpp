// Normalised cross-correlation on reduced images, over the places in view 2 that the head's angles
// and the range bounds allow.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "agent/tracking/patch.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

struct SearchCandidate {
  geometry::Pixel pixel = geometry::Pixel::Zero();
  double correlation = 0.0;
};

class PatchSearch {
 public:
  static constexpr int max_candidates = 4;

  void reserve(int width_px, int height_px);

  /// Finds candidates in `plane_2`, a level of view 2 with the step of patch level `level`.
  /// Candidates are peaks of the correlation with the patch as the rotated camera would see it,
  /// within margin_px of the segment and inside the frame. Best first, no two closer than
  /// separation_px. Returns how many were found.
  int run(const Patch& patch, int level, const ObjectMask& object, const PatchMotion& motion,
          const geometry::CameraModel& camera, const EpipolarSegment& segment, double margin_px,
          double separation_px, const PlaneLevel& plane_2);

  [[nodiscard]] const SearchCandidate& candidate(int i) const {
    return candidates_[static_cast<std::size_t>(i)];
  }

 private:
  struct TemplateSample {
    int dx, dy;
    float value;
  };

  bool make_template(const Patch& patch, int level, const ObjectMask& object,
                     const PatchMotion& motion, const geometry::CameraModel& camera,
                     double inverse_depth);
  void correlate(const PlaneLevel& plane, int x_begin, int y_begin, int width, int height);
  [[nodiscard]] bool is_peak(int x, int y, int width, int height) const;
  void add_candidate(const SearchCandidate& candidate, double separation_px);

  std::vector<TemplateSample> template_;
  std::vector<float> scores_, products_, sums_, squares_;
  std::array<SearchCandidate, max_candidates> candidates_;
  int found_ = 0;
};

}  // namespace gazed::tracking
