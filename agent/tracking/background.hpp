// Corners of the background, followed from look 1 into every later look: they show how the head
// really turned.
#pragma once

#include <memory>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/geometry/view.hpp"
#include "agent/triangulation/feature_observations.hpp"

namespace gazed::tracking {

/// Up to `features_max` corners spread over the frame. Owns its buffers and copies what it needs of
/// look 1's view: nothing is allocated after construction, and no view is used after the call.
class Background {
 public:
  /// Throws std::invalid_argument for a focal length that is not positive or images under 64 px.
  explicit Background(const geometry::Rig& rig);
  ~Background();
  Background(Background&&) noexcept;
  Background& operator=(Background&&) noexcept;

  /// Chooses corners in look 1's view, none within `target_radius_px` of the target, which may move
  /// while the background may not. Returns their number. It is 0 on a blank wall, which shows only
  /// camera noise, and for an image that does not have the camera's size.
  std::size_t choose(const geometry::View& view_1, const geometry::Pixel& target,
                     double target_radius_px);

  /// Predictions use this head geometry from now on: it is known better than the rig's.
  void believe(const geometry::HeadGeometry& head);

  /// Follows the corners into a later look's view. `look` counts from 0, look 1 being 0; following
  /// the same look again replaces what was found. Corners are predicted from the head's turn,
  /// searched along their epipolar lines, and refined by registering the small patch around each. A
  /// corner is kept when tracking it back returns to its start, and when its motion agrees with the
  /// others' that it stood still. Returns how many were found: 0 for an image of another size.
  /// Throws std::invalid_argument for look 0 and for looks from looks_max on.
  std::size_t follow(const geometry::View& view, std::size_t look);

  /// The chosen corners, found again or not, in the order of choice. Valid until the next choose().
  [[nodiscard]] std::span<const triangulation::FeatureObservations> features() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed::tracking
