// Which LCM network is used.
//
// An LCM URL is provider://network?option=value&option=value. The provider that robots use is udpm:
// UDP multicast to ADDRESS:PORT; its option ttl says how many routers a message may pass (0: it
// stays on this machine), recv_buf_size how much the kernel keeps for a reader that is late, bytes.
#pragma once

#include <netinet/in.h>
#include <optional>
#include <string>

namespace gazed::lcm {

/// The URL in use: `configured`, else the environment's LCM_DEFAULT_URL, else
/// udpm://239.255.76.67:7667?ttl=0. When images are received, a udpm URL without a recv_buf_size
/// gets 4,000,000 bytes: frames come in bursts of several times the kernel's usual 212,992.
/// Throws std::invalid_argument for a provider, a multicast address, a port or an option that
/// cannot be.
[[nodiscard]] std::string effective_lcm_url(const std::string& configured, bool receives_images);

/// A udpm URL taken apart.
struct UdpmUrl {
  sockaddr_in group{};  // address and port; LCM's own where the URL has none
  int ttl = 0;          // routers that a message may pass, 0 to 255
  std::optional<int> receive_buffer_bytes;
};
/// None for another provider. Throws std::invalid_argument for an address, a port or an option that
/// cannot be.
[[nodiscard]] std::optional<UdpmUrl> parse_udpm_url(const std::string& url);

/// A warning for the person who runs gazed if the kernel will not give the receive buffer that
/// `url` asks for; else empty. `rmem_max_file` is where the kernel says its limit.
[[nodiscard]] std::string receive_buffer_warning(
    const std::string& url, const std::string& rmem_max_file = "/proc/sys/net/core/rmem_max");

}  // namespace gazed::lcm
