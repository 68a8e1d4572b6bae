// The process that writes a recording, so that the loop never waits for a disk.
//
// It is made by fork() and keeps nothing open but its end of a connection: events that wait in the
// ring are announced by a byte, and the end of the connection is the end of the recording, however
// gazed has ended.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "drivers/log/event_ring.hpp"
#include "drivers/log/log_file.hpp"

namespace gazed::log {

/// What to write, and where.
struct RecordingPlan {
  std::string path;
  std::string configuration_channel, configuration;  // the first event of each file
  double keep_bytes = 0.0;                           // of all of the recordings; 0: keep all
};

/// What the process tells, in shared memory.
struct RecordingState {
  RingPositions positions;
  std::atomic<LogTrouble::Kind> trouble{LogTrouble::Kind::none};
  std::atomic<std::int32_t> error{0};
  std::atomic<std::uint32_t> events_in_file{0};
  std::atomic<std::uint32_t> lost{0};     // events that could not be written
  std::atomic<std::uint32_t> removed{0};  // files that were removed while they were written
};

/// What the process does with the events, one turn after another.
class RecordingProcess {
 public:
  using Clock = std::chrono::steady_clock;

  RecordingProcess(RecordingPlan plan, EventRing ring, RecordingState& state);

  /// Writes what waits. What cannot be written is lost and counted, and tried anew after a second.
  void turn(Clock::time_point now);
  /// The last turn: nothing is put off to a later one.
  void end(Clock::time_point now);

 private:
  void open_when_due(Clock::time_point now);
  void take(const Event& event, Clock::time_point now);
  void look_after_file(Clock::time_point now);
  void tell(const LogTrouble& trouble, Clock::time_point now);

  RecordingPlan plan_;
  EventRing ring_;
  RecordingState& state_;
  LogFile file_;
  Clock::time_point next_attempt_{}, next_sync_{};
};

/// Serves the ring from the first byte of `connection` to its end. To be called in the forked
/// process; never returns.
[[noreturn]] void run_recording_process(RecordingProcess process, int connection);

}  // namespace gazed::log
