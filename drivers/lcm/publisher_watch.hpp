// Notices when another program publishes on our channels.
//
// LCM has no owner of a channel: a second gazed on the same prefix mixes its points into ours, and
// no reader can tell. Multicast brings every message back to its sender, so a status_t that comes
// in and that we did not send is somebody else's.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/link.hpp"
#include "msgs/gazed/status_t.hpp"

namespace gazed::lcm {

class PublisherWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// `link` must outlive the watch.
  PublisherWatch(LcmLink& link, const Channels& channels);

  PublisherWatch(const PublisherWatch&) = delete;
  PublisherWatch& operator=(const PublisherWatch&) = delete;

  /// To be called with every status that is published. The last 1024 are remembered: link.handle()
  /// must be called more often than that.
  void sent(const status_t& status);

  /// A warning for the person who runs gazed: at the first foreign message, then at most once a
  /// minute while there are more. Else empty.
  [[nodiscard]] std::string warning(Clock::time_point now = Clock::now());

 private:
  void received(std::span<const std::uint8_t> message);

  std::string channel_;
  std::array<std::uint64_t, 1024> sent_hashes_{};  // ring
  std::size_t sent_count_ = 0;
  std::vector<std::uint8_t> encoded_;  // reused
  std::int64_t foreign_ = 0;           // status messages of others so far
  std::int64_t reported_ = 0;          // of these, before the last warning
  Clock::time_point quiet_until_{};
};

}  // namespace gazed::lcm
