// What gazed publishes on LCM. The channels are PREFIX_LOCATED_POINT, PREFIX_FIXATION,
// PREFIX_SALIENCY, PREFIX_STATUS, PREFIX_HEAD_STATE, PREFIX_HEAD_COMMAND and PREFIX_IMAGE; the
// types are those in msgs/.
#pragma once

#include <string>

#include "agent/cycle/cycle.hpp"
#include "agent/daemon/image_rate.hpp"
#include "agent/geometry/head_motion.hpp"
#include "agent/geometry/view.hpp"
#include "agent/settings/run_settings.hpp"
#include "drivers/jpeg/encoder.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/link.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/fixation_t.hpp"
#include "msgs/gazed/head_command_t.hpp"
#include "msgs/gazed/head_state_t.hpp"
#include "msgs/gazed/located_point_t.hpp"
#include "msgs/gazed/saliency_map_t.hpp"
#include "msgs/gazed/status_t.hpp"

namespace gazed::daemon {

/// A fixation as it is published; numbers without a meaning are NaN.
[[nodiscard]] gazed::located_point_t to_message(const cycle::Fixation& fixation);

/// How its answer was reached. `robot` is the profile's name.
[[nodiscard]] gazed::fixation_t to_fixation_message(const cycle::Fixation& fixation,
                                                    const std::string& robot);

/// Scales the map so that its maximum is 255.
void to_message(const cycle::UsedSaliency& used, gazed::saliency_map_t& message);

/// Whether a part's data already comes over LCM: it is then not published again.
struct CameOverLcm {
  bool camera = false;
  bool head = false;
};

class Publisher {
 public:
  Publisher(lcm::LcmLink& link, const std::string& prefix,
            const settings::PublishSettings& settings, CameOverLcm came);

  void publish(const located_point_t& point);
  void publish(const fixation_t& fixation);
  void publish(const status_t& status);
  void publish(const cycle::UsedSaliency& used);
  void publish(const geometry::HeadState& state);
  void publish(const geometry::HeadCommand& command);
  [[nodiscard]] bool publishes_images() const;
  void publish(const geometry::Frame& frame);

 private:
  lcm::LcmLink& link_;
  settings::PublishSettings settings_;
  CameOverLcm came_;
  lcm::Channels channels_;
  ImageRate image_rate_;
  jpeg::Encoder jpeg_;
  // Reused, so that publishing allocates nothing.
  head_state_t head_state_message_{};
  head_command_t head_command_message_{};
  saliency_map_t map_message_{};
  bot_core::image_t image_message_{};
};

}  // namespace gazed::daemon
