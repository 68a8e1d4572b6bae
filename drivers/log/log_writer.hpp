// Writes frames and head states, and what came of them, as an LCM event log, which lcm-logplayer,
// lcm-spy's tools and gazed's own `--camera log:FILE --head log:FILE` read.
#pragma once

#include <string>

#include "drivers/lcm/channels.hpp"
#include "drivers/log/event_encoder.hpp"
#include "drivers/log/log_file.hpp"

namespace gazed::log {

/// Waits for the disk: for programs without a loop (a loop has a Recorder). The first event that
/// cannot be written (the disk is full) ends the log, so that it has no hole.
class LogWriter {
 public:
  /// Makes `path`; a log that is there already is kept beside it, as `path`.1. Throws
  /// std::invalid_argument when that is not possible.
  /// `configuration` is kept as the log's first event, for recorded_configuration().
  LogWriter(std::string path, const lcm::Channels& channels, std::string configuration = {});

  /// False once the recording has stopped; fault() says why.
  bool write(const geometry::Frame& frame) { return add(encoder_.encode(frame)); }
  bool write(const geometry::HeadState& state) { return add(encoder_.encode(state)); }
  bool write(const located_point_t& point) { return add(encoder_.encode(point)); }
  bool write(const fixation_t& fixation) { return add(encoder_.encode(fixation)); }

  /// Why the recording has stopped, and what it holds, in words; empty while it goes on.
  [[nodiscard]] std::string fault() const;

 private:
  bool add(const Event& event);

  std::string path_;
  EventEncoder encoder_;
  LogFile file_;
  LogTrouble trouble_;
};

}  // namespace gazed::log
