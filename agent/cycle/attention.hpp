// What the next look needs to know about earlier ones: where the last winner is now, which places
// are inhibited, where the robot sees itself, and whether the head has stood still since.
//
// Places survive a turn of the head as directions in the torso's axes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "agent/geometry/rig.hpp"
#include "agent/geometry/view.hpp"
#include "agent/saliency/inhibition.hpp"
#include "agent/saliency/own_parts.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::cycle {

class Attention {
 public:
  Attention(const geometry::Rig& rig, const saliency::SaliencySettings& settings);

  /// For examining a view of a still head. Valid until the next call.
  [[nodiscard]] saliency::FrameContext context_for(const geometry::View& view);
  /// Records that the view was examined and that this place won.
  void won(const geometry::View& view, const geometry::Pixel& pixel);
  /// Records that the head moves or may have moved.
  void head_moved() { still_since_look_ = false; }
  /// In scan mode, inhibits the last winner from now on.
  void fixation_ended(std::int64_t utime_us);

  /// True if the last context came from a first still frame: flicker needs two.
  [[nodiscard]] bool flicker_needs_another_frame() const {
    return looks_for_flicker_ && !flicker_was_seen_;
  }

 private:
  [[nodiscard]] std::optional<geometry::Pixel> last_winner_in(
      const geometry::Pose& cam_from_torso) const;

  geometry::CameraModel camera_;
  geometry::HeadGeometry head_;
  bool looks_for_flicker_;
  bool still_since_look_ = false;
  bool flicker_was_seen_ = false;
  std::optional<Eigen::Vector3d> last_winner_;      // its direction, torso axes
  std::optional<saliency::Inhibition> inhibition_;  // in scan mode
  std::optional<saliency::OwnParts> own_parts_;     // if any are to be left out
};

}  // namespace gazed::cycle
