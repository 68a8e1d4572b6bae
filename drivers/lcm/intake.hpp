// What becomes of messages once they have come: checked, kept until they are asked for, counted.
// Shared by the drivers of a live LCM and of an LCM log.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "agent/base/image.hpp"
#include "agent/base/ring.hpp"
#include "agent/geometry/head_motion.hpp"
#include "agent/geometry/view.hpp"
#include "drivers/lcm/checks.hpp"
#include "drivers/lcm/gap_counter.hpp"
#include "drivers/lcm/utime_check.hpp"
#include "drivers/repeated_stamp.hpp"

namespace gazed::lcm {

/// How many messages of a channel were not used, and why the last of them was not.
class Refusals {
 public:
  explicit Refusals(std::string channel) : channel_(std::move(channel)) {}

  void add(std::string reason);
  void accepted() { last_was_refused_ = false; }

  [[nodiscard]] const std::string& channel() const { return channel_; }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] bool last_was_refused() const { return last_was_refused_; }
  /// "GAZED_IMAGE: 3 messages refused, the last: ..."; empty when none was.
  [[nodiscard]] std::string text() const;

 private:
  std::string channel_;
  std::int64_t count_ = 0;
  bool last_was_refused_ = false;
  std::string last_reason_;
};

/// Once, when arrival begins to count on a channel.
class ArrivalWarning {
 public:
  [[nodiscard]] std::string text(const Refusals& channel, const drivers::RepeatedStamp& stamp);

 private:
  bool reported_ = false;
};

/// Keeps the newest frame. Frames of another size than configured are refused.
class FrameIntake {
 public:
  FrameIntake(std::string channel, int width_px, int height_px);

  /// Reads a bot_core.image_t, decoding its JPEG; false when it is refused. `arrived_us`,
  /// microseconds since the Unix epoch, counts where the sender does not stamp its messages.
  bool take(std::span<const std::uint8_t> message,
            std::optional<std::int64_t> arrived_us = std::nullopt);
  /// A message that is larger than any image of the configured size, and was not received.
  void refuse_size(std::size_t message_bytes);

  /// The time of the frame that waits to be asked for, if one does.
  [[nodiscard]] std::optional<std::int64_t> waiting_utime_us() const;
  /// How far the clock of the messages was set back until then.
  [[nodiscard]] std::int64_t set_back_us() const { return utime_check_.set_back_us(); }
  /// The frame that waits. Its pixels stay until the next call of next_frame(), whatever is taken
  /// in the meantime.
  [[nodiscard]] std::optional<geometry::Frame> next_frame();

  /// Frames that were lost on the way, or replaced by a newer one before they were asked for.
  [[nodiscard]] std::int32_t frames_dropped() const { return replaced_ + gaps_.missing(); }
  [[nodiscard]] const Refusals& refusals() const { return refusals_; }
  /// That times are those of arrival, once; empty else.
  [[nodiscard]] std::string warning() { return arrival_warning_.text(refusals_, repeated_stamp_); }

 private:
  /// Makes the image the one that waits. Why it cannot, in words; the one before then stays.
  [[nodiscard]] std::string keep(const WireImage& image);

  int width_px_;
  int height_px_;
  Refusals refusals_;
  drivers::RepeatedStamp repeated_stamp_;
  ArrivalWarning arrival_warning_;
  UtimeCheck utime_check_;
  GapCounter gaps_;
  base::Image waiting_, handed_out_;
  base::Image decoded_;  // of a JPEG, until all of it is
  std::int64_t waiting_utime_us_ = 0;
  bool is_waiting_ = false;
  std::int32_t replaced_ = 0;
};

/// Keeps the newest 256 head states: 3 s at the 83 Hz of a NAO's joint bus.
class HeadStateIntake {
 public:
  explicit HeadStateIntake(std::string channel) : refusals_(std::move(channel)) {}

  /// Reads a gazed.head_state_t; false when it is refused. `arrived_us` as in FrameIntake.
  bool take(std::span<const std::uint8_t> message,
            std::optional<std::int64_t> arrived_us = std::nullopt);

  [[nodiscard]] std::optional<std::int64_t> waiting_utime_us() const;
  /// How far the clock of the messages was set back until then.
  [[nodiscard]] std::int64_t set_back_us() const { return utime_check_.set_back_us(); }
  /// The oldest state that waits.
  [[nodiscard]] std::optional<geometry::HeadState> next_state();
  /// The newest state ever taken.
  [[nodiscard]] const std::optional<geometry::HeadState>& newest() const { return newest_; }

  [[nodiscard]] const Refusals& refusals() const { return refusals_; }
  /// That times are those of arrival, once; empty else.
  [[nodiscard]] std::string warning() { return arrival_warning_.text(refusals_, repeated_stamp_); }

 private:
  Refusals refusals_;
  drivers::RepeatedStamp repeated_stamp_;
  ArrivalWarning arrival_warning_;
  UtimeCheck utime_check_;
  base::Ring<geometry::HeadState, 256> waiting_;
  std::optional<geometry::HeadState> newest_;
};

}  // namespace gazed::lcm
