// LCM over UDP multicast, without a thread: the provider "udpm" as gazed speaks it.
//
// liblcm 1.3.1 reads fragments without checking them (two packets of anybody end the program), lets
// a thread of its own do it, waits up to 10 s for a message to itself, and copies before it looks
// at a size. Here every datagram is checked, and nothing waits. What others see is the same.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <netinet/in.h>
#include <optional>
#include <span>
#include <string>

#include "agent/base/file_descriptor.hpp"
#include "drivers/lcm/connection.hpp"
#include "drivers/lcm/datagram.hpp"
#include "drivers/lcm/multicast.hpp"
#include "drivers/lcm/reassembly.hpp"
#include "drivers/lcm/url.hpp"

namespace gazed::lcm {

class UdpmConnection final : public Connection {
 public:
  /// None without a route to the group. `subscriptions` must outlive the connection.
  [[nodiscard]] static std::unique_ptr<UdpmConnection> open(const UdpmUrl& url,
                                                            Subscriptions& subscriptions,
                                                            Clock::time_point now);

  [[nodiscard]] int descriptor() const override { return receiver_.get(); }
  [[nodiscard]] bool read_channel(const Subscription&) override { return true; }
  /// Lost when the route to the group has gone or leads to another interface, which is looked at
  /// once a second: the group is joined on an interface.
  [[nodiscard]] bool receive(int most, Clock::time_point now) override;
  /// False when the message was dropped: without a route, or when it does not fit what the kernel
  /// has left for sending. Never waits.
  [[nodiscard]] bool send(const std::string& channel,
                          std::span<const std::uint8_t> message) override;
  [[nodiscard]] std::int64_t malformed_packets() const override { return malformed_; }

 private:
  UdpmConnection(const UdpmUrl& url, const MulticastRoute& route, Subscriptions& subscriptions,
                 Clock::time_point now);
  [[nodiscard]] bool prepare_sender(const UdpmUrl& url) const;
  [[nodiscard]] bool prepare_receiver(const UdpmUrl& url) const;
  void take(std::span<const std::uint8_t> bytes, const sockaddr_in& from, Clock::time_point now);
  void take(const Fragment& fragment, const sockaddr_in& from, Clock::time_point now);

  sockaddr_in group_;
  bool this_host_only_;
  MulticastRoute route_;
  Subscriptions& subscriptions_;
  base::FileDescriptor sender_, receiver_;
  Clock::time_point route_seen_;
  LocalAddresses local_;
  DatagramWriter writer_;
  Reassembly reassembly_;
  std::int64_t malformed_ = 0;
  std::array<std::uint8_t, datagram_bytes_max> datagram_;
};

}  // namespace gazed::lcm
