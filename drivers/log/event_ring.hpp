// Events on their way from the loop to the process that writes them: a ring in memory that both
// share. One process adds, the other takes; neither waits. What was taken goes back to the kernel,
// so that no more memory is held than there are events that wait.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/log/event.hpp"

namespace gazed::log {

/// Where both processes are, in bytes since the beginning, modulo 2^32.
struct RingPositions {
  std::atomic<std::uint32_t> added{0}, taken{0};
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
};

class EventRing {
 public:
  /// `memory` and `positions` are shared; they outlive the ring. The size of the memory is a power
  /// of two, at least 4096.
  EventRing(std::span<std::uint8_t> memory, RingPositions& positions)
      : memory_(memory), positions_(positions) {}

  /// Whether an event of so many bytes finds room, and `spare_bytes` more are left then.
  [[nodiscard]] bool has_room(std::size_t event_bytes, std::size_t spare_bytes) const;
  /// False when there is no room for it and `spare_bytes`: then nothing is added.
  bool add(const Event& event, std::size_t spare_bytes);

  /// The same in two steps, for a message that is made in the ring: where it goes, or nothing when
  /// there is no room; and that it is there.
  [[nodiscard]] std::span<std::uint8_t> begin_to_add(std::string_view channel,
                                                     std::int64_t utime_us,
                                                     std::size_t message_bytes,
                                                     std::size_t spare_bytes);
  void end_to_add();

  /// The oldest event, in the ring's memory.
  [[nodiscard]] std::optional<Event> oldest();
  /// Gives its memory back, to the kernel too if it is shared. Only after oldest() has given one.
  void remove_oldest();
  [[nodiscard]] bool empty() const;

  /// What an event takes: its channel, its message, and what the ring keeps beside them.
  [[nodiscard]] static std::size_t bytes_of(std::size_t channel_bytes, std::size_t message_bytes);

 private:
  [[nodiscard]] std::size_t offset(std::uint32_t position) const {
    return position & (memory_.size() - 1);
  }

  std::span<std::uint8_t> memory_;
  RingPositions& positions_;
  std::uint32_t will_be_added_ = 0;  // after end_to_add()
};

}  // namespace gazed::log
