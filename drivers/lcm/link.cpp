#include "drivers/lcm/link.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "agent/base/counted.hpp"
#include "drivers/lcm/other_providers.hpp"
#include "drivers/lcm/udpm_connection.hpp"
#include "drivers/lcm/url.hpp"

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

}  // namespace

LcmLink::LcmLink(std::string url, Clock::time_point now) : url_(std::move(url)) {
  connect(now);
}

void LcmLink::subscribe(Subscription subscription) {
  const Subscription& made = subscriptions_.add(std::move(subscription));
  // Seen by the next handle(): a connection that cannot receive is made anew.
  if (connection_ && !connection_->read_channel(made)) subscription_failed_ = true;
}

std::unique_ptr<Connection> LcmLink::open(Clock::time_point now) {
  if (const auto udpm = parse_udpm_url(url_))
    return UdpmConnection::open(*udpm, subscriptions_, now);
  return open_other_provider(url_, subscriptions_);
}

void LcmLink::connect(Clock::time_point now) {
  const Clock::time_point began = Clock::now();
  connection_ = open(now);
  if (connection_) {
    back_off_ = {};
    return;
  }
  back_off_ = std::clamp(2 * back_off_, first_back_off, longest_back_off);
  // Counted from the failure: liblcm's providers can take seconds for one, and other work waits.
  next_attempt_ = now + std::chrono::floor<std::chrono::seconds>(Clock::now() - began) + back_off_;
}

void LcmLink::disconnect() {
  malformed_before_ += connection_ ? connection_->malformed_packets() : 0;
  connection_.reset();
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
  if (connection_) give_up_a_lost_network(now);
  if (!connection_ && now >= next_attempt_) connect(now);
  if (!connection_ || connection_->receive(most_messages_a_call, now)) return;
  disconnect();
  next_attempt_ = now + first_back_off;
}

bool LcmLink::publish_bytes(const std::string& channel, std::span<const std::uint8_t> message) {
  const bool sent = connection_ && connection_->send(channel, message);
  last_publish_failed_ = !sent;
  if (!sent) ++publish_failures_;
  return sent;
}

std::int64_t LcmLink::malformed_packets() const {
  return malformed_before_ + subscriptions_.refused() +
         (connection_ ? connection_->malformed_packets() : 0);
}

std::string LcmLink::notes() const {
  if (publish_failures_ == 0) return {};
  return "LCM: " + base::counted(publish_failures_, "message") + " could not be sent";
}

std::string LcmLink::fault() const {
  if (connection_ && !last_publish_failed_) return {};
  std::string text = connection_ ? "LCM cannot send to " + url_
                                 : "no LCM connection to " + url_ + " (trying again)";
  if (publish_failures_ > 0) text += "; " + base::counted(publish_failures_, "message") + " lost";
  if (url_.starts_with("udpm:")) {
    text +=
        ". Is there a route for multicast? For this machine alone, as root: ip link set lo up && "
        "ip route add 224.0.0.0/4 dev lo";
  }
  return text;
}

}  // namespace gazed::lcm
