#include "drivers/lcm/subscriptions.hpp"

#include <algorithm>
#include <utility>

namespace gazed::lcm {

const Subscription& Subscriptions::add(Subscription subscription) {
  return all_.emplace_back(std::move(subscription));
}

std::size_t Subscriptions::message_bytes_max(std::string_view channel) const {
  std::size_t most = 0;
  for (const Subscription& one : all_) {
    if (one.channel == channel) most = std::max(most, one.message_bytes_max);
  }
  return most;
}

void Subscriptions::refuse(std::string_view channel, std::size_t message_bytes) {
  ++refused_;
  for (const Subscription& one : all_) {
    if (one.channel == channel && one.refused) one.refused(message_bytes);
  }
}

void Subscriptions::deliver(std::string_view channel, std::span<const std::uint8_t> message) {
  const std::size_t most = message_bytes_max(channel);
  if (most == 0) return;
  if (message.size() > most) return refuse(channel, message.size());
  for (const Subscription& one : all_) {
    if (one.channel == channel) one.handler(message);
  }
}

}  // namespace gazed::lcm
