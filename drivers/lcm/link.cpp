#include "drivers/lcm/link.hpp"

#include <algorithm>
#include <utility>

#include "agent/base/counted.hpp"

namespace gazed::lcm {

namespace {

using namespace std::chrono_literals;

constexpr LcmLink::Clock::duration first_back_off = 1s;
constexpr LcmLink::Clock::duration longest_back_off = 10s;
// A cable or a radio that comes back within this time keeps its multicast membership, and the
// connection with it; after a longer failure it is made anew.
constexpr LcmLink::Clock::duration longest_publish_failure = 3s;
// So that a flood of messages cannot keep the loop from its other work.
constexpr int most_messages_a_call = 64;
// lcm/lcm_udpm.c, LCM_MAX_MESSAGE_SIZE. liblcm 1.3.1 gives a packet without an end of its channel
// name a size below zero, which arrives here as one near 2^32.
constexpr std::uint32_t largest_message_bytes = 1U << 28;

}  // namespace

LcmLink::LcmLink(std::string url, Clock::time_point now) : url_(std::move(url)) {
  connect(now);
}

void LcmLink::subscribe(const std::string& channel, Handler handler, int queue_capacity) {
  subscriptions_.push_back({this, channel, std::move(handler), queue_capacity});
  // Seen by the next handle(): a connection that cannot receive is made anew.
  if (lcm_ && !subscribe_now(subscriptions_.back())) subscription_failed_ = true;
}

bool LcmLink::subscribe_now(Subscription& subscription) {
  lcm_subscription_t* made =
      lcm_subscribe(lcm_.get(), subscription.channel.c_str(), &LcmLink::deliver, &subscription);
  if (made == nullptr) return false;
  lcm_subscription_set_queue_capacity(made, subscription.queue_capacity);
  return true;
}

void LcmLink::deliver(const lcm_recv_buf_t* buffer, const char* /*channel*/, void* subscription) {
  const auto* to = static_cast<const Subscription*>(subscription);
  if (buffer->data_size > largest_message_bytes) {
    ++to->link->malformed_packets_;
    return;
  }
  to->handler({static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

bool LcmLink::open() {
  lcm_.reset(lcm_create(url_.c_str()));
  if (!lcm_) return false;
  for (Subscription& subscription : subscriptions_) {
    if (!subscribe_now(subscription)) return false;
  }
  descriptor_ = lcm_get_fileno(lcm_.get());
  return descriptor_ >= 0;
}

void LcmLink::connect(Clock::time_point now) {
  const Clock::time_point began = Clock::now();
  if (open()) {
    back_off_ = {};
    return;
  }
  disconnect();
  back_off_ = std::clamp(2 * back_off_, first_back_off, longest_back_off);
  // Counted from the failure: liblcm can take 10 s for one, and other work waits.
  next_attempt_ = now + std::chrono::floor<std::chrono::seconds>(Clock::now() - began) + back_off_;
}

void LcmLink::disconnect() {
  lcm_.reset();
  descriptor_ = -1;
  last_publish_failed_ = false;
  subscription_failed_ = false;
  failing_since_.reset();
}

void LcmLink::give_up_a_lost_network(Clock::time_point now) {
  if (subscription_failed_) return disconnect();
  if (!last_publish_failed_) {
    failing_since_.reset();
  } else if (!failing_since_) {
    failing_since_ = now;
  } else if (now - *failing_since_ >= longest_publish_failure && url_.starts_with("udpm:")) {
    disconnect();
  }
}

void LcmLink::handle(Clock::time_point now) {
  if (lcm_) give_up_a_lost_network(now);
  if (!lcm_ && now >= next_attempt_) connect(now);
  for (int i = 0; lcm_ && i < most_messages_a_call; ++i) {
    const int handled = lcm_handle_timeout(lcm_.get(), 0);
    if (handled == 0) return;
    if (handled < 0) {
      disconnect();
      next_attempt_ = now + first_back_off;
    }
  }
}

bool LcmLink::publish_bytes(const std::string& channel, std::span<const std::uint8_t> message) {
  const bool sent = lcm_ && lcm_publish(lcm_.get(), channel.c_str(), message.data(),
                                        static_cast<unsigned>(message.size())) == 0;
  last_publish_failed_ = !sent;
  if (!sent) ++publish_failures_;
  return sent;
}

std::string LcmLink::fault() const {
  if (lcm_ && !last_publish_failed_) return {};
  std::string text =
      lcm_ ? "LCM cannot send to " + url_ : "no LCM connection to " + url_ + " (trying again)";
  if (publish_failures_ > 0) text += "; " + base::counted(publish_failures_, "message") + " lost";
  if (url_.starts_with("udpm:")) {
    text +=
        ". Is there a route for multicast? For this machine alone, as root: ip link set lo up && "
        "ip route add 224.0.0.0/4 dev lo";
  }
  return text;
}

}  // namespace gazed::lcm
