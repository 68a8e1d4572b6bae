// Writes frames and head states, and what came of them, as an LCM event log, which lcm-logplayer,
// lcm-spy's tools and gazed's own `--camera log:FILE --head log:FILE` read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "agent/base/file_descriptor.hpp"
#include "drivers/camera.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/channels.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/fixation_t.hpp"
#include "msgs/gazed/head_state_t.hpp"

namespace gazed::log {

/// An event is written whole or not at all. The first that cannot be (the disk is full) ends the
/// recording: what went through of it is cut off again and the file closed, so that the recording
/// is valid and without a hole as far as it goes.
class LogWriter {
 public:
  /// Makes `path`; a log that is there already is kept beside it, as `path`.old. Throws
  /// std::invalid_argument when that is not possible.
  /// `configuration` is kept as the log's first event, for recorded_configuration().
  LogWriter(std::string path, lcm::Channels channels, std::string configuration = {});

  /// The time of the event is the frame's or the state's own. False once the recording has stopped;
  /// fault() says why.
  bool write(const geometry::Frame& frame);
  bool write(const geometry::HeadState& state);
  /// At the time of the event before it, if that is later: a fixation's own is its last view's.
  bool write(const fixation_t& fixation);

  /// Why the recording has stopped, and what it holds, in words; empty while it goes on.
  [[nodiscard]] std::string fault() const;

 private:
  template <class Message>
  bool write_message(const std::string& channel, const Message& message, std::int64_t utime_us);
  bool write_event(const std::string& channel, std::int64_t utime_us);
  bool append(std::span<const std::uint8_t> head, std::span<const std::uint8_t> body);
  void stop(int error);

  std::string path_;
  lcm::Channels channels_;
  std::string configuration_;  // until it is written
  base::FileDescriptor file_;
  std::int64_t end_of_events_ = 0;  // bytes of whole events in the file
  std::int64_t events_written_ = 0;
  std::int64_t newest_utime_us_ = 0;
  int stopped_by_ = 0;  // errno, 0 while the recording goes on

  bot_core::image_t image_message_{};  // these four are reused
  head_state_t state_message_{};
  std::vector<std::uint8_t> event_head_;
  std::vector<std::uint8_t> encoded_;
};

}  // namespace gazed::log
