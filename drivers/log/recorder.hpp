// A recording as the loop makes it: nothing here waits for the disk.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <sys/types.h>

#include "agent/base/file_descriptor.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/log/event_encoder.hpp"
#include "drivers/log/event_ring.hpp"
#include "drivers/log/recording_process.hpp"

namespace gazed::log {

struct RecorderSettings {
  std::string path;
  double keep_bytes = 0.0;          // of this and the older recordings; 0: all are kept
  std::size_t frame_bytes_max = 0;  // pixels of the largest frame
  std::string configuration = {};   // for recorded_configuration()
};

/// Hands events to a process of its own, which writes them (recording_process.hpp). While the disk
/// stands still the events wait in memory, then frames are dropped and counted, later the rest.
class Recorder {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws std::invalid_argument for a path that can never be recorded to, std::system_error when
  /// there is no memory or process to be had. Makes no file yet.
  Recorder(RecorderSettings settings, const lcm::Channels& channels);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Makes the file, or says in fault() why it cannot be made.
  void begin();
  void write(const geometry::Frame& frame);
  void write(const geometry::HeadState& state) { add(encoder_.encode(state), 0); }
  /// What a fixation ended in, and how that came about.
  void write(const located_point_t& point, const fixation_t& fixation) {
    add(encoder_.encode(point), 0);
    add(encoder_.encode(fixation), 0);
  }

  /// False while a frame would be dropped: who makes time can wait, and ask again.
  [[nodiscard]] bool has_room();
  /// No more comes: lets the process write what is left and end.
  void end();
  /// Waits for that, but not for longer than so after end(), which it does where nobody has.
  void finish(Clock::duration at_most);

  /// Why nothing is recorded, or what the recording lacks, in words; empty while all is well.
  [[nodiscard]] std::string fault() const;

  [[nodiscard]] pid_t process() const { return process_; }

 private:
  /// Frames leave this much of the ring to head states and fixations: more than 20 s of them.
  static constexpr std::size_t spare_for_the_rest = 262'144;

  /// Memory that a forked process sees too.
  class Shared {
   public:
    explicit Shared(std::size_t ring_bytes);
    ~Shared();
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;
    [[nodiscard]] RecordingState& state() const { return *state_; }
    [[nodiscard]] std::span<std::uint8_t> ring() const;

   private:
    std::size_t ring_bytes_;
    RecordingState* state_;
  };

  void start();
  void add(const Event& event, std::size_t spare_bytes);
  void wake();

  RecorderSettings settings_;
  std::string configuration_channel_, image_channel_;
  std::size_t frame_event_bytes_;
  Shared shared_;
  EventRing ring_;
  EventEncoder encoder_;
  base::FileDescriptor connection_{-1};
  pid_t process_ = -1;
  std::int64_t dropped_ = 0;  // events without room
  std::int64_t ended_ = 0;    // processes that ended too early
  Clock::time_point next_start_{};
  std::optional<Clock::time_point> end_;
};

}  // namespace gazed::log
