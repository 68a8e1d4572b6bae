#include "agent/daemon/loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <poll.h>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::daemon {

namespace {

using namespace std::chrono_literals;

constexpr auto status_period = 1s;
constexpr auto longest_wait = 100ms;    // silence and status are checked this often
constexpr auto scheduled_slice = 20ms;  // then LCM and the signals get their turn
constexpr auto wait_for_recorder = 1ms;
// How long to wait for a recording's process to write the rest: gazed must end within a second of
// being told to, and the process continues without it.
constexpr auto longest_end_of_recording = 250ms;
// Frames and head states come by different paths, so their times are not in order, but they only
// differ this much if a clock was set back.
constexpr std::int64_t set_back_us = 2'000'000;

double milliseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

std::int64_t microseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() -
                                                               start)
      .count();
}

std::int64_t wall_utime_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Loop::Loop(const settings::Settings& settings, LoopParts parts, EndSignals& signals, Report& report,
           ServiceManager& service)
    : settings_(settings),
      parts_(std::move(parts)),
      signals_(signals),
      report_(report),
      service_(service),
      cycle_(settings.rig, settings.cycle,
             {.obeys = parts_.head->obeys(), .serve = [this] { parts_.head->serve(); }}),
      publisher_(*parts_.link, settings.lcm.prefix, settings.publish,
                 {.camera = settings.camera.source.is(drivers::Origin::lcm),
                  .head = settings.head.source.is(drivers::Origin::lcm)}),
      watch_(*parts_.link, lcm::Channels(settings.lcm.prefix)),
      fast_(settings::runs_fast(settings)),
      started_(Clock::now()),
      status_due_(started_) {
  status_.camera = base::text("%s %dx%d", settings.camera.source.text().c_str(),
                              settings.rig.camera.width_px, settings.rig.camera.height_px);
  status_.head = settings.head.source.text();
}

int Loop::run() {
  for (const drivers::ExclusiveUse& use : parts_.in_use) {
    if (!use.warning().empty()) report_.note(use.warning());
  }
  first_scheduled_us_ = next_scheduled_us();
  scheduled_ = parts_.camera->next_utime_us() && parts_.head->next_utime_us();
  paced_from_us_ = scheduled_now_us_ = first_scheduled_us_.value_or(0);
  // Next to a live driver, which uses the wall clock, a simulated driver keeps to it as well,
  // however long the start took.
  if (!scheduled_) paced_from_us_ = wall_utime_us() - microseconds_since(started_);
  last_frame_s_ = last_head_state_s_ = now_s();
  if (parts_.recorder) parts_.recorder->begin();
  while (!done()) {
    parts_.link->handle();
    if (signals_.received()) break;
    serve_scheduled();
    serve_live();
    watch_silence();
    publish_status_when_due();
    report_faults();
    service_.turned();
    if (!done()) wait();
  }
  stopping_ = true;
  service_.stopping();
  if (parts_.recorder) parts_.recorder->end();  // it writes while the head comes to rest
  if (settings_.head.hold) parts_.head->hold();
  publish_status();
  if (parts_.recorder) parts_.recorder->finish(longest_end_of_recording);
  report_losses();
  const bool cut_short = parts_.camera->finished() || parts_.head->finished();
  report_.end(std::chrono::duration<double>(Clock::now() - started_).count(),
              cut_short ? in_words(cycle_.frame_counts()) : "");
  return cut_short && counted_ < settings_.run.fixations ? 1 : 0;
}

void Loop::report_losses() {
  const std::string camera = parts_.camera->notes(), head = parts_.head->notes();
  if (!camera.empty()) report_.note(camera);
  if (!head.empty() && head != camera) report_.note(head);
  if (parts_.recorder && !parts_.recorder->fault().empty()) report_.note(parts_.recorder->fault());
  if (const std::string unsent = parts_.link->notes(); !unsent.empty()) report_.note(unsent);
}

bool Loop::done() const {
  if (settings_.run.fixations > 0 && counted_ >= settings_.run.fixations) return true;
  // Whatever a finished driver still holds is processed first.
  return (parts_.camera->finished() || parts_.head->finished()) && !next_scheduled_us();
}

std::optional<std::int64_t> Loop::next_scheduled_us() const {
  const auto head = parts_.head->next_utime_us();
  const auto camera = parts_.camera->next_utime_us();
  if (head && camera) return std::min(*head, *camera);
  return head ? head : camera;
}

