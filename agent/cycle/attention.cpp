#include "agent/cycle/attention.hpp"

#include <Eigen/Geometry>

namespace gazed {

Attention::Attention(const SaliencySettings& settings, const CameraModel& camera,
                     const HeadGeometry& head)
    : camera_(camera), head_(head), looks_for_flicker_(settings.flicker_weight > 0.0) {
  if (settings.scan)
    inhibition_.emplace(camera, settings.inhibition_radius_rad, settings.inhibition_decay_s);
}

LookContext Attention::context_for(const View& view) {
  const Pose pose = cam_from_torso(head_, view.head);
  LookContext context;
  context.head_is_still = flicker_was_seen_ = still_since_look_;
  still_since_look_ = true;
  context.previous_winner_px = last_winner_in(pose);
  if (inhibition_) context.kept = inhibition_->kept(pose, view.utime_us);
  return context;
}

// As if it were far away: the camera's own way during a turn is left out.
std::optional<Pixel> Attention::last_winner_in(const Pose& cam_from_torso) const {
  if (!last_winner_) return std::nullopt;
  return project(camera_, cam_from_torso.rotation * *last_winner_);
}

void Attention::won(const View& view, const Pixel& pixel) {
  last_winner_.reset();
  if (const auto point = normalise(camera_, pixel)) {
    const Pose pose = cam_from_torso(head_, view.head);
    last_winner_ = pose.rotation.transpose() * point->homogeneous();
  }
}

void Attention::fixation_ended(std::int64_t utime_us) {
  head_moved();
  if (!inhibition_ || !last_winner_) return;
  inhibition_->add(*last_winner_, utime_us);
  last_winner_.reset();
}

}  // namespace gazed
