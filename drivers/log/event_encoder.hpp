// Frames, head states, located points and fixations as events of a log.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drivers/camera.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/log/event.hpp"
#include "msgs/gazed/fixation_t.hpp"
#include "msgs/gazed/head_state_t.hpp"
#include "msgs/gazed/located_point_t.hpp"

namespace gazed::log {

/// An event that it gives is valid until the next one.
class EventEncoder {
 public:
  explicit EventEncoder(lcm::Channels channels) : channels_(std::move(channels)) {}

  /// The time of the event is the frame's or the state's own.
  [[nodiscard]] Event encode(const geometry::Frame& frame);
  [[nodiscard]] Event encode(const geometry::HeadState& state);
  /// At the time of the event before it, if that is later: a fixation's own, and its
  /// point's, is that of the last view.
  [[nodiscard]] Event encode(const located_point_t& point);
  [[nodiscard]] Event encode(const fixation_t& fixation);

  /// An event of this time is encoded by somebody else.
  void saw(std::int64_t utime_us) { newest_utime_us_ = utime_us; }

 private:
  template <class Message>
  [[nodiscard]] Event encode_message(const std::string& channel, const Message& message,
                                     std::int64_t utime_us);

  lcm::Channels channels_;
  std::int64_t newest_utime_us_ = 0;
  head_state_t state_message_{};  // these two are reused
  std::vector<std::uint8_t> encoded_;
};

}  // namespace gazed::log
