// What gazed reports to the service manager that started it, by the protocol of sd_notify(3) and
// sd_watchdog_enabled(3) (systemd 252): datagrams with lines `READY=1`, `STATUS=...`, `WATCHDOG=1`,
// `STOPPING=1` to the socket in NOTIFY_SOCKET. libsystemd would do the same, but brings six
// libraries.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>
#include <vector>

#include "agent/base/file_descriptor.hpp"

namespace gazed::daemon {

/// The protocol's variables, as found in the environment.
struct ServiceEnvironment {
  std::optional<std::string> notify_socket;  // NOTIFY_SOCKET: a path, or @ and an abstract name
  std::optional<std::string> watchdog_usec;  // WATCHDOG_USEC: this much silence is a fault
  std::optional<std::string> watchdog_pid;   // WATCHDOG_PID: the process being watched

  [[nodiscard]] static ServiceEnvironment of_this_process();
};

/// Never blocks and never throws: whatever cannot be sent is tried again in the next turn. Without
/// NOTIFY_SOCKET, all calls do nothing.
class ServiceManager {
 public:
  using Clock = std::chrono::steady_clock;

  /// `pid` is that of this process.
  ServiceManager(const ServiceEnvironment& environment, int pid);

  /// Variables that cannot be used, with the reason, for a single report. The others are obeyed.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

  /// Call after every turn of the loop. The first call sends READY=1; the watchdog is fed at least
  /// twice in its period.
  void turned(Clock::time_point now = Clock::now());
  /// The current status, one line; sent when it changes, at most once a second.
  void set_status(std::string_view status);
  void stopping();

  /// The longest time that the loop may wait.
  [[nodiscard]] Clock::duration longest_wait() const {
    return feeding_period_.value_or(Clock::duration::max());
  }

 private:
  void set_socket(const std::string& name);
  void set_watchdog(const ServiceEnvironment& environment, int pid);
  bool send(std::string_view lines) const;

  std::vector<std::string> problems_;
  base::FileDescriptor socket_{-1};
  sockaddr_un address_{};
  socklen_t address_bytes_ = 0;
  std::optional<Clock::duration> feeding_period_;

  bool ready_ = false;
  std::string status_, sent_status_;
  std::optional<Clock::time_point> status_sent_, fed_;
};

}  // namespace gazed::daemon
