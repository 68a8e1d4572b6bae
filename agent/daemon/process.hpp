// This process: the signals that end it, and the resources it uses.
#pragma once

#include <array>
#include <chrono>
#include <csignal>

namespace gazed::daemon {

/// Makes SIGINT and SIGTERM available to poll(). Either of them also ends a low priority (nice)
/// where that is allowed. Create it before any other thread: only threads that start later inherit
/// the blocked signal. The destructor restores the previous behaviour. Throws std::system_error if
/// the kernel refuses.
class EndSignals {
 public:
  EndSignals();
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// True if a signal has come since the last call.
  [[nodiscard]] bool received();

 private:
  static constexpr std::array signals{SIGINT, SIGTERM};

  int descriptor_;
  std::array<struct sigaction, signals.size()> before_{};
};

struct ProcessUsage {
  double cpu_percent = 0.0;  // of one core, since the last call
  double resident_mb = 0.0;  // 10^6 bytes
};

class ProcessMeter {
 public:
  ProcessMeter();
  [[nodiscard]] ProcessUsage read();

 private:
  std::chrono::steady_clock::time_point last_read_;
  double last_cpu_s_;
};

}  // namespace gazed::daemon
