// Reads an LCM event log that may be damaged: one pass, in bounded memory, nothing believed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "agent/base/regular_file.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/log/event.hpp"

namespace gazed::log {

/// Gives the messages of one channel in the order of the file. Where the file does not go on with
/// an event it is searched for the next one, byte by byte; an event whose sizes do not lead to
/// another event (or to the end) is still given, but the search starts inside it, so that a size
/// that lies hides nothing.
class LogReader {
 public:
  /// Throws std::invalid_argument, with the reason, when `path` cannot be read.
  LogReader(std::string path, std::string channel);

  /// The next message on the channel, valid until the next call; none at the end.
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> next_message();

  /// Goes over the next event: its channel, whatever it is; empty at the end.
  [[nodiscard]] std::string next_channel();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const std::string& channel() const { return channel_; }
  /// Channels seen so far, the first 20 of them, in the order of the file.
  [[nodiscard]] const std::vector<std::string>& channels() const { return channels_; }
  /// Of a file in which no event was found: why it is no log, in words.
  [[nodiscard]] std::string why_no_log();
  /// What was skipped so far, in words; empty when nothing was.
  [[nodiscard]] std::string notes() const;
  /// Why the file cannot be read to its end, in words; empty when it can.
  [[nodiscard]] std::string fault() const;

 private:
  struct MessagePlace {
    std::int64_t begin;
    std::size_t bytes;
  };

  [[nodiscard]] std::optional<MessagePlace> pass_event();
  [[nodiscard]] bool read_at(std::int64_t offset, std::span<std::uint8_t> bytes);
  [[nodiscard]] bool is_event_boundary(std::int64_t offset);
  [[nodiscard]] std::optional<LogEventHeader> event_at(std::int64_t offset);
  void note_channel();
  void skip_to_sync_word();

  std::string path_;
  std::string channel_;
  base::RegularFile file_;
  std::int64_t position_ = 0;
  std::int64_t used_until_ = 0;        // the end of the last event, by its own sizes
  std::string event_channel_;          // of the event last looked at
  std::vector<std::uint8_t> message_;  // of the event last given
  std::vector<std::uint8_t> search_;   // a piece of the file that is searched
  std::vector<std::string> channels_;
  std::int64_t impossible_sizes_ = 0;  // events
  std::int64_t skipped_bytes_ = 0;
  std::int64_t skipped_places_ = 0;
  std::int64_t first_skipped_at_ = 0;
  int error_ = 0;  // errno of the read that failed
};

/// The text that a LogWriter was given to keep; empty when the log has none. Throws
/// std::invalid_argument when `path` cannot be read.
[[nodiscard]] std::string recorded_configuration(const std::string& path,
                                                 const lcm::Channels& channels);
/// The same, of whatever prefix a recording of gazed's own has; `otherwise` as recorded_prefix().
[[nodiscard]] std::string recorded_configuration(const std::string& path,
                                                 const std::string& otherwise);

/// The prefix of the channels in a recording of gazed's own, which begins with its configuration;
/// `otherwise` of a log that does not. Throws std::invalid_argument when `path` cannot be read.
[[nodiscard]] std::string recorded_prefix(const std::string& path, const std::string& otherwise);

}  // namespace gazed::log
