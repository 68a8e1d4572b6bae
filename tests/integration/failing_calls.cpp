// To be loaded before libc (LD_PRELOAD): one call of one function fails, as on a machine without
// memory, room or devices. GAZED_FAIL=NAME:N:ERRNO chooses it, from 1; GAZED_CALLS=FILE is where
// the number of calls is written at the end, as "NAME N". Calls before and after main(), of
// libraries and of constants, are not counted: nothing runs yet that could be left behind, and GLib
// aborts.
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <ifaddrs.h>
#include <poll.h>
#include <string_view>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

// glibc's own, under a name that nobody replaces.
extern "C" void* __libc_malloc(std::size_t bytes);
extern "C" void* __libc_realloc(void* memory, std::size_t bytes);

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
  bind_,
  connect_,
  fopen_,
  fstat_,
  flock_,
  getifaddrs_,
  ioctl_,
  mkdir_,
  mmap_,
  realloc_,
  recv_,
  rename_,
  setsockopt_,
  sigaction_,
  signalfd_,
  socketpair_,
  functions,
};
std::array<Calls, functions> all_calls{
    {{"malloc"},     {"writev"},    {"fdatasync"}, {"ftruncate"}, {"fork"},  {"send"},
     {"sendto"},     {"recvfrom"},  {"read"},      {"open"},      {"poll"},  {"socket"},
     {"bind"},       {"connect"},   {"fopen"},     {"fstat"},     {"flock"}, {"getifaddrs"},
     {"ioctl"},      {"mkdir"},     {"mmap"},      {"realloc"},   {"recv"},  {"rename"},
     {"setsockopt"}, {"sigaction"}, {"signalfd"},  {"socketpair"}}};

bool in_main = false;

/// Whether this call is the one. Allocates nothing.
bool fails(Function function) {
  if (!in_main) return false;
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

using Main = int(int, char**, char**);
Main* main_of_the_program = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  in_main = true;
  const int result = main_of_the_program(argc, argv, environment);
  in_main = false;
  return result;
}

/// For functions that return an int, and -1 for a failure.
template <class... Arguments>
int call(Function function, const char* name, Arguments... arguments) {
  return fails(function) ? -1 : original<int(Arguments...)>(name)(arguments...);
}

}  // namespace

extern "C" {

/// What a program's first instructions call (Linux Standard Base 5.0, "__libc_start_main").
int __libc_start_main(Main* program, int argc, char** argv, void (*init)(),
                      void (*fini)(),  // NOLINT
                      void (*loader_fini)(), void* stack_end) {
  using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
  main_of_the_program = program;
  return original<Start>("__libc_start_main")(counted_main, argc, argv, init, fini, loader_fini,
                                              stack_end);
}

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
  return call(fdatasync_, "fdatasync", file);
}
int ftruncate64(int file, off64_t bytes) noexcept {
  return call(ftruncate_, "ftruncate64", file, bytes);
}
pid_t fork() noexcept {
  return call(fork_, "fork");
}
int socket(int domain, int type, int protocol) noexcept {
  return call(socket_, "socket", domain, type, protocol);
}
int bind(int socket, const sockaddr* address, socklen_t bytes) noexcept {
  return call(bind_, "bind", socket, address, bytes);
}
int connect(int socket, const sockaddr* address, socklen_t bytes) {
  return call(connect_, "connect", socket, address, bytes);
}
int fstat64(int file, struct stat64* status) noexcept {
  return call(fstat_, "fstat64", file, status);
}
int flock(int file, int operation) noexcept {
  return call(flock_, "flock", file, operation);
}
int getifaddrs(ifaddrs** addresses) noexcept {
  return call(getifaddrs_, "getifaddrs", addresses);
}
int mkdir(const char* path, mode_t mode) noexcept {
  return call(mkdir_, "mkdir", path, mode);
}
int rename(const char* from, const char* to) noexcept {
  return call(rename_, "rename", from, to);
}
int setsockopt(int socket, int level, int name, const void* value, socklen_t bytes) noexcept {
  return call(setsockopt_, "setsockopt", socket, level, name, value, bytes);
}
int sigaction(int signal, const struct sigaction* action, struct sigaction* old) noexcept {
  return call(sigaction_, "sigaction", signal, action, old);
}
int signalfd(int file, const sigset_t* signals, int flags) noexcept {
  return call(signalfd_, "signalfd", file, signals, flags);
}
int socketpair(int domain, int type, int protocol, int ends[2]) noexcept {
  return call(socketpair_, "socketpair", domain, type, protocol, ends);
}
int ioctl(int file, unsigned long request, ...) noexcept {
  std::va_list more;
  va_start(more, request);
  void* argument = va_arg(more, void*);
  va_end(more);
  return call(ioctl_, "ioctl", file, request, argument);
}
ssize_t recv(int socket, void* bytes, std::size_t size, int flags) {
  return fails(recv_)
             ? -1
             : original<ssize_t(int, void*, std::size_t, int)>("recv")(socket, bytes, size, flags);
}
std::FILE* fopen(const char* path, const char* mode) {
  return fails(fopen_) ? nullptr
                       : original<std::FILE*(const char*, const char*)>("fopen")(path, mode);
}
void* mmap64(void* at, std::size_t bytes, int protection, int flags, int file,
             off64_t offset) noexcept {
  return fails(mmap_) ? MAP_FAILED
                      : original<void*(void*, std::size_t, int, int, int, off64_t)>("mmap64")(
                            at, bytes, protection, flags, file, offset);
}
void* realloc(void* memory, std::size_t bytes) {
  return fails(realloc_) ? nullptr : __libc_realloc(memory, bytes);
}

}  // extern "C"
