#include "drivers/log/log_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <utility>

#include "agent/base/counted.hpp"
#include "agent/base/file_kind.hpp"
#include "drivers/log/older_logs.hpp"

namespace gazed::log {

namespace {

constexpr mode_t permissions = 0666;  // as far as the umask lets

bool is_locked_by_another(int descriptor) {
  // A file system without locks refuses in other ways.
  return flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// 0, or the errno of the write that failed.
int write_all(int descriptor, std::array<iovec, 3> parts) {
  std::span<iovec> left(parts);
  while (!left.empty()) {
    const ssize_t written = writev(descriptor, left.data(), static_cast<int>(left.size()));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    auto bytes = static_cast<std::size_t>(written);
    while (!left.empty() && bytes >= left.front().iov_len) {
      bytes -= left.front().iov_len;
      left = left.subspan(1);
    }
    if (!left.empty()) {
      left.front().iov_base = static_cast<std::uint8_t*>(left.front().iov_base) + bytes;
      left.front().iov_len -= bytes;
    }
  }
  return 0;
}

/// writev() takes pointers to non-const, and writes nothing through them.
iovec part(const void* bytes, std::size_t size) {
  return {const_cast<void*>(bytes), size};
}

}  // namespace

std::string words(const LogTrouble& trouble, const std::string& path, std::int64_t events) {
  const std::string cannot = "cannot write the log " + path + ": ";
  switch (trouble.kind) {
    case LogTrouble::Kind::none:
      return {};
    case LogTrouble::Kind::no_regular_file:
      return cannot + "a regular file is needed";
    case LogTrouble::Kind::in_use:
      return cannot + "another process writes it";
    case LogTrouble::Kind::cannot_open:
      return cannot + std::strerror(trouble.error);
    case LogTrouble::Kind::cannot_write:
      break;
  }
  return "the recording " + path + " has stopped: " + std::strerror(trouble.error) + "; it holds " +
         base::counted(events, "event");
}

void refuse_what_is_no_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
  throw std::invalid_argument("cannot write the log " + path + ": " +
                              base::kind_of_file(status.st_mode) + "; a regular file is needed");
}

LogFile::LogFile(std::string path, std::string configuration_channel, std::string configuration)
    : path_(std::move(path)),
      configuration_channel_(std::move(configuration_channel)),
      configuration_(std::move(configuration)) {}

/// Of a link, what it leads to is written anew: its name is not ours to give away.
int LogFile::keep_what_is_there() const {
  struct stat status {};
  if (lstat(path_.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0)
    return 0;
  // Who may not read it may rename it all the same.
  const base::FileDescriptor there(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (there.get() >= 0 && is_locked_by_another(there.get())) return EWOULDBLOCK;
  return keep_as_older(path_);
}

LogTrouble LogFile::open() {
  close();
  const auto trouble = [](int error) {
    return LogTrouble{
        error == EWOULDBLOCK ? LogTrouble::Kind::in_use : LogTrouble::Kind::cannot_open, error};
  };
  if (const int error = keep_what_is_there(); error != 0) return trouble(error);
  // O_NONBLOCK: to open a FIFO, even to see what it is, would wait for a reader. Not O_TRUNC:
  // another process may have made and locked it since.
  base::FileDescriptor file(
      ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, permissions));
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) return trouble(errno);
  if (!S_ISREG(status.st_mode)) return {LogTrouble::Kind::no_regular_file};
  if (is_locked_by_another(file.get())) return trouble(EWOULDBLOCK);
  if (ftruncate(file.get(), 0) != 0) return trouble(errno);
  file_ = std::move(file);
  events_ = bytes_ = 0;
  return {};
}

bool LogFile::has_its_name() const {
  struct stat by_name {
  }, open_one{};
  return fstat(file_.get(), &open_one) == 0 && stat(path_.c_str(), &by_name) == 0 &&
         by_name.st_ino == open_one.st_ino && by_name.st_dev == open_one.st_dev;
}

LogTrouble LogFile::add(const Event& event) {
  int error = 0;
  // At the time of the first message, since players of logs wait for as long as events lie apart.
  if (events_ == 0 && !configuration_.empty()) {
    const auto* text = reinterpret_cast<const std::uint8_t*>(configuration_.data());
    error = add_whole({configuration_channel_, event.utime_us, {text, configuration_.size()}});
  }
  if (error == 0) error = add_whole(event);
  if (error == 0) return {};
  return {LogTrouble::Kind::cannot_write, error};
}

int LogFile::add_whole(const Event& event) {
  const LogHeaderBytes header =
      encode(LogEventHeader{.number = events_,
                            .time_us = event.utime_us,
                            .channel_bytes = static_cast<std::int32_t>(event.channel.size()),
                            .message_bytes = static_cast<std::int32_t>(event.message.size())});
  const int error = write_all(file_.get(), {part(header.data(), header.size()),
                                            part(event.channel.data(), event.channel.size()),
                                            part(event.message.data(), event.message.size())});
  if (error != 0) {
    // On a disk that takes nothing any more this fails too, and there is nothing to cut off.
    static_cast<void>(ftruncate(file_.get(), bytes_) == 0 &&
                      lseek(file_.get(), bytes_, SEEK_SET) == bytes_);
    return error;
  }
  bytes_ += static_cast<std::int64_t>(header.size() + event.channel.size() + event.message.size());
  ++events_;
  return 0;
}

LogTrouble LogFile::sync() {
  if (fdatasync(file_.get()) == 0) return {};
  return {LogTrouble::Kind::cannot_write, errno};
}

}  // namespace gazed::log
