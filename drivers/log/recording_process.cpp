#include "drivers/log/recording_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/prctl.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "drivers/log/older_logs.hpp"

namespace gazed::log {

namespace {

using namespace std::chrono_literals;

constexpr auto between_attempts = 1s;
constexpr auto until_it_is_free = 100ms;  // a gazed that was just ended still writes the rest
constexpr auto between_syncs = 2s;        // of a robot that falls over, this much may be missing
constexpr int turn_ms = 500;

/// A disk without room can have some later; anything else wants the file opened anew.
bool is_want_of_room(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

/// Sockets, devices and locks of the gazed that it was forked from end with that one, and so does
/// what reads gazed's output.
void keep_open_only(int connection) {
  std::vector<int> open;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none))
    open.push_back(std::atoi(entry.path().filename().c_str()));
  for (const int descriptor : open) {
    if (descriptor > STDERR_FILENO && descriptor != connection) close(descriptor);
  }
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    static_cast<void>(dup2(nowhere, descriptor));
  if (nowhere > STDERR_FILENO) close(nowhere);
}

void take_no_signals() {
  // They reach all of a terminal's or a service's processes; this one ends after gazed.
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file of the greatest size allowed is a trouble like others
}

/// Waits for bytes; with a negative time for ever. False when the connection has ended.
bool wait_for_bytes(int connection, int at_most_ms) {
  pollfd readable{connection, POLLIN, 0};
  poll(&readable, 1, at_most_ms);
  std::array<char, 512> bytes{};
  const ssize_t count = read(connection, bytes.data(), bytes.size());
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

}  // namespace

RecordingProcess::RecordingProcess(RecordingPlan plan, EventRing ring, RecordingState& state)
    : plan_(std::move(plan)),
      ring_(ring),
      state_(state),
      file_(plan_.path, plan_.configuration_channel, plan_.configuration) {}

void RecordingProcess::tell(const LogTrouble& trouble, Clock::time_point now) {
  state_.events_in_file.store(static_cast<std::uint32_t>(file_.events()));
  state_.error.store(trouble.error);
  state_.trouble.store(trouble.kind);
  if (!trouble) return;
  const bool is_in_use = trouble.kind == LogTrouble::Kind::in_use;
  next_attempt_ =
      now + (is_in_use ? RecordingProcess::Clock::duration(until_it_is_free) : between_attempts);
  if (trouble.kind == LogTrouble::Kind::cannot_write && !is_want_of_room(trouble.error))
    file_.close();
}

void RecordingProcess::open_when_due(Clock::time_point now) {
  if (file_.is_open() || now < next_attempt_) return;
  tell(file_.open(), now);
  next_sync_ = now;
}

void RecordingProcess::take(const Event& event, Clock::time_point now) {
  const bool due = now >= next_attempt_ || state_.trouble.load() == LogTrouble::Kind::none;
  if (file_.is_open() && due) {
    const LogTrouble trouble = file_.add(event);
    tell(trouble, now);
    if (!trouble) return;
  }
  ++state_.lost;
}

void RecordingProcess::look_after_file(Clock::time_point now) {
  if (!file_.is_open() || now < next_sync_) return;
  next_sync_ = now + between_syncs;
  if (!file_.has_its_name()) {
    ++state_.removed;
    file_.close();
    return;
  }
  if (plan_.keep_bytes > 0.0) remove_oldest(plan_.path, file_.bytes(), plan_.keep_bytes);
  if (const LogTrouble trouble = file_.sync()) tell(trouble, now);
}

void RecordingProcess::turn(Clock::time_point now) {
  look_after_file(now);
  open_when_due(now);
  while (const auto event = ring_.oldest()) {
    take(*event, now);
    ring_.remove_oldest();
  }
}

void RecordingProcess::end(Clock::time_point now) {
  next_attempt_ = next_sync_ = now;
  turn(now);
  if (file_.is_open()) static_cast<void>(file_.sync());  // nobody is left to be told
}

void run_recording_process(RecordingProcess process, int connection) {
  take_no_signals();
  keep_open_only(connection);
  prctl(PR_SET_NAME, "gazed-recording");
  constexpr int for_ever = -1;
  if (!wait_for_bytes(connection, for_ever)) _exit(0);  // it never began
  do {
    process.turn(RecordingProcess::Clock::now());
  } while (wait_for_bytes(connection, turn_ms));
  process.end(RecordingProcess::Clock::now());
  _exit(0);
}

}  // namespace gazed::log
