// Which channels are read, how large their messages can be, and who gets them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <span>
#include <string>
#include <string_view>

namespace gazed::lcm {

/// Gets the bytes of one message, valid during the call. Must not throw: it may be called from C.
using Handler = std::function<void(std::span<const std::uint8_t> message)>;

struct Subscription {
  std::string channel;
  /// What its type can need; a larger message is refused before anything is done with it.
  std::size_t message_bytes_max = 0;
  Handler handler;
  /// Gets the size of a message that was refused for it; may be empty.
  std::function<void(std::size_t message_bytes)> refused;
};

class Subscriptions {
 public:
  const Subscription& add(Subscription subscription);

  /// The most that a message on `channel` may have; 0 where nobody reads it.
  [[nodiscard]] std::size_t message_bytes_max(std::string_view channel) const;
  /// Tells those who read `channel` that a message of this size will not come.
  void refuse(std::string_view channel, std::size_t message_bytes);

  /// Hands a message to those who read its channel; one that is too large is refused.
  void deliver(std::string_view channel, std::span<const std::uint8_t> message);

  /// Messages that were refused for their size so far.
  [[nodiscard]] std::int64_t refused() const { return refused_; }

  [[nodiscard]] const std::list<Subscription>& all() const { return all_; }

 private:
  std::list<Subscription> all_;  // a list: liblcm keeps their addresses
  std::int64_t refused_ = 0;
};

}  // namespace gazed::lcm
