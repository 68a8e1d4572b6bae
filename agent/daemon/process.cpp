#include "agent/daemon/process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <system_error>
#include <unistd.h>

namespace gazed::daemon {

namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double resident_megabytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0.0;
  long total = 0, resident = 0;
  const int read = std::fscanf(file, "%ld %ld", &total, &resident);
  std::fclose(file);
  return read == 2
             ? 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE))
             : 0.0;
}

/// Passes an end signal on. At a low priority, next to processes that take all they can get, the
/// rest of the work would need seconds, so the priority is raised to the usual one where that is
/// allowed (CAP_SYS_NICE or RLIMIT_NICE).
void hurry(int) {
  const int error = errno;
  if (getpriority(PRIO_PROCESS, 0) > 0) setpriority(PRIO_PROCESS, 0, 0);
  kill(getpid(), SIGRTMIN);
  errno = error;
}

}  // namespace

EndSignals::EndSignals() {
  // Passed on as a signal that stays pending until it is read.
  sigset_t passed_on;
  sigemptyset(&passed_on);
  sigaddset(&passed_on, SIGRTMIN);
  if (const int error = pthread_sigmask(SIG_BLOCK, &passed_on, nullptr); error != 0)
    throw std::system_error(error, std::generic_category(), "blocking a signal");
  descriptor_ = signalfd(-1, &passed_on, SFD_NONBLOCK | SFD_CLOEXEC);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  struct sigaction action {};
  action.sa_handler = hurry;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (sigaction(signals[i], &action, &before_[i]) == 0) continue;
    const int error = errno;
    close(descriptor_);
    throw std::system_error(error, std::generic_category(), "sigaction");
  }
}

EndSignals::~EndSignals() {
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
  close(descriptor_);
}

bool EndSignals::received() {
  signalfd_siginfo info{};
  return ::read(descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info);
}

ProcessMeter::ProcessMeter()
    : last_read_(std::chrono::steady_clock::now()), last_cpu_s_(cpu_seconds()) {}

ProcessUsage ProcessMeter::read() {
  const auto now = std::chrono::steady_clock::now();
  const double elapsed_s = std::chrono::duration<double>(now - last_read_).count();
  const double cpu_s = cpu_seconds();
  ProcessUsage usage;
  if (elapsed_s > 0.0) usage.cpu_percent = 100.0 * (cpu_s - last_cpu_s_) / elapsed_s;
  usage.resident_mb = resident_megabytes();
  last_read_ = now;
  last_cpu_s_ = cpu_s;
  return usage;
}

}  // namespace gazed::daemon
