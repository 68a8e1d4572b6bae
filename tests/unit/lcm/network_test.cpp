// The link on UDP multicast, in network namespaces of its own, where routes can be taken away.
#include <arpa/inet.h>
#include <cstdio>
#include <cstring>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <net/route.h>
#include <poll.h>
#include <sched.h>
#include <source_location>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "drivers/lcm/link.hpp"

#include "messages.hpp"

namespace gazed {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

const std::string url = "udpm://239.255.76.67:7667?ttl=0";

constexpr int passed = 0;
constexpr int failed = 1;
constexpr int no_namespace = 77;

// A socket for ioctl(), as `ip` uses; what it does is undone with the namespace.
class Network {
 public:
  ~Network() { close(socket_); }

  bool set_loopback_up() {
    ifreq request{};
    std::strcpy(request.ifr_name, "lo");
    if (ioctl(socket_, SIOCGIFFLAGS, &request) != 0) return false;
    request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP);
    return ioctl(socket_, SIOCSIFFLAGS, &request) == 0;
  }
  bool add_multicast_route() { return change_route(SIOCADDRT); }
  bool remove_multicast_route() { return change_route(SIOCDELRT); }

 private:
  // 224.0.0.0/4 dev lo
  bool change_route(unsigned long request) {
    rtentry route{};
    char device[] = "lo";
    const auto set = [](sockaddr& to, const char* address) {
      sockaddr_in ip{};
      ip.sin_family = AF_INET;
      inet_pton(AF_INET, address, &ip.sin_addr);
      std::memcpy(&to, &ip, sizeof ip);
    };
    set(route.rt_dst, "224.0.0.0");
    set(route.rt_genmask, "240.0.0.0");
    route.rt_flags = RTF_UP;
    route.rt_dev = device;
    return ioctl(socket_, request, &route) == 0;
  }

  int socket_ = socket(AF_INET, SOCK_DGRAM, 0);
};

// Ends the child process, with the line, when something does not hold.
void require(bool holds, std::source_location where = std::source_location::current()) {
  if (holds) return;
  std::fprintf(stderr, "%s:%u: does not hold\n", where.file_name(), where.line());
  _exit(failed);
}

// Runs `test` in a process of its own whose network has nothing, not even a loopback that is up.
int in_empty_network(const std::function<void(Network&)>& test) {
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNET) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
      _exit(no_namespace);
    }
    Network network;
    test(network);
    _exit(passed);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : failed;
}

bool receives_own_message(LcmLink& link, LcmLink::Clock::time_point now, int& received) {
  const int before = received;
  if (!link.publish("CHANNEL", test::head_message(0, 0))) return false;
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
    require(!link.publish("CHANNEL", test::head_message(0, 0)));
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
    require(!link.publish("CHANNEL", test::head_message(0, 0)));
    require(link.fault().find("cannot send") != std::string::npos);
    link.handle(now);
    require(link.connected());  // a short failure keeps the connection

    require(network.add_multicast_route());
    now += 2s;
    require(receives_own_message(link, now, received));
    require(link.fault().empty());

    require(network.remove_multicast_route());
    for (int i = 0; i < 100; ++i, now += 100ms) {  // a long one ends it
      link.publish("CHANNEL", test::head_message(0, 0));
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
}  // namespace gazed
