// A network of a test's own, where routes can be taken away.
#pragma once

#include <arpa/inet.h>
#include <cstdio>
#include <cstring>
#include <functional>
#include <net/if.h>
#include <net/route.h>
#include <sched.h>
#include <source_location>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gazed::test {

inline constexpr int passed = 0;
inline constexpr int failed = 1;
inline constexpr int no_namespace = 77;

// A socket for ioctl(), as `ip` uses; what it does is undone with the namespace.
class Network {
 public:
  ~Network() { close(socket_); }

  bool set_loopback_up() {
    ifreq request{};
    std::strcpy(request.ifr_name, "lo");
    if (ioctl(socket_, SIOCGIFFLAGS, &request) != 0) return false;
    request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP);
    return ioctl(socket_, SIOCSIFFLAGS, &request) == 0;
  }
  bool add_multicast_route() { return change_route(SIOCADDRT); }
  bool remove_multicast_route() { return change_route(SIOCDELRT); }

 private:
  // 224.0.0.0/4 dev lo
  bool change_route(unsigned long request) {
    rtentry route{};
    char device[] = "lo";
    const auto set = [](sockaddr& to, const char* address) {
      sockaddr_in ip{};
      ip.sin_family = AF_INET;
      inet_pton(AF_INET, address, &ip.sin_addr);
      std::memcpy(&to, &ip, sizeof ip);
    };
    set(route.rt_dst, "224.0.0.0");
    set(route.rt_genmask, "240.0.0.0");
    route.rt_flags = RTF_UP;
    route.rt_dev = device;
    return ioctl(socket_, request, &route) == 0;
  }

  int socket_ = socket(AF_INET, SOCK_DGRAM, 0);
};

// Ends the child process, with the line, when something does not hold.
inline void require(bool holds, std::source_location where = std::source_location::current()) {
  if (holds) return;
  std::fprintf(stderr, "%s:%u: does not hold\n", where.file_name(), where.line());
  _exit(failed);
}

// Runs `test` in a process of its own whose network has nothing, not even a loopback that is up.
inline int in_empty_network(const std::function<void(Network&)>& test) {
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNET) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
      _exit(no_namespace);
    }
    Network network;
    test(network);
    _exit(passed);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : failed;
}

}  // namespace gazed::test
