#include "drivers/lcm/lcm_head.hpp"

#include "drivers/head_guard.hpp"
#include "drivers/lcm/conversions.hpp"
#include "msgs/gazed/head_state_t.hpp"

namespace gazed::lcm {

LcmHead::LcmHead(LcmLink& link, const Channels& channels)
    : link_(link), command_channel_(channels.head_command), intake_(channels.head_state) {
  const auto bytes = static_cast<std::size_t>(head_state_t().getEncodedSize());
  link_.subscribe(channels.head_state, bytes,
                  [this](auto message) { intake_.take(message, clocks_.realtime_us()); });
}

std::optional<geometry::HeadState> LcmHead::next_state() {
  link_.handle();
  return intake_.next_state();
}

void LcmHead::command(const geometry::HeadCommand& command) {
  const auto admitted = drivers::admit(command);
  if (!admitted) {
    command_fault_ = drivers::why_not_admitted(command);
    return;
  }
  command_fault_.clear();
  last_command_ = admitted;
  to_message(*admitted, message_);
  last_command_failed_ = !link_.publish(command_channel_, message_);
}

void LcmHead::hold() {
  if (!last_command_ || !intake_.newest()) return;  // it was never moved: nothing to stop
  geometry::HeadCommand stay = *last_command_;
  stay.utime_us = intake_.newest()->utime_us;
  stay.target = intake_.newest()->measured;
  command(stay);
}

drivers::Health LcmHead::health() const {
  drivers::Health health;
  if (!link_.connected()) {
    health.add(drivers::HealthKind::no_link, link_.fault());
  } else if (last_command_failed_) {
    health.add(drivers::HealthKind::no_link,
               "the last head command could not be sent: " + link_.fault());
  } else if (intake_.refusals().last_was_refused()) {
    health.add(drivers::HealthKind::refused, intake_.refusals().text());
  }
  health.add(drivers::HealthKind::disobeyed, command_fault_);
  return health;
}

}  // namespace gazed::lcm
