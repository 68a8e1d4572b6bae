// The same object point in a second view, to sub-pixel: rotation undone by K R K^-1, search along
// the epipolar line inside the range bounds, then place, scale, the surface's slopes, gain and bias
// by least squares on the patch (Lucas and Kanade 1981, with the warp of a plane).
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
  geometry::Pixel pixel_2 = geometry::Pixel::Zero();  // with lens distortion, as seen
  /// From the residuals' variance, inflated for their likeness, plus what sampling leaves. Along an
  /// edge without other structure it is huge.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  double correlation = 0.0;  // normalised, after refinement
  double scale = 1.0;        // size in the rotation-compensated view 2 over size in view 1
};

/// A match, or why there is none.
struct RegistrationResult {
  std::optional<PatchMatch> match;
  std::string reason;  // with a match: what limits it, empty as a rule
};

/// Keeps its working buffers; one per target. Choosing and finding allocate nothing but a reason.
class Registration {
 public:
  /// Throws std::invalid_argument for settings out of range, a focal length that is not positive or
  /// images under 64 px.
  Registration(const geometry::Rig& rig, const RegistrationSettings& settings);
  ~Registration();
  Registration(Registration&&) noexcept;
  Registration& operator=(Registration&&) noexcept;

  /// Chooses the object's point near `salient` (the saliency winner, good to about 16 px) and the
  /// patch around it that has enough structure to be found again, in both directions, and remembers
  /// the patch. None when nothing there can be told from its surroundings, when all there is is an
  /// edge, and for an image of another size than the camera's.
  [[nodiscard]] std::optional<geometry::Pixel> choose_target(const geometry::View& view_1,
                                                             const geometry::Pixel& salient);

  /// Why nothing was chosen; empty when something was.
  [[nodiscard]] const char* refusal() const;

  /// Half the side of the square that the chosen target and what little is looked at around it
  /// fill.
  [[nodiscard]] double half_size_px() const;

  /// The chosen target's outline in view 1.
  [[nodiscard]] Outline outline() const;

  /// Predicts from now on by a head that is better known than the rig's.
  void believe(const geometry::HeadGeometry& head);

  /// Finds the remembered patch in view 2, which must have view 1's size and pixel format. Refuses
  /// what is out of view, too unlike, squeezed, of another colour, or to be seen at two places.
  [[nodiscard]] RegistrationResult find(const geometry::View& view_2);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed::tracking
