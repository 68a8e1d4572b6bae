// To be loaded before libc (LD_PRELOAD): how long the turns of gazed's loop take. A turn is what
// lies between two of its poll(). At the end GAZED_TURNS=FILE gets a line for the turns without a
// view, and one for those that worked on one: how many, the longest, the longest that one of them
// slept, and what that one did meanwhile.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr nfds_t descriptors_of_the_loop = 4;
constexpr double warm_up_s = 2.0;  // memory is touched for the first time

struct Times {
  double wall_s = 0.0, cpu_s = 0.0;
  double ready_s = 0.0;  // while others had the processor
  long given_up = 0;     // the processor, to wait for something
  long read_in = 0;      // pages, from a disk
};

/// The longest system call of a turn.
struct Call {
  const char* name = "none";
  double took_s = 0.0;
};

struct Turns {
  long count = 0;
  double longest_s = 0.0, longest_sleep_s = 0.0;
  Times sleep;  // what passed in the turn that slept longest
  Call sleep_call;
};

bool view_in_turn = false;
std::array<Turns, 2> turns;  // others, with a view
Times begin;
Call longest_call;
double first_s = 0.0;

double seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The second number of schedstat (Linux, Documentation/scheduler/sched-stats.rst).
double ready_seconds() {
  static const int file = ::open("/proc/self/schedstat", O_RDONLY | O_CLOEXEC);
  std::array<char, 128> text{};
  if (pread(file, text.data(), text.size() - 1, 0) <= 0) return 0.0;
  char* rest = nullptr;
  std::strtoll(text.data(), &rest, 10);
  return 1e-9 * static_cast<double>(std::strtoll(rest, nullptr, 10));
}

/// Read again where others had the processor between the clocks: what they took would be in one of
/// them only, and look like a turn's.
Times now() {
  rusage usage{};
  Times times;
  do {
    times.ready_s = ready_seconds();
    getrusage(RUSAGE_THREAD, &usage);
    times.wall_s = seconds(CLOCK_MONOTONIC);
    times.cpu_s = seconds(CLOCK_THREAD_CPUTIME_ID);
  } while (ready_seconds() != times.ready_s);
  times.given_up = usage.ru_nvcsw;
  times.read_in = usage.ru_majflt;
  return times;
}

void end_turn() {
  const Times end = now();
  if (first_s == 0.0) first_s = end.wall_s;
  if (begin.wall_s > first_s + warm_up_s) {
    Turns& kind = turns[view_in_turn ? 1 : 0];
    const Times took{end.wall_s - begin.wall_s, end.cpu_s - begin.cpu_s,
                     end.ready_s - begin.ready_s, end.given_up - begin.given_up,
                     end.read_in - begin.read_in};
    const double own_s = took.wall_s - took.ready_s;
    ++kind.count;
    if (own_s > kind.longest_s) kind.longest_s = own_s;
    if (own_s - took.cpu_s > kind.longest_sleep_s) {
      kind.longest_sleep_s = own_s - took.cpu_s;
      kind.sleep = took;
      kind.sleep_call = longest_call;
    }
  }
  view_in_turn = false;
  longest_call = {};
}

/// Remembers how long it takes until it goes.
class Timed {
 public:
  explicit Timed(const char* name) : name_(name), begin_s_(seconds(CLOCK_MONOTONIC)) {}
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;
  ~Timed() {
    const double took_s = seconds(CLOCK_MONOTONIC) - begin_s_;
    if (took_s > longest_call.took_s) longest_call = {name_, took_s};
  }

 private:
  const char* name_;
  double begin_s_;
};

template <class Result, class... Arguments>
Result timed(const char* name, Arguments... arguments) {
  const auto next = reinterpret_cast<Result (*)(Arguments...)>(dlsym(RTLD_NEXT, name));
  const Timed timed(name);
  return next(arguments...);
}

__attribute__((destructor)) void tell() {
  const char* path = std::getenv("GAZED_TURNS");
  if (path == nullptr || first_s == 0.0) return;
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return;
  for (const Turns& kind : turns) {
    std::fprintf(file,
                 "%ld %.3f %.3f it gave the processor up %ld times, read %ld pages in, worked for "
                 "%.1f ms; its longest call was %s, %.1f ms\n",
                 kind.count, 1e3 * kind.longest_s, 1e3 * kind.longest_sleep_s, kind.sleep.given_up,
                 kind.sleep.read_in, 1e3 * kind.sleep.cpu_s, kind.sleep_call.name,
                 1e3 * kind.sleep_call.took_s);
  }
  std::fclose(file);
}

}  // namespace

extern "C" {

int poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  using Poll = int(pollfd*, nfds_t, int);
  static const auto next = reinterpret_cast<Poll*>(dlsym(RTLD_NEXT, "poll"));
  const bool is_the_loop = count == descriptors_of_the_loop;
  if (!is_the_loop) return timed<int>("poll", descriptors, count, timeout_ms);
  end_turn();
  const int ready = next(descriptors, count, timeout_ms);
  begin = now();
  return ready;
}

/// Each view that was worked on ends in a saliency map.
ssize_t sendto(int socket, const void* bytes, std::size_t size, int flags, const sockaddr* to,
               socklen_t to_bytes) {
  constexpr std::size_t headers_bytes = 100;  // of a datagram, with the channel's name
  const std::string_view head(static_cast<const char*>(bytes),
                              size < headers_bytes ? size : headers_bytes);
  if (head.find("_SALIENCY") != std::string_view::npos) view_in_turn = true;
  return timed<ssize_t>("sendto", socket, bytes, size, flags, to, to_bytes);
}

ssize_t recvfrom(int socket, void* bytes, std::size_t size, int flags, sockaddr* from,
                 socklen_t* from_bytes) {
  return timed<ssize_t>("recvfrom", socket, bytes, size, flags, from, from_bytes);
}
ssize_t send(int socket, const void* bytes, std::size_t size, int flags) {
  return timed<ssize_t>("send", socket, bytes, size, flags);
}
ssize_t recv(int socket, void* bytes, std::size_t size, int flags) {
  return timed<ssize_t>("recv", socket, bytes, size, flags);
}
ssize_t read(int file, void* bytes, std::size_t size) {
  return timed<ssize_t>("read", file, bytes, size);
}
ssize_t write(int file, const void* bytes, std::size_t size) {
  return timed<ssize_t>("write", file, bytes, size);
}
std::FILE* fopen(const char* path, const char* mode) {
  return timed<std::FILE*>("fopen", path, mode);
}
int fclose(std::FILE* file) {
  return timed<int>("fclose", file);
}
pid_t waitpid(pid_t process, int* status, int options) {
  return timed<pid_t>("waitpid", process, status, options);
}
int socket(int domain, int type, int protocol) noexcept {
  return timed<int>("socket", domain, type, protocol);
}
int connect(int socket, const sockaddr* address, socklen_t bytes) {
  return timed<int>("connect", socket, address, bytes);
}

}  // extern "C"
