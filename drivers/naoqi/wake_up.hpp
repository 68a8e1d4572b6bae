// One descriptor for poll() where a driver has several sockets and times to wait for.
#pragma once

#include <cstdint>

#include "agent/file_descriptor.hpp"

namespace gazed {

/// Readable when a watched socket has something to do, or the time has come. Closing a socket ends
/// its watch.
class WakeUp {
 public:
  /// Throws std::system_error.
  WakeUp();

  [[nodiscard]] int descriptor() const { return epoll_.get(); }
  void watch(int socket, bool for_writing);
  /// CLOCK_MONOTONIC; only the last call counts.
  void at(std::int64_t monotonic_us);

 private:
  FileDescriptor epoll_, timer_;
};

}  // namespace gazed