std::int64_t Loop::paced_now_us() const {
  return paced_from_us_ + microseconds_since(started_);
}

void Loop::serve_scheduled() {
  const Clock::time_point end = Clock::now() + scheduled_slice;
  while (!done() && Clock::now() < end && !recorder_is_full()) {
    const auto next = next_scheduled_us();
    if (!next || (!fast_ && *next > paced_now_us())) return;
    scheduled_now_us_ = *next;
    if (!serve_earliest_scheduled()) return;
    if (scheduled_) watch_silence();  // in its own time, however fast it is played
    parts_.head->serve();
  }
}

/// If time is simulated it can wait for the disk, and the recording is complete.
bool Loop::recorder_is_full() {
  return fast_ && parts_.recorder && !parts_.recorder->has_room();
}

/// Time only goes forward, unless a clock was set back.
void Loop::saw(std::int64_t utime_us) {
  if (utime_us > newest_utime_us_ || newest_utime_us_ - utime_us > set_back_us)
    newest_utime_us_ = utime_us;
}

bool Loop::serve_earliest_scheduled() {
  const auto head = parts_.head->next_utime_us();
  const auto camera = parts_.camera->next_utime_us();
  if (head && (!camera || *head <= *camera)) {
    const auto state = parts_.head->next_state();
    if (state) take_head_state(*state);
    return state.has_value();
  }
  const auto frame = parts_.camera->next_frame_if([this](std::int64_t utime_us) {
    return parts_.recorder || publisher_.publishes_images() || cycle_.may_look_at_frame(utime_us);
  });
  if (frame) take_frame(*frame);
  return true;  // a simulated camera may have dropped its frame
}

void Loop::serve_live() {
  parts_.head->serve();
  if (!parts_.head->next_utime_us()) {
    while (const auto state = parts_.head->next_state()) take_head_state(*state);
  }
  if (!parts_.camera->next_utime_us() && !done()) {
    if (const auto frame = parts_.camera->next_frame()) take_frame(*frame);
  }
}

void Loop::take_head_state(const geometry::HeadState& state) {
  const Clock::time_point start = Clock::now();
  if (!scheduled_) clocks_.saw_head_state(state.utime_us, now_s());
  cycle::CycleOutput output = cycle_.on_head_state(state);
  const double elapsed_ms = milliseconds(Clock::now() - start);
  if (output.consumed) {
    saw(state.utime_us);
    last_head_state_s_ = now_s();
    head_state_came_ = true;
    if (parts_.recorder) parts_.recorder->write(state);
    publisher_.publish(state);
    if (parts_.camera_follows) parts_.camera_follows(state);
  }
  act(output, elapsed_ms);
}

void Loop::take_frame(const geometry::Frame& frame) {
  const Clock::time_point start = Clock::now();
  if (!scheduled_) clocks_.saw_frame(frame.utime_us, now_s(), cycle_.head_angles_kept_s());
  cycle::CycleOutput output = cycle_.on_frame(frame);
  const double elapsed_ms = milliseconds(Clock::now() - start);
  if (output.consumed) {
    saw(frame.utime_us);
    ++status_.frames;
    last_frame_s_ = now_s();
    if (parts_.recorder) parts_.recorder->write(frame);
    publisher_.publish(frame);
  }
  act(output, elapsed_ms);
}

void Loop::act(cycle::CycleOutput& output, double elapsed_ms) {
  if (output.saliency) {
    if (output.saliency->first_view) effort_.saliency_ms = elapsed_ms;
    publisher_.publish(*output.saliency);
  }
  if (output.command) {
    parts_.head->command(*output.command);
    publisher_.publish(*output.command);
  }
  if (output.fixation) take_fixation(*output.fixation, elapsed_ms);
  if (cycle_.state() != published_state_) publish_status();
}

void Loop::take_fixation(cycle::Fixation& fixation, double elapsed_ms) {
  if (fixation.utime_us == 0)
    fixation.utime_us = newest_utime_us_ > 0 ? newest_utime_us_ : wall_utime_us();
  effort_.locate_ms = fixation.views >= 2 ? elapsed_ms : 0.0;
  if (fixation.counts) status_.fixations = ++counted_;
  if (fixation.status == cycle::Status::located) ++status_.located;
  const located_point_t message = to_message(fixation);
  publisher_.publish(message);
  const fixation_t account = to_fixation_message(fixation, settings_.robot);
  publisher_.publish(account);
  if (parts_.recorder) parts_.recorder->write(message, account);
  report_.fixation(fixation, message, effort_);
  if (fixation.counts && parts_.scene_goes_on) parts_.scene_goes_on();
}

