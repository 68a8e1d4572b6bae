// The background's corners, followed from look 1 to every later look: they tell how the head really
// turned.
#pragma once

#include <memory>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/geometry/view.hpp"
#include "agent/triangulation/feature_observations.hpp"

namespace gazed::tracking {

/// Up to `features_max` corners spread over the frame. Keeps its working buffers and what it needs
/// of look 1's view: after construction nothing is allocated, and no view is used after the call.
class Background {
 public:
  /// Throws std::invalid_argument for a focal length that is not positive or images under 64 px.
  explicit Background(const geometry::Rig& rig);
  ~Background();
  Background(Background&&) noexcept;
  Background& operator=(Background&&) noexcept;

  /// Chooses corners in look 1's view, none within `target_radius_px` of the target: it may move,
  /// the background may not. Returns how many: none on a blank wall, where there is only camera
  /// noise, and for an image of another size than the camera's.
  std::size_t choose(const geometry::View& view_1, const geometry::Pixel& target,
                     double target_radius_px);

  /// Predicts from now on by a head that is better known than the rig's.
  void believe(const geometry::HeadGeometry& head);

  /// Follows them into a later look's view (`look` counts from 0, look 1 being 0; the same look
  /// once more: what was found before is forgotten): predicted by the turn, searched along the
  /// epipolar line, refined by registration of the small patch around each. Kept when following
  /// back comes to the same place, and when the other corners say that it stood still. Returns how
  /// many were found: none in an image of another size. Throws std::invalid_argument for look 0 and
  /// looks beyond looks_max.
  std::size_t follow(const geometry::View& view, std::size_t look);

  /// The chosen corners, found again or not, in the order of choice. Valid until choose().
  [[nodiscard]] std::span<const triangulation::FeatureObservations> features() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed::tracking
