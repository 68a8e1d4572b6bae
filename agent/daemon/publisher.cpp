#include "agent/daemon/publisher.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "agent/daemon/message_fields.hpp"
#include "drivers/lcm/conversions.hpp"

namespace gazed::daemon {

namespace {

constexpr bool is(cycle::Status status, std::int8_t constant) {
  return static_cast<std::int8_t>(status) == constant;
}
static_assert(is(cycle::Status::located, located_point_t::LOCATED));
static_assert(is(cycle::Status::no_salient_object, located_point_t::NO_SALIENT_OBJECT));
static_assert(is(cycle::Status::target_lost, located_point_t::TARGET_LOST));
static_assert(is(cycle::Status::degenerate, located_point_t::DEGENERATE));
static_assert(is(cycle::Status::behind_camera, located_point_t::BEHIND_CAMERA));
static_assert(is(cycle::Status::uncertain, located_point_t::UNCERTAIN));
static_assert(is(cycle::Status::head_fault, located_point_t::HEAD_FAULT));
static_assert(is(cycle::Status::camera_fault, located_point_t::CAMERA_FAULT));

}  // namespace

located_point_t to_message(const cycle::Fixation& fixation) {
  const triangulation::PointEstimate& estimate = fixation.estimate;
  located_point_t message{};
  message.utime = fixation.utime_us;
  message.fixation = fixation.number;
  message.status = static_cast<std::int8_t>(fixation.status);
  message.reason = fixation.reason;
  message.views = static_cast<std::int16_t>(fixation.views);
  copy(estimate.torso_point_m, message.position_m);
  copy(estimate.torso_covariance_m2, &message.covariance_m2[0][0]);
  copy(estimate.point_m, message.camera_position_m);
  message.range_m = estimate.range_m;
  message.range_sigma_m = estimate.range_sigma_m;
  message.inverse_range_per_m = estimate.inverse_range_per_m;
  message.inverse_range_sigma_per_m = estimate.inverse_range_sigma_per_m;
  message.parallax_rad = estimate.parallax_rad;
  message.residual_px = estimate.residual_px;
  copy(fixation.pixel_1, message.pixel_1);
  copy(fixation.pixel_2, message.pixel_2);
  copy(fixation.head_1, message.head_1_rad);
  copy(fixation.head_2, message.head_2_rad);
  message.saliency = fixation.saliency;
  message.distinctness = fixation.distinctness;
  return message;
}

void to_message(const cycle::UsedSaliency& used, saliency_map_t& message) {
  const saliency::SaliencyMap& map = used.result.map;
  message.utime = used.utime_us;
  message.width = static_cast<std::int16_t>(map.width);
  message.height = static_cast<std::int16_t>(map.height);
  message.size = static_cast<std::int32_t>(map.samples.size());
  message.map.resize(map.samples.size());
  const unsigned peak =
      map.samples.empty() ? 0U : *std::max_element(map.samples.begin(), map.samples.end());
  std::transform(
      map.samples.begin(), map.samples.end(), message.map.begin(), [peak](unsigned sample) {
        return static_cast<std::uint8_t>(peak == 0 ? 0 : (sample * 255U + peak / 2) / peak);
      });
  copy(used.result.peak_px, message.peak_px);
  message.saliency = used.result.saliency;
  message.distinctness = used.result.distinctness;
}

Publisher::Publisher(lcm::LcmLink& link, const std::string& prefix,
                     const settings::PublishSettings& settings, CameOverLcm came)
    : link_(link),
      settings_(settings),
      came_(came),
      channels_(prefix),
      image_rate_(settings.images_per_second),
      jpeg_(settings.jpeg_quality) {}

void Publisher::publish(const located_point_t& point) {
  link_.publish(channels_.located_point, point);
}

void Publisher::publish(const fixation_t& fixation) {
  link_.publish(channels_.fixation, fixation);
}

void Publisher::publish(const status_t& status) {
  link_.publish(channels_.status, status);
}

void Publisher::publish(const cycle::UsedSaliency& used) {
  if (!settings_.saliency) return;
  to_message(used, map_message_);
  link_.publish(channels_.saliency, map_message_);
}

void Publisher::publish(const geometry::HeadState& state) {
  if (came_.head) return;
  lcm::to_message(state, head_state_message_);
  link_.publish(channels_.head_state, head_state_message_);
}

void Publisher::publish(const geometry::HeadCommand& command) {
  if (came_.head) return;
  lcm::to_message(command, head_command_message_);
  link_.publish(channels_.head_command, head_command_message_);
}

bool Publisher::publishes_images() const {
  return settings_.images != settings::PublishedImages::none && !came_.camera;
}

void Publisher::publish(const geometry::Frame& frame) {
  using settings::PublishedImages;
  if (!publishes_images()) return;
  if (!image_rate_.is_due(frame.utime_us)) return;
  if (settings_.images == PublishedImages::pixels) {
    lcm::to_message(frame, image_message_);
  } else {
    const std::span<const std::uint8_t> file = jpeg_.encode(frame.image);
    if (file.empty()) return;
    lcm::to_message(frame, file, image_message_);
  }
  link_.publish(channels_.image, image_message_);
}

}  // namespace gazed::daemon
