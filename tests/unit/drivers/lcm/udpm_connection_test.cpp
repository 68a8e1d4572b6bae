// What other programs send, honest or not, in network namespaces of its own.
#include <algorithm>
#include <arpa/inet.h>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <lcm/lcm-cpp.hpp>
#include <poll.h>
#include <span>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

#include "drivers/lcm/big_endian.hpp"
#include "drivers/lcm/datagram.hpp"
#include "drivers/lcm/link.hpp"

#include "own_messages.hpp"
#include "tests/network_namespace.hpp"

namespace gazed::lcm::udpm_connection_test {
namespace {

using namespace std::chrono_literals;
using test::Network;
using test::require;
using ::testing::HasSubstr;

// Sends packets that no library of LCM would send.
class Stranger {
 public:
  explicit Stranger(const char* address = "239.255.76.67") {
    to_.sin_family = AF_INET;
    to_.sin_port = htons(7667);
    inet_pton(AF_INET, address, &to_.sin_addr);
  }
  ~Stranger() { close(socket_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  void send(const std::string& packet) const {
    sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to_),
           sizeof to_);
  }
  /// A fragment, whatever its numbers.
  void send_fragment(std::uint32_t message_bytes, std::uint32_t offset, std::uint16_t number,
                     std::uint16_t count, const std::string& rest) const {
    std::string packet = "LC03" + std::string(16, '\0');
    const std::span bytes(reinterpret_cast<std::uint8_t*>(packet.data()), packet.size());
    write_big_endian(std::uint32_t{7}, bytes.subspan(4, 4));
    write_big_endian(message_bytes, bytes.subspan(8, 4));
    write_big_endian(offset, bytes.subspan(12, 4));
    write_big_endian(number, bytes.subspan(16, 2));
    write_big_endian(count, bytes.subspan(18, 2));
    send(packet + rest);
  }

 private:
  int socket_ = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to_{};
};

constexpr std::size_t datagram_name_begins = 8;  // of a short one

/// Receives all that is sent to the group.
int socket_of_the_group() {
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  const int shared = 1;
  setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &shared, sizeof shared);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  require(bind(descriptor, reinterpret_cast<const sockaddr*>(&group), sizeof group) == 0);
  ip_mreq membership{};
  membership.imr_multiaddr = group.sin_addr;
  require(setsockopt(descriptor, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) ==
          0);
  return descriptor;
}

/// The most that this process has had.
long address_space_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    if (long kilobytes = 0; name == "VmPeak:" && status >> kilobytes) return kilobytes;
  }
  return 0;
}

/// Runs `attack` beside a link that reads CHANNEL; what is received afterwards is its own.
void with_a_stranger(const std::function<void(const Stranger&)>& attack) {
  expect_in_empty_network([&](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    int received = 0;
    link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
    require(receives_own_message(link, now, received));
    const Stranger stranger;
    attack(stranger);
    link.handle(now);
    require(received == 1);
    require(receives_own_message(link, now, received));
    require(received == 2 && link.connected());
  });
}

TEST(Udpm, PacketsThatAreNotLcmReachNobody) {
  with_a_stranger([](const Stranger& stranger) {
    const std::string short_header = std::string("LC02") + std::string(4, '\0');
    stranger.send("");
    stranger.send("LC02");
    stranger.send("not LCM at all");
    stranger.send(short_header + "CHANNEL");              // the name has no end
    stranger.send(short_header + std::string(200, 'C'));  // a name longer than can be
    stranger.send(std::string("LC03") + std::string(20, '\xFF'));
    stranger.send("LC03");
  });
}

// Two packets each that ended a program with liblcm 1.3.1 by SIGSEGV.
TEST(Udpm, FragmentsThatLieAboutTheirPlaceAreNotFelt) {
  const std::string name("CHANNEL\0", 8);
  with_a_stranger([&](const Stranger& stranger) {
    stranger.send_fragment(0xFFFFFFFF, 0, 0, 1, name + std::string(50, 'x'));
    stranger.send_fragment(100, 100, 0, 1, "");
    stranger.send_fragment(100, 0, 0, 3, name + std::string(10, 'x'));
    stranger.send_fragment(100, 0xFFFFFFF0, 1, 3, std::string(20, 'x'));
    stranger.send_fragment(100, 10, 3, 3, std::string(20, 'x'));
  });
}