double Loop::now_s() const {
  if (scheduled_) return 1e-6 * static_cast<double>(scheduled_now_us_);
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

void Loop::watch_silence() {
  const double now = now_s();
  drivers::Health camera = parts_.camera->health();
  const drivers::Health head = parts_.head->health();
  camera.add(drivers::HealthKind::refused, clocks_.fault());
  cycle::CycleOutput output = cycle_.on_silence(
      {now - last_frame_s_, now - last_head_state_s_, camera.words, head.words, now});
  act(output, 0.0);
}

void Loop::publish_status_when_due() {
  if (Clock::now() >= status_due_) publish_status();
}

void Loop::publish_status() {
  const ProcessUsage usage = meter_.read();
  published_state_ = cycle_.state();
  status_due_ = Clock::now() + status_period;
  status_.utime = newest_utime_us_ > 0 ? newest_utime_us_ : wall_utime_us();
  status_.state = cycle::name(stopping_ ? cycle::CycleState::stopping : published_state_);
  status_.frames_dropped = static_cast<std::int32_t>(std::min<std::int64_t>(
      parts_.camera->health().dropped, std::numeric_limits<std::int32_t>::max()));
  status_.saliency_ms = static_cast<float>(effort_.saliency_ms);
  status_.locate_ms = static_cast<float>(effort_.locate_ms);
  status_.cpu_percent = static_cast<float>(usage.cpu_percent);
  status_.resident_mb = static_cast<float>(usage.resident_mb);
  const Condition now = condition();
  status_.fault = faults(now);
  service_.set_status(status_line(now));
  publisher_.publish(status_);
  watch_.sent(status_);
}

Condition Loop::condition() const {
  const double now = now_s();
  drivers::Health camera = parts_.camera->health();
  camera.add(drivers::HealthKind::refused, cycle_.refused_frame());
  camera.add(drivers::HealthKind::refused, clocks_.fault());
  const bool no_camera =
      status_.frames == 0 || now - last_frame_s_ >= settings_.cycle.camera.timeout_s;
  const bool no_head =
      !head_state_came_ || now - last_head_state_s_ >= settings_.cycle.head_timeout_s;
  return {.camera = {settings_.camera.source.text(), no_camera, std::move(camera)},
          .head = {settings_.head.source.text(), no_head, parts_.head->health()},
          .lcm_url = parts_.link->url(),
          .lcm_fault = parts_.link->fault(),
          .recorder_fault = parts_.recorder ? parts_.recorder->fault() : std::string(),
          .fixations = status_.fixations,
          .located = status_.located};
}

void Loop::report_faults() {
  for (const std::string& warning :
       {watch_.warning(), parts_.camera->warning(), parts_.head->warning(), cycle_.head_warning(),
        clocks_.warning()}) {
    if (!warning.empty()) report_.note(warning);
  }
  report_.faults(faults(condition()));
}

void Loop::wait() {
  auto timeout = std::chrono::duration_cast<std::chrono::microseconds>(
      std::min(service_.longest_wait(), Clock::duration(longest_wait)));
  if (const auto next = next_scheduled_us()) {
    std::chrono::microseconds until_due{fast_ ? 0 : *next - paced_now_us()};
    if (recorder_is_full()) until_due = wait_for_recorder;
    timeout = std::clamp(until_due, std::chrono::microseconds{0}, timeout);
  }
  // Rounded up: waking too early would only mean waiting again.
  const int timeout_ms = static_cast<int>((timeout.count() + 999) / 1000);
  // poll() ignores negative descriptors.
  std::array<pollfd, 4> descriptors{{{signals_.descriptor(), POLLIN, 0},
                                     {parts_.link->descriptor(), POLLIN, 0},
                                     {parts_.camera->descriptor(), POLLIN, 0},
                                     {parts_.head->descriptor(), POLLIN, 0}}};
  poll(descriptors.data(), descriptors.size(), timeout_ms);
}

}  // namespace gazed::daemon
