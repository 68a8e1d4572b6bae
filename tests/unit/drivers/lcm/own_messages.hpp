// A link that receives what it sends itself, in a network of a test's own.
#pragma once

#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>

#include "drivers/lcm/link.hpp"

#include "messages.hpp"
#include "tests/network_namespace.hpp"

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

/// Skips the test where no network namespace can be made.
inline void expect_in_empty_network(const std::function<void(test::Network&)>& holds) {
  const int result = test::in_empty_network(holds);
  if (result == test::no_namespace)
    GTEST_SKIP() << "this needs the right to make a network namespace";
  EXPECT_EQ(result, test::passed);
}

}  // namespace gazed::lcm
