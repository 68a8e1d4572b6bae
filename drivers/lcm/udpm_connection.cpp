#include "drivers/lcm/udpm_connection.hpp"

#include <cerrno>
#include <chrono>
#include <sys/socket.h>
#include <variant>

namespace gazed::lcm {

namespace {

constexpr std::chrono::seconds between_looks_at_the_route{1};
// For a frame of 640x480 in RGB to go out at once; the kernel gives what net.core.wmem_max allows.
constexpr int send_buffer_bytes = 1'000'000;

int udp_socket() {
  return socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
}

template <class Value>
bool set_option(const base::FileDescriptor& socket, int level, int name, const Value& value) {
  return setsockopt(socket.get(), level, name, &value, sizeof value) == 0;
}

}  // namespace

UdpmConnection::UdpmConnection(const UdpmUrl& url, const MulticastRoute& route,
                               Subscriptions& subscriptions, Clock::time_point now)
    : group_(url.group),
      this_host_only_(url.ttl == 0),
      route_(route),
      subscriptions_(subscriptions),
      sender_(udp_socket()),
      receiver_(udp_socket()),
      route_seen_(now) {}

std::unique_ptr<UdpmConnection> UdpmConnection::open(const UdpmUrl& url,
                                                     Subscriptions& subscriptions,
                                                     Clock::time_point now) {
  const auto route = route_to(url.group);
  if (!route) return nullptr;
  std::unique_ptr<UdpmConnection> made(new UdpmConnection(url, *route, subscriptions, now));
  if (!made->prepare_sender(url) || !made->prepare_receiver(url)) return nullptr;
  return made;
}

bool UdpmConnection::prepare_sender(const UdpmUrl& url) const {
  static_cast<void>(set_option(sender_, SOL_SOCKET, SO_SNDBUF, send_buffer_bytes));
  return sender_.get() >= 0 && set_option(sender_, IPPROTO_IP, IP_MULTICAST_TTL, url.ttl) &&
         set_option(sender_, IPPROTO_IP, IP_MULTICAST_LOOP, 1);
}

bool UdpmConnection::prepare_receiver(const UdpmUrl& url) const {
  if (receiver_.get() < 0) return false;
  // Bound to the group's address: what is sent to one of this host's own never arrives here.
  if (!set_option(receiver_, SOL_SOCKET, SO_REUSEADDR, 1) ||
      bind(receiver_.get(), reinterpret_cast<const sockaddr*>(&group_), sizeof group_) != 0)
    return false;
  if (url.receive_buffer_bytes)
    static_cast<void>(set_option(receiver_, SOL_SOCKET, SO_RCVBUF, *url.receive_buffer_bytes));
  // Of this group only, whatever other programs join at the same port.
  static_cast<void>(set_option(receiver_, IPPROTO_IP, IP_MULTICAST_ALL, 0));
  // The interface by its address: QEMU 7.2 takes an index for something else on 64-bit targets.
  ip_mreq membership{};
  membership.imr_multiaddr = group_.sin_addr;
  membership.imr_interface.s_addr = route_.address;
  return set_option(receiver_, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership);
}

bool UdpmConnection::receive(int most, Clock::time_point now) {
  if (now - route_seen_ >= between_looks_at_the_route) {
    route_seen_ = now;
    if (route_to(group_) != route_) return false;
  }
  for (int i = 0; i < most; ++i) {
    sockaddr_in from{};
    socklen_t from_bytes = sizeof from;
    const ssize_t bytes = recvfrom(receiver_.get(), datagram_.data(), datagram_.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &from_bytes);
    if (bytes >= 0) {
      take(std::span(datagram_).first(static_cast<std::size_t>(bytes)), from, now);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return true;
    } else if (errno != EINTR && errno != ENOMEM && errno != ENOBUFS) {
      return false;
    }
  }
  return true;
}

void UdpmConnection::take(std::span<const std::uint8_t> bytes, const sockaddr_in& from,
                          Clock::time_point now) {
  if (this_host_only_ && !local_.contains(from.sin_addr.s_addr, now)) return;
  const Datagram datagram = parse_datagram(bytes);
  if (const auto* message = std::get_if<ShortMessage>(&datagram)) {
    subscriptions_.deliver(message->channel, message->data);
  } else if (const auto* fragment = std::get_if<Fragment>(&datagram)) {
    take(*fragment, from, now);
  } else {
    ++malformed_;
  }
}

void UdpmConnection::take(const Fragment& fragment, const sockaddr_in& from,
                          Clock::time_point now) {
  std::size_t bytes_max = 0;
  if (fragment.number == 0) {
    bytes_max = subscriptions_.message_bytes_max(fragment.channel);
    if (bytes_max > 0 && fragment.message_bytes > bytes_max)
      return subscriptions_.refuse(fragment.channel, fragment.message_bytes);
  }
  const DatagramSource source{from.sin_addr.s_addr, from.sin_port};
  if (const auto message = reassembly_.add(source, fragment, bytes_max, now))
    subscriptions_.deliver(reassembly_.channel(), *message);
}

bool UdpmConnection::send(const std::string& channel, std::span<const std::uint8_t> message) {
  if (!writer_.begin(channel, message)) return false;
  for (auto datagram = writer_.next(); !datagram.empty(); datagram = writer_.next()) {
    ssize_t sent = -1;
    do {
      sent = sendto(sender_.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL,
                    reinterpret_cast<const sockaddr*>(&group_), sizeof group_);
    } while (sent < 0 && errno == EINTR);
    // The rest of a message without one of its fragments is of no use to anybody.
    if (sent != static_cast<ssize_t>(datagram.size())) return false;
  }
  return true;
}

}  // namespace gazed::lcm
