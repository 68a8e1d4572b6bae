// To be loaded before libc (LD_PRELOAD): one call of one function fails, as on a machine without
// memory, room or devices. GAZED_FAIL=NAME:N:ERRNO chooses it, from 1; GAZED_CALLS=FILE is where
// the number of calls is written at the end, as "NAME N".
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

// glibc's own, under a name that nobody replaces.
extern "C" void* __libc_malloc(std::size_t bytes);

namespace {

struct Calls {
  std::string_view name;
  long count = 0;
};
enum Function : std::size_t {
  malloc_,
  writev_,
  fdatasync_,
  ftruncate_,
  fork_,
  send_,
  sendto_,
  recvfrom_,
  read_,
  open_,
  poll_,
  socket_,
};
std::array<Calls, 12> all_calls{{{"malloc"},
                                 {"writev"},
                                 {"fdatasync"},
                                 {"ftruncate"},
                                 {"fork"},
                                 {"send"},
                                 {"sendto"},
                                 {"recvfrom"},
                                 {"read"},
                                 {"open"},
                                 {"poll"},
                                 {"socket"}}};

/// Whether this call is the one. Allocates nothing.
bool fails(Function function) {
  Calls& calls = all_calls[function];
  ++calls.count;
  const char* chosen = std::getenv("GAZED_FAIL");
  if (chosen == nullptr || std::strncmp(chosen, calls.name.data(), calls.name.size()) != 0 ||
      chosen[calls.name.size()] != ':')
    return false;
  char* rest = nullptr;
  if (std::strtol(chosen + calls.name.size() + 1, &rest, 10) != calls.count) return false;
  errno = static_cast<int>(std::strtol(rest + 1, nullptr, 10));
  return true;
}

template <class Signature>
Signature* original(const char* name) {
  return reinterpret_cast<Signature*>(dlsym(RTLD_NEXT, name));
}

__attribute__((destructor)) void tell() {
  const char* path = std::getenv("GAZED_CALLS");
  if (path == nullptr) return;
  std::FILE* file = std::fopen(path, "w");
  for (const Calls& calls : all_calls)
    std::fprintf(file, "%s %ld\n", calls.name.data(), calls.count);
  std::fclose(file);
}

}  // namespace

extern "C" {

void* malloc(std::size_t bytes) {
  return fails(malloc_) ? nullptr : __libc_malloc(bytes);
}
ssize_t writev(int file, const iovec* parts, int count) {
  static const auto next = original<ssize_t(int, const iovec*, int)>("writev");
  return fails(writev_) ? -1 : next(file, parts, count);
}
ssize_t send(int socket, const void* bytes, std::size_t size, int flags) {
  static const auto next = original<ssize_t(int, const void*, std::size_t, int)>("send");
  return fails(send_) ? -1 : next(socket, bytes, size, flags);
}
ssize_t sendto(int socket, const void* bytes, std::size_t size, int flags, const sockaddr* to,
               socklen_t to_bytes) {
  static const auto next =
      original<ssize_t(int, const void*, std::size_t, int, const sockaddr*, socklen_t)>("sendto");
  return fails(sendto_) ? -1 : next(socket, bytes, size, flags, to, to_bytes);
}
ssize_t recvfrom(int socket, void* bytes, std::size_t size, int flags, sockaddr* from,
                 socklen_t* from_bytes) {
  static const auto next =
      original<ssize_t(int, void*, std::size_t, int, sockaddr*, socklen_t*)>("recvfrom");
  return fails(recvfrom_) ? -1 : next(socket, bytes, size, flags, from, from_bytes);
}
ssize_t read(int file, void* bytes, std::size_t size) {
  static const auto next = original<ssize_t(int, void*, std::size_t)>("read");
  return fails(read_) ? -1 : next(file, bytes, size);
}
int open(const char* path, int flags, ...) {
  static const auto next = original<int(const char*, int, mode_t)>("open");
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return fails(open_) ? -1 : next(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  static const auto next = original<int(const char*, int, mode_t)>("open64");
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return fails(open_) ? -1 : next(path, flags, mode);
}
int poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  static const auto next = original<int(pollfd*, nfds_t, int)>("poll");
  return fails(poll_) ? -1 : next(descriptors, count, timeout_ms);
}
int fdatasync(int file) {
  static const auto next = original<int(int)>("fdatasync");
  return fails(fdatasync_) ? -1 : next(file);
}
int ftruncate64(int file, off64_t bytes) noexcept {
  static const auto next = original<int(int, off64_t)>("ftruncate64");
  return fails(ftruncate_) ? -1 : next(file, bytes);
}
pid_t fork() noexcept {
  static const auto next = original<pid_t()>("fork");
  return fails(fork_) ? -1 : next();
}
int socket(int domain, int type, int protocol) noexcept {
  static const auto next = original<int(int, int, int)>("socket");
  return fails(socket_) ? -1 : next(domain, type, protocol);
}

}  // extern "C"
