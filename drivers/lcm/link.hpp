// One LCM connection, shared by camera, head and publisher.
//
// LCM gives up when the network is not there: lcm_create() fails without a multicast route, and a
// daemon that starts before the network is up would have to be started again. An LcmLink is always
// usable: what cannot be sent is counted and said in fault(), and the connection is made, and made
// again, as soon as the network allows.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <lcm/lcm.h>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gazed::lcm {

class LcmLink {
 public:
  using Clock = std::chrono::steady_clock;
  /// Gets the bytes of one message, valid during the call. Must not throw: it is called from C.
  using Handler = std::function<void(std::span<const std::uint8_t> message)>;

  /// `url` as effective_lcm_url() gives it. Tries to connect at once; does not throw when that
  /// fails.
  explicit LcmLink(std::string url, Clock::time_point now = Clock::now());

  LcmLink(const LcmLink&) = delete;
  LcmLink& operator=(const LcmLink&) = delete;

  /// Calls `handler` from handle() for every message on `channel`, also after a reconnection.
  /// Up to `queue_capacity` messages wait between two calls of handle(); newer ones are lost.
  void subscribe(const std::string& channel, Handler handler, int queue_capacity = 30);

  /// Hands the messages that have come to their handlers, and connects again when that is due (1 s
  /// after the first failure, then 2, 4, 8, 10, 10 s ...). Never waits for a message. To be called
  /// when descriptor() is readable and at least once a second. (Connecting itself can take liblcm
  /// up to 10 s, when a firewall swallows the message that it sends to itself.)
  void handle(Clock::time_point now = Clock::now());

  /// Readable when handle() has something to do; -1 while there is no connection. May change with
  /// every call of handle().
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Sends a message of a type that lcm-gen made. False when it could not be sent; never throws.
  template <class Message>
  bool publish(const std::string& channel, const Message& message) {
    encoded_.resize(static_cast<std::size_t>(message.getEncodedSize()));
    const int size = static_cast<int>(encoded_.size());
    return message.encode(encoded_.data(), 0, size) == size && publish_bytes(channel, encoded_);
  }
  bool publish_bytes(const std::string& channel, std::span<const std::uint8_t> message);

  [[nodiscard]] const std::string& url() const { return url_; }
  [[nodiscard]] bool connected() const { return lcm_ != nullptr; }
  /// Messages that could not be sent so far.
  [[nodiscard]] std::int64_t publish_failures() const { return publish_failures_; }
  /// Packets whose size cannot be, so far; they reach no handler.
  [[nodiscard]] std::int64_t malformed_packets() const { return malformed_packets_; }
  /// What is wrong and what to do about it, in words; empty when all is well.
  [[nodiscard]] std::string fault() const;

 private:
  struct Subscription {
    LcmLink* link;
    std::string channel;
    Handler handler;
    int queue_capacity;
  };
  struct Destroy {
    void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
  };

  static void deliver(const lcm_recv_buf_t* buffer, const char* channel, void* subscription);
  void connect(Clock::time_point now);
  void disconnect();
  bool open();
  bool subscribe_now(Subscription& subscription);
  void give_up_a_lost_network(Clock::time_point now);

  std::string url_;
  std::list<Subscription> subscriptions_;  // a list: liblcm keeps their addresses
  std::unique_ptr<lcm_t, Destroy> lcm_;
  int descriptor_ = -1;

  Clock::duration back_off_{};
  Clock::time_point next_attempt_{};
  bool last_publish_failed_ = false;
  bool subscription_failed_ = false;
  std::optional<Clock::time_point> failing_since_;

  std::int64_t publish_failures_ = 0;
  std::int64_t malformed_packets_ = 0;
  std::vector<std::uint8_t> encoded_;  // reused by every publish()
};

}  // namespace gazed::lcm
