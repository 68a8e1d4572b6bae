#include "drivers/log/recorder.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <memory>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "agent/base/counted.hpp"
#include "drivers/lcm/conversions.hpp"

namespace gazed::log {

namespace {

using namespace std::chrono_literals;

constexpr auto between_starts = 1s;
// Four frames of 640x480 pixels in RGB, or six in YUYV; of larger frames four.
constexpr std::size_t ring_bytes_min = std::size_t{1} << 22;
constexpr std::size_t ring_frames = 4;
constexpr std::size_t beside_the_pixels = 1000;  // of a frame's message: a dozen numbers, no texts
constexpr std::size_t state_bytes = 4096;        // before the ring, a page

[[noreturn]] void refuse(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

std::size_t ring_bytes(std::size_t frame_event_bytes) {
  return std::max(ring_bytes_min, std::bit_ceil(ring_frames * frame_event_bytes));
}

}  // namespace

Recorder::Shared::Shared(std::size_t ring_bytes) : ring_bytes_(ring_bytes) {
  static_assert(sizeof(RecordingState) <= state_bytes);
  void* memory = mmap(nullptr, state_bytes + ring_bytes, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) refuse("memory for a recording");
  state_ = std::construct_at(static_cast<RecordingState*>(memory));
}

Recorder::Shared::~Shared() {
  munmap(state_, state_bytes + ring_bytes_);
}

std::span<std::uint8_t> Recorder::Shared::ring() const {
  return {reinterpret_cast<std::uint8_t*>(state_) + state_bytes, ring_bytes_};
}

Recorder::Recorder(RecorderSettings settings, const lcm::Channels& channels)
    : settings_(std::move(settings)),
      configuration_channel_(channels.configuration),
      image_channel_(channels.image),
      frame_event_bytes_(EventRing::bytes_of(channels.image.size(),
                                             settings_.frame_bytes_max + beside_the_pixels)),
      shared_(ring_bytes(frame_event_bytes_)),
      ring_(shared_.ring(), shared_.state().positions),
      encoder_(channels) {
  refuse_what_is_no_file(settings_.path);
  start();
  if (process_ < 0) refuse("a process for the recording");
}

Recorder::~Recorder() {
  finish(Clock::duration::zero());
}

void Recorder::start() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0) return;
  const base::FileDescriptor its_end(ends[0]);
  connection_ = base::FileDescriptor(ends[1]);
  process_ = fork();
  if (process_ != 0) return;
  connection_ = base::FileDescriptor(-1);
  run_recording_process(RecordingProcess({settings_.path, configuration_channel_,
                                          settings_.configuration, settings_.keep_bytes},
                                         ring_, shared_.state()),
                        its_end.get());
}

void Recorder::begin() {
  wake();
}

void Recorder::wake() {
  if (end_) return;
  constexpr char byte = 0;
  if (send(connection_.get(), &byte, 1, MSG_NOSIGNAL) == 1) return;
  // Without a wake it looks at the ring twice a second. A second process beside a living one would
  // take the same events.
  const bool was_ended = errno == EPIPE || errno == ECONNRESET;
  if (!was_ended) return;
  // By somebody else. What waits in the ring is for the next one.
  const Clock::time_point now = Clock::now();
  if (now < next_start_) return;
  next_start_ = now + between_starts;
  ++ended_;
  waitpid(process_, nullptr, WNOHANG);
  start();
  static_cast<void>(send(connection_.get(), &byte, 1, MSG_NOSIGNAL));
}

/// Made in the ring: a copy of a frame's message would be the largest thing that is held for it.
void Recorder::write(const geometry::Frame& frame) {
  encoder_.saw(frame.utime_us);
  const auto message = ring_.begin_to_add(image_channel_, frame.utime_us,
                                          lcm::encoded_bytes(frame.image), spare_for_the_rest);
  if (message.empty()) {
    ++dropped_;
  } else {
    lcm::encode_image(frame, message);
    ring_.end_to_add();
  }
  wake();
}

void Recorder::add(const Event& event, std::size_t spare_bytes) {
  if (!ring_.add(event, spare_bytes)) ++dropped_;
  wake();
}

bool Recorder::has_room() {
  if (ring_.has_room(frame_event_bytes_, spare_for_the_rest)) return true;
  wake();  // a process that was ended makes no room
  return false;
}

void Recorder::end() {
  if (end_) return;
  connection_ = base::FileDescriptor(-1);
  end_ = Clock::now();
}

void Recorder::finish(Clock::duration at_most) {
  end();
  if (process_ < 0) return;
  while (waitpid(process_, nullptr, WNOHANG) == 0 && Clock::now() < *end_ + at_most)
    poll(nullptr, 0, 1);
}

std::string Recorder::fault() const {
  const RecordingState& state = shared_.state();
  const LogTrouble trouble{state.trouble.load(), state.error.load()};
  if (trouble) return words(trouble, settings_.path, state.events_in_file.load());
  const std::string recording = "the recording " + settings_.path;
  std::string all;
  const auto add = [&all](const std::string& text) { all += (all.empty() ? "" : "; ") + text; };
  const std::int64_t lost = dropped_ + state.lost.load();
  if (lost > 0) add(recording + " lacks " + base::counted(lost, "event"));
  if (state.removed.load() > 0)
    add(recording + " was removed or renamed while it was written, and begun anew");
  if (ended_ > 0) add("the process that writes " + recording + " was ended, and started again");
  return all;
}

}  // namespace gazed::log
