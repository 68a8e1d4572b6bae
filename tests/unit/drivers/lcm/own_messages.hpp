// A link that receives what it sends itself, in a network of a test's own.
#pragma once

#include <cstddef>
#include <poll.h>
#include <string>

#include "drivers/lcm/link.hpp"

#include "messages.hpp"

namespace gazed::lcm {

constexpr std::size_t bytes_max = 1000;  // of the messages that these tests send

inline const std::string own_url = "udpm://239.255.76.67:7667?ttl=0";

/// Sends a message on CHANNEL; true when it alone comes back.
inline bool receives_own_message(LcmLink& link, LcmLink::Clock::time_point now, int& received) {
  const int before = received;
  if (!link.publish("CHANNEL", head_message(0, 0))) return false;
  for (int i = 0; i < 50 && received == before; ++i) {
    pollfd wait{link.descriptor(), POLLIN, 0};
    poll(&wait, 1, 100);
    link.handle(now);
  }
  return received == before + 1;
}

}  // namespace gazed::lcm
