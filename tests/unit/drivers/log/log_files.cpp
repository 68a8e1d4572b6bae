#include "log_files.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <sys/mman.h>
#include <unistd.h>

#include "drivers/log/event.hpp"

namespace gazed::log {

namespace {

void require(bool holds) {
  if (!holds) throw std::runtime_error("the test cannot use its file in memory");
}

}  // namespace

TemporaryFile::TemporaryFile()
    : file_(memfd_create("gazed_test", MFD_CLOEXEC)),
      path_("/proc/self/fd/" + std::to_string(file_.get())) {
  require(file_.get() >= 0);
}

void TemporaryFile::write(const Bytes& bytes) const {
  require(ftruncate(file_.get(), 0) == 0);
  require(pwrite(file_.get(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
}

Bytes TemporaryFile::read() const {
  Bytes bytes(static_cast<std::size_t>(lseek(file_.get(), 0, SEEK_END)));
  require(pread(file_.get(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  return bytes;
}

Bytes event(const std::string& channel, const Bytes& message, std::int64_t time_us) {
  const auto header =
      encode(LogEventHeader{.time_us = time_us,
                            .channel_bytes = static_cast<std::int32_t>(channel.size()),
                            .message_bytes = static_cast<std::int32_t>(message.size())});
  Bytes bytes;
  std::ranges::copy(header, std::back_inserter(bytes));
  std::ranges::copy(channel, std::back_inserter(bytes));
  std::ranges::copy(message, std::back_inserter(bytes));
  return bytes;
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) std::ranges::copy(part, std::back_inserter(all));
  return all;
}

}  // namespace gazed::log
