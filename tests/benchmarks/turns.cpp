// To be loaded before libc (LD_PRELOAD): how long the turns of gazed's loop take. A turn is what
// lies between two of its poll(). At the end GAZED_TURNS=FILE gets a line for the turns that worked
// on a view, and one for the others: how many, the longest, and the longest that one of them slept.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>

namespace {

constexpr nfds_t descriptors_of_the_loop = 4;
constexpr double warm_up_s = 2.0;  // memory is touched for the first time

struct Times {
  double wall_s = 0.0, cpu_s = 0.0;
  double ready_s = 0.0;  // while others had the processor
};

struct Turns {
  long count = 0;
  double longest_s = 0.0, longest_sleep_s = 0.0;
};

bool view_in_turn = false;
std::array<Turns, 2> turns;  // others, with a view
Times begin;
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

Times now() {
  return {seconds(CLOCK_MONOTONIC), seconds(CLOCK_THREAD_CPUTIME_ID), ready_seconds()};
}

void end_turn() {
  const Times end = now();
  if (first_s == 0.0) first_s = end.wall_s;
  if (begin.wall_s > first_s + warm_up_s) {
    Turns& kind = turns[view_in_turn ? 1 : 0];
    const double took_s = end.wall_s - begin.wall_s - (end.ready_s - begin.ready_s);
    const double slept_s = took_s - (end.cpu_s - begin.cpu_s);
    ++kind.count;
    if (took_s > kind.longest_s) kind.longest_s = took_s;
    if (slept_s > kind.longest_sleep_s) kind.longest_sleep_s = slept_s;
  }
  view_in_turn = false;
}

__attribute__((destructor)) void tell() {
  const char* path = std::getenv("GAZED_TURNS");
  if (path == nullptr || first_s == 0.0) return;
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return;
  for (const Turns& kind : turns)
    std::fprintf(file, "%ld %.3f %.3f\n", kind.count, 1e3 * kind.longest_s,
                 1e3 * kind.longest_sleep_s);
  std::fclose(file);
}

}  // namespace

extern "C" {

int poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  using Poll = int(pollfd*, nfds_t, int);
  static const auto next = reinterpret_cast<Poll*>(dlsym(RTLD_NEXT, "poll"));
  const bool is_the_loop = count == descriptors_of_the_loop;
  if (is_the_loop) end_turn();
  const int ready = next(descriptors, count, timeout_ms);
  if (is_the_loop) begin = now();
  return ready;
}

/// Each view that was worked on ends in a saliency map.
ssize_t sendto(int socket, const void* bytes, std::size_t size, int flags, const sockaddr* to,
               socklen_t to_bytes) {
  using Sendto = ssize_t(int, const void*, std::size_t, int, const sockaddr*, socklen_t);
  static const auto next = reinterpret_cast<Sendto*>(dlsym(RTLD_NEXT, "sendto"));
  constexpr std::size_t headers_bytes = 100;  // of a datagram, with the channel's name
  const std::string_view head(static_cast<const char*>(bytes),
                              size < headers_bytes ? size : headers_bytes);
  if (head.find("_SALIENCY") != std::string_view::npos) view_in_turn = true;
  return next(socket, bytes, size, flags, to, to_bytes);
}

}  // extern "C"
