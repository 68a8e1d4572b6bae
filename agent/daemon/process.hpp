// The process seen from inside: the signals that end it, and what it costs.
#pragma once

#include <array>
#include <chrono>
#include <csignal>

namespace gazed::daemon {

/// SIGINT and SIGTERM as something to poll. Whichever comes also ends a low priority (nice), where
/// that is allowed. To be made before any other thread, since only threads started later inherit
/// that the signal which is polled is blocked. When it goes, they do again what they did before.
/// Throws std::system_error when the kernel refuses.
class EndSignals {
 public:
  EndSignals();
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// True when one has come since the last call.
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
