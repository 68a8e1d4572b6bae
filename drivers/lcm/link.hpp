// One LCM connection, shared by camera, head and publisher.
//
// The network may not be there when the daemon starts, and it may go: an LcmLink is always usable.
// What cannot be sent is counted and said in fault(), and the connection is made, and made again,
// as soon as the network allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drivers/lcm/connection.hpp"
#include "drivers/lcm/subscriptions.hpp"

namespace gazed::lcm {

class LcmLink {
 public:
  using Clock = Connection::Clock;

  /// `url` as effective_lcm_url() gives it. Tries to connect at once; does not throw when that
  /// fails.
  explicit LcmLink(std::string url, Clock::time_point now = Clock::now());

  LcmLink(const LcmLink&) = delete;
  LcmLink& operator=(const LcmLink&) = delete;

  /// Calls `handler` from handle() for every message on `channel`, also after a reconnection. A
  /// message of more than `message_bytes_max` bytes is refused before anything is done with it.
  void subscribe(const std::string& channel, std::size_t message_bytes_max, Handler handler) {
    subscribe(Subscription{channel, message_bytes_max, std::move(handler), {}});
  }
  void subscribe(Subscription subscription);

  /// Hands the messages that have come to their handlers, and connects again when that is due (1 s
  /// after the first failure, then 2, 4, 8, 10, 10 s ...). Never waits with a udpm URL; liblcm,
  /// which serves the others, may while it connects. To be called when descriptor() is readable and
  /// at least once a second.
  void handle(Clock::time_point now = Clock::now());

  /// Readable when handle() has something to do; -1 while there is no connection. May change with
  /// every call of handle().
  [[nodiscard]] int descriptor() const { return connection_ ? connection_->descriptor() : -1; }

  /// Sends a message of a type that lcm-gen made. False when it could not be sent; never throws.
  template <class Message>
  bool publish(const std::string& channel, const Message& message) {
    encoded_.resize(static_cast<std::size_t>(message.getEncodedSize()));
    const int size = static_cast<int>(encoded_.size());
    return message.encode(encoded_.data(), 0, size) == size && publish_bytes(channel, encoded_);
  }
  bool publish_bytes(const std::string& channel, std::span<const std::uint8_t> message);

  [[nodiscard]] const std::string& url() const { return url_; }
  [[nodiscard]] bool connected() const { return connection_ != nullptr; }
  /// Packets that are not LCM's, and messages that are larger than their type, so far; they reach
  /// no handler.
  [[nodiscard]] std::int64_t malformed_packets() const;
  /// What is wrong and what to do about it, in words; empty when all is well.
  [[nodiscard]] std::string fault() const;
  /// How many messages could not be sent so far, in words; empty when all were.
  [[nodiscard]] std::string notes() const;

 private:
  [[nodiscard]] std::unique_ptr<Connection> open(Clock::time_point now);
  void connect(Clock::time_point now);
  void disconnect();
  void give_up_a_lost_network(Clock::time_point now);

  std::string url_;
  Subscriptions subscriptions_;
  std::unique_ptr<Connection> connection_;

  Clock::duration back_off_{};
  Clock::time_point next_attempt_{};
  bool last_publish_failed_ = false;
  bool subscription_failed_ = false;
  std::optional<Clock::time_point> failing_since_;

  std::int64_t publish_failures_ = 0;  // messages so far
  std::int64_t malformed_before_ = 0;  // of connections that ended
  std::vector<std::uint8_t> encoded_;  // reused by every publish()
};

}  // namespace gazed::lcm
