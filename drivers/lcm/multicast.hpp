// Which of this host's interfaces leads to a multicast group, and what this host's addresses are.
#pragma once

#include <chrono>
#include <cstdint>
#include <netinet/in.h>
#include <optional>
#include <vector>

namespace gazed::lcm {

/// The way to a multicast group.
struct MulticastRoute {
  in_addr_t address = 0;    // of this host on the interface, network order
  int interface_index = 0;  // 0: the interface is not known
  bool operator==(const MulticastRoute&) const = default;
};

/// None without a route. Sends nothing.
[[nodiscard]] std::optional<MulticastRoute> route_to(const sockaddr_in& group);

/// The addresses of this host, as they are from time to time.
class LocalAddresses {
 public:
  using Clock = std::chrono::steady_clock;

  /// Addresses that come while gazed runs are seen after a second at most.
  [[nodiscard]] bool contains(in_addr_t address, Clock::time_point now);

 private:
  void read();

  std::vector<in_addr_t> addresses_;
  std::optional<Clock::time_point> read_at_;
};

}  // namespace gazed::lcm
