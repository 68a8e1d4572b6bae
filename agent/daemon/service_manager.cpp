#include "agent/daemon/service_manager.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "agent/base/text.hpp"

namespace gazed::daemon {

namespace {

using namespace std::chrono_literals;

// A manager forwards every status to whoever watches it.
constexpr ServiceManager::Clock::duration status_interval = 1s;
// systemd reads datagrams of up to 4096 bytes (PIPE_BUF).
constexpr std::size_t longest_status_bytes = 1000;
// A quarter of the watchdog's time, so that a turn may take another quarter. Bounded, because an
// infinite time cannot be added to a clock, and a shorter one leaves no time to work.
constexpr std::chrono::microseconds shortest_feeding = 1ms, longest_feeding = 1h;

std::optional<std::string> variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::optional<std::uint64_t> whole_number(const std::string& digits) {
  std::uint64_t number = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

std::string problem(const char* name, const std::string& value, const char* expected) {
  return base::text("%s: \"%s\" found, %s", name, base::excerpt(value).c_str(), expected);
}

}  // namespace

ServiceEnvironment ServiceEnvironment::of_this_process() {
  return {variable("NOTIFY_SOCKET"), variable("WATCHDOG_USEC"), variable("WATCHDOG_PID")};
}

ServiceManager::ServiceManager(const ServiceEnvironment& environment, int pid) {
  if (!environment.notify_socket) return;
  set_socket(*environment.notify_socket);
  if (address_bytes_ > 0) set_watchdog(environment, pid);
}

void ServiceManager::set_socket(const std::string& name) {
  constexpr const char* variable_name = "NOTIFY_SOCKET";
  const bool abstract = name.starts_with('@');
  if (name.size() < 2 || (!abstract && !name.starts_with('/'))) {
    problems_.push_back(problem(variable_name, name, "which is neither a path nor @ and a name"));
    return;
  }
  // A path needs a terminating zero byte; an abstract name begins with one instead of the @.
  const std::size_t longest = sizeof address_.sun_path - (abstract ? 0 : 1);
  if (name.size() > longest) {
    problems_.push_back(problem(variable_name, name, "which is too long for a socket"));
    return;
  }
  socket_ = base::FileDescriptor(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket_.get() < 0) {
    problems_.push_back(std::string("no socket for the service manager: ") + std::strerror(errno));
    return;
  }
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, name.data(), name.size());
  if (abstract) address_.sun_path[0] = '\0';
  address_bytes_ =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (abstract ? 0 : 1));
}

void ServiceManager::set_watchdog(const ServiceEnvironment& environment, int pid) {
  if (!environment.watchdog_usec) return;
  if (environment.watchdog_pid) {
    const auto watched = whole_number(*environment.watchdog_pid);
    if (!watched) {
      problems_.push_back(problem("WATCHDOG_PID", *environment.watchdog_pid,
                                  "which is no process id; no watchdog is fed"));
      return;
    }
    if (*watched != static_cast<std::uint64_t>(pid)) return;  // another process is watched
  }
  const auto time_us = whole_number(*environment.watchdog_usec);
  if (!time_us || *time_us == 0) {
    problems_.push_back(problem("WATCHDOG_USEC", *environment.watchdog_usec,
                                "which is no time in microseconds; no watchdog is fed"));
    return;
  }
  const auto quarter_us = std::min<std::uint64_t>(*time_us / 4, longest_feeding.count());
  feeding_period_ =
      std::max(shortest_feeding, std::chrono::microseconds(static_cast<std::int64_t>(quarter_us)));
}

bool ServiceManager::send(std::string_view lines) const {
  // Addressed anew each time: a restarted manager binds another socket under the same name.
  const ssize_t sent = sendto(socket_.get(), lines.data(), lines.size(), MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&address_), address_bytes_);
  return sent == static_cast<ssize_t>(lines.size());
}

void ServiceManager::turned(Clock::time_point now) {
  if (address_bytes_ == 0) return;
  if (!ready_) ready_ = send("READY=1\n");
  if (status_ != sent_status_ && (!status_sent_ || now - *status_sent_ >= status_interval) &&
      send("STATUS=" + status_ + "\n")) {
    sent_status_ = status_;
    status_sent_ = now;
  }
  if (feeding_period_ && (!fed_ || now - *fed_ >= *feeding_period_) && send("WATCHDOG=1\n"))
    fed_ = now;
}

void ServiceManager::set_status(std::string_view status) {
  if (address_bytes_ > 0) status_ = base::excerpt(status, longest_status_bytes);
}

void ServiceManager::stopping() {
  if (address_bytes_ > 0) send("STOPPING=1\n");
}

}  // namespace gazed::daemon
