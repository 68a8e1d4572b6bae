#include "agent/cycle/attention.hpp"

#include <Eigen/Geometry>

namespace gazed::cycle {

Attention::Attention(const geometry::Rig& rig, const saliency::SaliencySettings& settings)
    : camera_(rig.camera), head_(rig.head), looks_for_flicker_(settings.flicker_weight > 0.0) {
  if (settings.scan)
    inhibition_.emplace(rig.camera, settings.inhibition_radius_rad, settings.inhibition_decay_s);
  if (settings.profile != saliency::SaliencyProfile::report &&
      (settings.exclude_body || settings.exclude_feet))
    own_parts_.emplace(rig.camera, settings.exclude_body, settings.exclude_feet);
}

saliency::FrameContext Attention::context_for(const geometry::View& view) {
  const geometry::Pose pose = geometry::cam_from_torso(head_, view.head);
  saliency::FrameContext context;
  context.head_is_still = flicker_was_seen_ = still_since_look_;
  still_since_look_ = true;
  context.previous_winner_px = last_winner_in(pose);
  if (inhibition_) context.kept = inhibition_->kept(pose, view.utime_us);
  if (own_parts_) context.without_own_parts = own_parts_->kept(pose);
  return context;
}

// Treats the winner as far away: the camera's translation during a turn is ignored.
std::optional<geometry::Pixel> Attention::last_winner_in(
    const geometry::Pose& cam_from_torso) const {
  if (!last_winner_) return std::nullopt;
  return geometry::project(camera_, cam_from_torso.rotation * *last_winner_);
}

void Attention::won(const geometry::View& view, const geometry::Pixel& pixel) {
  last_winner_.reset();
  if (const auto point = geometry::normalise(camera_, pixel)) {
    const geometry::Pose pose = geometry::cam_from_torso(head_, view.head);
    last_winner_ = pose.rotation.transpose() * point->homogeneous();
  }
}

void Attention::fixation_ended(std::int64_t utime_us) {
  head_moved();
  if (!inhibition_ || !last_winner_) return;
  inhibition_->add(*last_winner_, utime_us);
  last_winner_.reset();
}

}  // namespace gazed::cycle
