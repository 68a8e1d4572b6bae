// The link on UDP multicast, in network namespaces of its own, where routes can be taken away.
#include <chrono>
#include <gtest/gtest.h>
#include <string>

#include "drivers/lcm/link.hpp"

#include "own_messages.hpp"
#include "tests/network_namespace.hpp"

namespace gazed::lcm::network_test {
namespace {

using namespace std::chrono_literals;
using test::Network;
using test::require;

TEST(Network, NoRouteIsToldAndTriedAgainLessAndLessOften) {
  expect_in_empty_network([](Network& network) {
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    require(!link.connected());
    require(link.descriptor() == -1);
    require(link.fault().find("ip route add 224.0.0.0/4 dev lo") != std::string::npos);
    require(!link.publish("CHANNEL", head_message(0, 0)));
    require(link.fault().find("; 1 message lost") != std::string::npos);

    for (const auto wait : {1s, 2s, 4s, 8s, 10s, 10s}) {  // each attempt fails
      link.handle(now + wait - 1ms);
      now += wait;
      link.handle(now);
      require(!link.connected());
    }
    int received = 0;
    link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
    require(network.set_loopback_up() && network.add_multicast_route());
    link.handle(now + 9s);
    require(!link.connected());  // not before its time
    now += 10s;
    link.handle(now);
    require(link.connected() && link.descriptor() >= 0);
    require(receives_own_message(link, now, received));
    require(link.fault().empty());
  });
}

TEST(Network, ARouteThatGoesAwayAndReturns) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    int received = 0;
    link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
    require(receives_own_message(link, now, received));

    require(network.remove_multicast_route());
    require(!link.publish("CHANNEL", head_message(0, 0)));
    require(link.fault().find("cannot send") != std::string::npos);
    link.handle(now);
    require(link.connected());  // a short failure keeps the connection

    require(network.add_multicast_route());
    now += 2s;
    require(receives_own_message(link, now, received));
    require(link.fault().empty());

    require(network.remove_multicast_route());
    for (int i = 0; i < 100; ++i, now += 100ms) {  // a long one ends it
      link.publish("CHANNEL", head_message(0, 0));
      link.handle(now);
    }
    require(!link.connected());
    require(link.fault().find("; 101 messages lost") != std::string::npos);
    require(link.notes() == "LCM: 101 messages could not be sent");
    require(network.add_multicast_route());
    now += 10s;
    link.handle(now);
    require(receives_own_message(link, now, received));
  });
}

}  // namespace
}  // namespace gazed::lcm::network_test