TEST(Udpm, AMessageThatClaimsMoreThanItsChannelCanHaveCostsNothing) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    int received = 0;
    std::size_t refused_bytes = 0;
    link.subscribe({.channel = "CHANNEL",
                    .message_bytes_max = bytes_max,
                    .handler = [&](auto) { ++received; },
                    .refused = [&](std::size_t bytes) { refused_bytes = bytes; }});
    const Stranger stranger;
    const long before_kb = address_space_kb();
    stranger.send_fragment(1U << 28, 0, 0, 1, std::string("CHANNEL\0", 8) + std::string(40, 'x'));
    require(receives_own_message(link, now, received));
    require(refused_bytes == 1U << 28 && link.malformed_packets() == 1);
    constexpr long much_less_kb = 1L << 16;  // than was claimed
    require(before_kb > 0 && address_space_kb() < before_kb + much_less_kb);
    // Whole, and a byte too long.
    stranger.send(std::string("LC02\0\0\0\0CHANNEL\0", 16) + std::string(bytes_max + 1, 'x'));
    require(receives_own_message(link, now, received));
    require(refused_bytes == bytes_max + 1 && received == 2);
  });
}

// liblcm sends itself a message before the first subscription counts, and waits 10 s for it where a
// firewall keeps it.
TEST(Udpm, NothingIsSentThatWouldHaveToComeBack) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    const int everything = socket_of_the_group();
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    int received = 0;
    link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
    link.handle(now);
    require(link.connected() && link.fault().empty());
    require(receives_own_message(link, now, received));
    std::string first(2000, '\0');
    const ssize_t bytes = recv(everything, first.data(), first.size(), 0);
    require(bytes > 0 && first.find("CHANNEL") == datagram_name_begins);
    close(everything);
  });
}

// To an address of this host: liblcm listens there too.
TEST(Udpm, WhatIsNotSentToTheGroupIsNotReceived) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    int received = 0;
    link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
    Stranger("127.0.0.1").send(std::string("LC02\0\0\0\0CHANNEL\0x", 17));
    require(receives_own_message(link, now, received) && received == 1);
  });
}

TEST(Udpm, AFrameCrossesInFragments) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url + "&recv_buf_size=4000000", now);
    constexpr std::size_t frame_bytes = 614'400;
    std::vector<std::uint8_t> sent(frame_bytes), got;
    for (std::size_t i = 0; i < sent.size(); ++i)
      sent[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
    link.subscribe("FRAMES", frame_bytes,
                   [&](auto message) { got.assign(message.begin(), message.end()); });
    for (int turn = 0; turn < 20 && got.empty(); ++turn) {
      // The kernel's usual receive buffer holds three of the ten fragments: they are taken one by
      // one.
      DatagramWriter writer;
      require(writer.begin("FRAMES", sent));
      const Stranger sender;
      for (auto datagram = writer.next(); !datagram.empty(); datagram = writer.next()) {
        sender.send(std::string(datagram.begin(), datagram.end()));
        link.handle(now);
      }
    }
    require(got == sent);
  });
}

// A sensor's frame and a short message, both ways: liblcm is what most programs at the other end
// use.
TEST(Udpm, LiblcmIsUnderstoodAndUnderstands) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url + "&recv_buf_size=4000000", now);
    ::lcm::LCM peer(own_url);
    require(peer.good());
    constexpr std::size_t frame_bytes =
        150'000;  // three fragments: fits the kernel's usual buffers
    const std::vector<std::uint8_t> frame(frame_bytes, 'f'), word(5, 'w');
    std::vector<std::vector<std::uint8_t>> here, there;
    link.subscribe("TO_US", frame_bytes,
                   [&](auto message) { here.emplace_back(message.begin(), message.end()); });
    peer.subscribeFunction(
        "TO_YOU",
        +[](const ::lcm::ReceiveBuffer* got, const std::string&, decltype(there)* out) {
          const auto* data = static_cast<const std::uint8_t*>(got->data);
          out->emplace_back(data, data + got->data_size);
        },
        &there);
    const auto has_both = [&](const auto& got) {
      return std::ranges::find(got, frame) != got.end() &&
             std::ranges::find(got, word) != got.end();
    };
    for (int turn = 0; turn < 500 && !(has_both(here) && has_both(there)); ++turn) {
      for (const auto& message : {frame, word}) {
        peer.publish("TO_US", message.data(), static_cast<unsigned>(message.size()));
        link.publish_bytes("TO_YOU", message);
        while (peer.handleTimeout(20) > 0) {
        }
        link.handle(now);
      }
    }
    require(has_both(here));
    require(has_both(there));
  });
}

std::ptrdiff_t threads() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

TEST(Udpm, NoThreadIsStarted) {
  expect_in_empty_network([](Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    const std::ptrdiff_t before = threads();  // an emulator may have some of its own
    LcmLink::Clock::time_point now{1000s};
    LcmLink link(own_url, now);
    int received = 0;
    link.subscribe("CHANNEL", bytes_max, [&](auto) { ++received; });
    require(receives_own_message(link, now, received));
    require(threads() == before);
  });
}

}  // namespace
}  // namespace gazed::lcm::udpm_connection_test
