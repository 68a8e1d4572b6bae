#include "drivers/lcm/multicast.hpp"

#include <algorithm>
#include <cstring>
#include <ifaddrs.h>
#include <memory>
#include <net/if.h>
#include <sys/socket.h>

#include "agent/base/file_descriptor.hpp"

namespace gazed::lcm {

namespace {

constexpr std::chrono::seconds between_readings{1};

struct FreeInterfaces {
  void operator()(ifaddrs* first) const { freeifaddrs(first); }
};
using Interfaces = std::unique_ptr<ifaddrs, FreeInterfaces>;

Interfaces interfaces() {
  ifaddrs* first = nullptr;
  return Interfaces(getifaddrs(&first) == 0 ? first : nullptr);
}

/// Of an interface's entry; none where it is not of IPv4.
std::optional<in_addr_t> address_of(const ifaddrs& entry) {
  if (entry.ifa_addr == nullptr || entry.ifa_addr->sa_family != AF_INET) return std::nullopt;
  sockaddr_in address{};
  std::memcpy(&address, entry.ifa_addr, sizeof address);
  return address.sin_addr.s_addr;
}

int interface_with(in_addr_t address) {
  const Interfaces all = interfaces();
  for (const ifaddrs* entry = all.get(); entry != nullptr; entry = entry->ifa_next) {
    if (address_of(*entry) == address) return static_cast<int>(if_nametoindex(entry->ifa_name));
  }
  return 0;
}

}  // namespace

std::optional<MulticastRoute> route_to(const sockaddr_in& group) {
  // Connecting a UDP socket asks the kernel's routes, no more.
  const base::FileDescriptor probe(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (probe.get() < 0) return std::nullopt;
  sockaddr_in own{};
  socklen_t size = sizeof own;
  if (connect(probe.get(), reinterpret_cast<const sockaddr*>(&group), sizeof group) != 0 ||
      getsockname(probe.get(), reinterpret_cast<sockaddr*>(&own), &size) != 0)
    return std::nullopt;
  return MulticastRoute{own.sin_addr.s_addr, interface_with(own.sin_addr.s_addr)};
}

void LocalAddresses::read() {
  addresses_.clear();
  const Interfaces all = interfaces();
  for (const ifaddrs* entry = all.get(); entry != nullptr; entry = entry->ifa_next) {
    if (const auto address = address_of(*entry)) addresses_.push_back(*address);
  }
}

bool LocalAddresses::contains(in_addr_t address, Clock::time_point now) {
  // Multicast that the loopback interface carries has no source: its address is no use elsewhere.
  // From a wire the kernel takes neither (RFC 1122, section 3.2.1.3).
  constexpr std::uint32_t loopback_net = 127;
  if (address == INADDR_ANY || ntohl(address) >> 24 == loopback_net) return true;
  const auto known = [&] { return std::ranges::find(addresses_, address) != addresses_.end(); };
  if (read_at_ && (known() || now - *read_at_ < between_readings)) return known();
  read_at_ = now;
  read();
  return known();
}

}  // namespace gazed::lcm
