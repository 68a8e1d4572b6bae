#include "drivers/log/log_writer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <utility>

#include "agent/base/counted.hpp"
#include "agent/base/file_kind.hpp"
#include "drivers/lcm/conversions.hpp"
#include "drivers/log/event.hpp"

namespace gazed::log {

namespace {

constexpr int permissions = 0666;  // as far as the umask lets

/// A gazed that crashed is started again with the same configuration: what it recorded is kept.
void keep_old(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0) return;
  const std::string old = path + ".old";
  if (std::rename(path.c_str(), old.c_str()) != 0) {
    throw std::invalid_argument("cannot keep the old log " + path + " as " + old + ": " +
                                std::strerror(errno));
  }
}

base::FileDescriptor open_for_writing(const std::string& path) {
  keep_old(path);
  const auto refuse = [&](const std::string& reason) {
    throw std::invalid_argument("cannot write the log " + path + ": " + reason);
  };
  // To open a FIFO, even to see what it is, may wait for a reader.
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISCHR(status.st_mode))
    refuse(base::kind_of_file(status.st_mode) + "; a regular file is needed");
  base::FileDescriptor file(
      open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK, permissions));
  if (file.get() < 0) refuse(std::strerror(errno));
  return file;
}

}  // namespace

LogWriter::LogWriter(std::string path, lcm::Channels channels, std::string configuration)
    : path_(std::move(path)),
      channels_(std::move(channels)),
      configuration_(std::move(configuration)),
      file_(open_for_writing(path_)) {}

bool LogWriter::write(const geometry::Frame& frame) {
  if (stopped_by_ != 0) return false;
  lcm::to_message(frame, image_message_);
  return write_message(channels_.image, image_message_, frame.utime_us);
}

bool LogWriter::write(const geometry::HeadState& state) {
  if (stopped_by_ != 0) return false;
  lcm::to_message(state, state_message_);
  return write_message(channels_.head_state, state_message_, state.utime_us);
}

bool LogWriter::write(const fixation_t& fixation) {
  if (stopped_by_ != 0) return false;
  return write_message(channels_.fixation, fixation, std::max(newest_utime_us_, fixation.utime));
}

template <class Message>
bool LogWriter::write_message(const std::string& channel, const Message& message,
                              std::int64_t utime_us) {
  if (!configuration_.empty()) {
    // At the time of the first message, since players of logs wait for as long as events lie apart.
    encoded_.assign(configuration_.begin(), configuration_.end());
    if (!write_event(channels_.configuration, utime_us)) return false;
    configuration_.clear();
  }
  encoded_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(encoded_.data(), 0, static_cast<int>(encoded_.size()));
  newest_utime_us_ = utime_us;
  return write_event(channel, utime_us);
}

bool LogWriter::write_event(const std::string& channel, std::int64_t utime_us) {
  const LogHeaderBytes header =
      encode(LogEventHeader{.number = events_written_,
                            .time_us = utime_us,
                            .channel_bytes = static_cast<std::int32_t>(channel.size()),
                            .message_bytes = static_cast<std::int32_t>(encoded_.size())});
  event_head_.assign(header.begin(), header.end());
  event_head_.insert(event_head_.end(), channel.begin(), channel.end());
  if (!append(event_head_, encoded_)) {
    stop(errno);
    return false;
  }
  end_of_events_ += static_cast<std::int64_t>(event_head_.size() + encoded_.size());
  ++events_written_;
  return true;
}

bool LogWriter::append(std::span<const std::uint8_t> head, std::span<const std::uint8_t> body) {
  while (!head.empty() || !body.empty()) {
    // writev() takes pointers to non-const, and writes nothing through them.
    std::array<iovec, 2> parts{{{const_cast<std::uint8_t*>(head.data()), head.size()},
                                {const_cast<std::uint8_t*>(body.data()), body.size()}}};
    const ssize_t written = writev(file_.get(), parts.data(), parts.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    const auto from_head = std::min(head.size(), static_cast<std::size_t>(written));
    head = head.subspan(from_head);
    body = body.subspan(static_cast<std::size_t>(written) - from_head);
  }
  return true;
}

void LogWriter::stop(int error) {
  stopped_by_ = error;
  // Not possible on a device or a pipe, where there is nothing to cut off either.
  [[maybe_unused]] const int cut_off = ftruncate(file_.get(), end_of_events_);
  file_ = base::FileDescriptor(-1);
}

std::string LogWriter::fault() const {
  if (stopped_by_ == 0) return {};
  return "the recording " + path_ + " has stopped: " + std::strerror(stopped_by_) + "; it holds " +
         base::counted(events_written_, "event");
}

}  // namespace gazed::log
