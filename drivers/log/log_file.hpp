// A log on the disk, event by event, and what can be wrong with it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "agent/base/file_descriptor.hpp"
#include "drivers/log/event.hpp"

namespace gazed::log {

/// Why a log is not written.
struct LogTrouble {
  enum class Kind : std::uint32_t {
    none,
    no_regular_file,  // a FIFO, a device, a folder
    in_use,           // another process writes it
    cannot_open,
    cannot_write,
  };
  Kind kind = Kind::none;
  int error = 0;  // errno of the last two

  explicit operator bool() const { return kind != Kind::none; }
};

/// A sentence with the path; `events` are those that the log holds.
[[nodiscard]] std::string words(const LogTrouble& trouble, const std::string& path,
                                std::int64_t events);

/// Throws std::invalid_argument when `path` is something that can never be a log.
void refuse_what_is_no_file(const std::string& path);

class LogFile {
 public:
  /// `configuration` is kept as the log's first event, for recorded_configuration().
  LogFile(std::string path, std::string configuration_channel, std::string configuration);

  /// Makes the file. One of that name that is not empty is kept as PATH.1 (older_logs.hpp).
  [[nodiscard]] LogTrouble open();
  void close() { file_ = base::FileDescriptor(-1); }
  [[nodiscard]] bool is_open() const { return file_.get() >= 0; }
  /// False when it was removed, or another file has its name now.
  [[nodiscard]] bool has_its_name() const;

  /// An event is written whole or not at all: what went through of one that failed is cut off
  /// again, so that the log stays valid.
  [[nodiscard]] LogTrouble add(const Event& event);
  /// Waits until the disk has all of it.
  [[nodiscard]] LogTrouble sync();

  [[nodiscard]] std::int64_t events() const { return events_; }
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] int keep_what_is_there() const;
  [[nodiscard]] int add_whole(const Event& event);

  std::string path_, configuration_channel_, configuration_;
  base::FileDescriptor file_{-1};
  std::int64_t events_ = 0;  // in the file
  std::int64_t bytes_ = 0;   // of them
};

}  // namespace gazed::log
