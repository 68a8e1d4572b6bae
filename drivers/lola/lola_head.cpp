#include "drivers/lola/lola_head.hpp"

#include <algorithm>
#include <limits>
#include <poll.h>
#include <utility>

#include "agent/base/counted.hpp"
#include "drivers/lola/order_packet.hpp"
#include "drivers/lola/state_check.hpp"

namespace gazed::lola {

namespace {

// More than the 90 packets or so that a socket's buffer holds; an endless stream must not block the
// loop.
constexpr int most_packets_at_once = 256;
// Four times as long as at LoLA's rate, in case the loop is late and the machine busy.
constexpr std::int64_t letting_go_us = 2'000'000;
constexpr int letting_go_poll_ms = 20;

geometry::HeadState head_state(const LolaState& state) {
  constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();
  return {
      .measured = state.head(),
      .velocity_rad_s = {not_measured, not_measured},
      .stiffness = std::min(state.stiffness[head_yaw], state.stiffness[head_pitch]),
      .temperature_c = std::max(state.temperature_c[head_yaw], state.temperature_c[head_pitch])};
}

/// Age of the newest state that waited while nobody read. Usually they came until now. After a
/// pause that filled the socket's buffer (about 90 packets by default), LoLA stopped writing
/// (rUNSWift 2022, LoLAEffector.cpp: until it is connected to again), and the buffer holds the
/// first ones.
std::int64_t age_us(int states, std::int64_t pause_us) {
  constexpr std::int64_t longest_without_loss_us = 1'000'000;
  if (pause_us <= longest_without_loss_us) return 0;
  return std::max<std::int64_t>(0, pause_us - states * lola_cycle_us);
}

}  // namespace

LolaHead::LolaHead(const LolaSettings& settings, drivers::Clocks clocks)
    : clocks_(std::move(clocks)), link_(settings.socket), control_(settings.other_joints) {}

void LolaHead::serve() {
  const std::int64_t now_us = clocks_.monotonic_us();
  if (link_.connect_when_due(now_us)) {
    control_.interrupt();
    served_us_ = now_us;
  }
  int packets = 0, states = 0;
  for (; packets < most_packets_at_once; ++packets) {
    const auto packet = link_.receive(now_us);
    if (!packet) break;
    if (take(*packet, now_us)) ++states;
  }
  const std::int64_t pause_us = now_us - std::exchange(served_us_, now_us);
  // more are waiting, so the age of these is unknown
  if (packets == most_packets_at_once) queue_.discard();
  if (states == 0 || packets == most_packets_at_once) return;
  const auto order = control_.answer(newest_, now_us);
  if (order) {
    queue_.stamp(clocks_.realtime_us() - age_us(states, pause_us));
    link_.send(order_packet(*order), now_us);
  } else {
    queue_.discard();
  }
}

bool LolaHead::take(StatePacket packet, std::int64_t now_us) {
  const auto state = parser_.parse(packet);
  if (!state) {
    // It is unknown where the next packet begins.
    ++refused_;
    link_.lose("what came is no state of LoLA's: " + parser_.problem(), now_us);
    return false;
  }
  link_.approve();
  refusal_ = implausible(*state);
  if (!refusal_.empty()) {
    ++refused_;
    control_.interrupt();
    return false;
  }
  newest_ = *state;
  queue_.add(head_state(newest_));
  return true;
}

void LolaHead::let_go() {
  if (std::exchange(letting_go_, true)) return;
  control_.let_go();
  serve_until(
      [this] { return !link_.connected() || !control_.silence().empty() || control_.has_let_go(); },
      letting_go_us);
}

std::string LolaHead::release(std::chrono::milliseconds at_most) {
  letting_go_ = true;
  control_.release();
  serve_until([this] { return control_.is_limp(); }, std::chrono::microseconds(at_most).count());
  if (control_.is_limp()) return {};
  const drivers::Health why = health();
  return why.ok() ? "LoLA was not heard in time" : why.words;
}

/// For the end, when the loop no longer runs.
void LolaHead::serve_until(const std::function<bool()>& done, std::int64_t at_most_us) {
  const std::int64_t end_us = clocks_.monotonic_us() + at_most_us;
  while (!done() && clocks_.monotonic_us() < end_us) {
    pollfd socket{descriptor(), POLLIN, 0};
    ::poll(&socket, 1, letting_go_poll_ms);
    serve();
  }
}

drivers::Health LolaHead::health() const {
  drivers::Health health{.dropped = queue_.dropped()};
  health.add(drivers::HealthKind::lost, link_.fault());
  if (health.ok()) health.add(drivers::HealthKind::refused, refusal_);
  if (health.ok()) health.add(drivers::HealthKind::no_data, control_.silence());
  if (health.ok()) health.add(drivers::HealthKind::disobeyed, control_.fault());
  return health;
}

std::string LolaHead::notes() const {
  std::string notes;
  const auto add = [&notes](std::int64_t number, const char* noun, const char* what) {
    if (number > 0) notes += (notes.empty() ? "lola: " : ", ") + base::counted(number, noun) + what;
  };
  add(std::max<std::int64_t>(link_.connections() - 1, 0), "connection", " lost");
  add(refused_, "packet", " refused");
  add(queue_.dropped(), "state", " dropped");
  add(control_.refused_commands(), "command", " refused");
  if (letting_go_ && !control_.has_let_go())
    notes +=
        std::string(notes.empty() ? "lola: " : ", ") + "the head was not given back its stiffness";
  return notes;
}

}  // namespace gazed::lola
