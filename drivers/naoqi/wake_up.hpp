// One descriptor for poll() where a driver has several sockets and times to wait for.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "agent/base/file_descriptor.hpp"

namespace gazed::naoqi {

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
  base::FileDescriptor epoll_, timer_;
};

/// For the end of a driver, when no loop turns any more: `serve` is called until it returns true,
/// but no longer than this.
void await_answers(const WakeUp& wake_up, std::chrono::milliseconds longest,
                   const std::function<bool()>& serve);

}  // namespace gazed::naoqi
