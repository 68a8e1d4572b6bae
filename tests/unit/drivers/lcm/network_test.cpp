// The link on UDP multicast, in network namespaces of its own, where routes can be taken away.
#include <arpa/inet.h>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/lcm/link.hpp"

#include "messages.hpp"
#include "tests/network_namespace.hpp"

namespace gazed::lcm::network_test {
namespace {

using namespace std::chrono_literals;
using test::in_empty_network;
using test::Network;
using test::no_namespace;
using test::passed;
using test::require;
using ::testing::HasSubstr;

const std::string url = "udpm://239.255.76.67:7667?ttl=0";

bool receives_own_message(LcmLink& link, LcmLink::Clock::time_point now, int& received) {
  const int before = received;
  if (!link.publish("CHANNEL", head_message(0, 0))) return false;
  for (int i = 0; i < 50 && received == before; ++i) {
    pollfd wait{link.descriptor(), POLLIN, 0};
    poll(&wait, 1, 100);
    link.handle(now);
  }
  return received == before + 1;
}

TEST(Network, NoRouteIsToldAndTriedAgainLessAndLessOften) {
  const int result = in_empty_network([](Network& network) {
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(url, now);
    require(!link.connected());
    require(link.descriptor() == -1);
    require(link.fault().find("ip route add 224.0.0.0/4 dev lo") != std::string::npos);
    require(!link.publish("CHANNEL", head_message(0, 0)));
    require(link.publish_failures() == 1);
    require(link.fault().find("1 message lost") != std::string::npos);

    for (const auto wait : {1s, 2s, 4s, 8s, 10s, 10s}) {  // each attempt fails
      link.handle(now + wait - 1ms);
      now += wait;
      link.handle(now);
      require(!link.connected());
    }
    int received = 0;
    link.subscribe("CHANNEL", [&](auto) { ++received; });
    require(network.set_loopback_up() && network.add_multicast_route());
    link.handle(now + 9s);
    require(!link.connected());  // not before its time
    now += 10s;
    link.handle(now);
    require(link.connected() && link.descriptor() >= 0);
    require(receives_own_message(link, now, received));
    require(link.fault().empty());
  });
  if (result == no_namespace) GTEST_SKIP() << "this needs the right to make a network namespace";
  EXPECT_EQ(result, passed);
}

TEST(Network, ARouteThatGoesAwayAndReturns) {
  const int result = in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(url, now);
    int received = 0;
    link.subscribe("CHANNEL", [&](auto) { ++received; });
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
    require(link.publish_failures() == 101);
    require(network.add_multicast_route());
    now += 10s;
    link.handle(now);
    require(receives_own_message(link, now, received));
  });
  if (result == no_namespace) GTEST_SKIP() << "this needs the right to make a network namespace";
  EXPECT_EQ(result, passed);
}

// A packet without the end of its channel's name: liblcm 1.3.1 hands it on with a size below zero
// when older bytes behind it complete the name.
TEST(Network, PacketsThatAreNotLcmReachNobody) {
  const int result = in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(url, now);
    int received = 0;
    link.subscribe("CHANNEL", [&](auto) { ++received; });
    require(receives_own_message(link, now, received));

    const int sender = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(7667);
    inet_pton(AF_INET, "239.255.76.67", &to.sin_addr);
    const auto send = [&](std::string packet) {
      sendto(sender, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
    };
    const std::string short_header = std::string("LC02") + std::string(4, '\0');
    send("");
    send("LC02");
    send("not LCM at all");
    send(short_header + "CHANNEL");              // the name has no end
    send(short_header + std::string(200, 'C'));  // a name longer than can be
    send(std::string("LC03") + std::string(20, '\xFF'));
    close(sender);
    require(receives_own_message(link, now, received) || received >= 2);
    require(link.connected());
  });
  if (result == no_namespace) GTEST_SKIP() << "this needs the right to make a network namespace";
  EXPECT_EQ(result, passed);
}

}  // namespace
}  // namespace gazed::lcm::network_test
