// Finds the same object point in a second view, to sub-pixel. The rotation is undone by K R K^-1;
// the patch is searched along the epipolar line within the range bounds; then position, scale, the
// surface's slopes, gain and bias are fitted by least squares (Lucas and Kanade 1981, with the warp
// of a plane).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/geometry/view.hpp"
#include "agent/tracking/outline.hpp"
#include "agent/tracking/settings.hpp"

namespace gazed::tracking {

/// Where view 1's point is in view 2.
struct PatchMatch {
  geometry::Pixel pixel_1 = geometry::Pixel::Zero();  // the chosen one, or mark()'s
  geometry::Pixel pixel_2 = geometry::Pixel::Zero();  // with lens distortion, as seen
  /// From the residuals' variance, inflated for their correlation, plus the sampling error. Very
  /// large along an edge without other structure.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  double correlation = 0.0;  // normalised, after refinement
  double scale = 1.0;        // size in the rotation-compensated view 2 over size in view 1
};

/// A match, or the reason why there is none.
struct RegistrationResult {
  std::optional<PatchMatch> match;
  std::string reason;  // with a match: what limits it; usually empty
};

/// Owns its working buffers; use one per target. Choosing and finding allocate nothing but the
/// reason.
class Registration {
 public:
  /// Throws std::invalid_argument for settings out of range, a focal length that is not positive or
  /// images under 64 px.
  Registration(const geometry::Rig& rig, const RegistrationSettings& settings);
  ~Registration();
  Registration(Registration&&) noexcept;
  Registration& operator=(Registration&&) noexcept;

  /// Chooses the object's point near `salient` (the saliency winner, accurate to about 16 px) and a
  /// patch around it with enough structure in both directions to be found again, and remembers the
  /// patch. None if nothing there differs from its surroundings, if there is only an edge, or if
  /// the image does not have the camera's size.
  [[nodiscard]] std::optional<geometry::Pixel> choose_target(const geometry::View& view_1,
                                                             const geometry::Pixel& salient);

  /// The point of what looks like a mark on the chosen object and may be another thing in front of
  /// it. The first match decides: if it is in front, it is the target from then on.
  [[nodiscard]] std::optional<geometry::Pixel> mark() const;

  /// Why no target was chosen; empty if one was.
  [[nodiscard]] const char* refusal() const;

  /// Half the side of the square that contains the target and its surroundings in the patch.
  [[nodiscard]] double half_size_px() const;

  /// The target's outline in view 1.
  [[nodiscard]] Outline outline() const;

  /// Predictions use this head geometry from now on: it is known better than the rig's.
  void believe(const geometry::HeadGeometry& head);

  /// Finds the remembered patch in view 2, which must have view 1's size and pixel format. Refuses
  /// a match that is out of view, too different, squeezed, of another colour, or ambiguous.
  [[nodiscard]] RegistrationResult find(const geometry::View& view_2);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed::tracking
