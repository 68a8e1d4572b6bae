// One descriptor for poll(), for drivers that wait for several sockets and times.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "agent/base/file_descriptor.hpp"

namespace gazed::naoqi {

/// Readable when a watched socket is ready or the set time has come. Closing a socket ends its
/// watch.
class WakeUp {
 public:
  /// Throws std::system_error.
  WakeUp();

  [[nodiscard]] int descriptor() const { return epoll_.get(); }
  void watch(int socket, bool for_writing);
  /// Sets the wake-up time (CLOCK_MONOTONIC); replaces the previous one.
  void at(std::int64_t monotonic_us);

 private:
  base::FileDescriptor epoll_, timer_;
};

/// For the end of a driver, when the loop no longer runs: calls `serve` until it returns true, but
/// no longer than this.
void await_answers(const WakeUp& wake_up, std::chrono::milliseconds longest,
                   const std::function<bool()>& serve);

}  // namespace gazed::naoqi
