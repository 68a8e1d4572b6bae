// Where a program of another computer listens: an IPv4 address and a TCP port.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gazed::base {

struct Endpoint {
  std::uint32_t address = 0;  // 127.0.0.1 is 0x7f000001
  std::uint16_t port = 0;

  [[nodiscard]] bool is_this_computer() const { return address >> 24 == 127; }
  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// "HOST" or "HOST:PORT"; HOST is four numbers or `localhost`, which is 127.0.0.1. Nothing for any
/// other name: to look one up blocks, for as long as the network likes.
[[nodiscard]] std::optional<Endpoint> parse_endpoint(std::string_view text,
                                                     std::uint16_t default_port);

/// "127.0.0.1:9559".
[[nodiscard]] std::string to_string(const Endpoint& endpoint);

}  // namespace gazed::base
