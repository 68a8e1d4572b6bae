// The other end of sd_notify(3), for tests.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace gazed::test {

// The manager's side: a bound datagram socket, as systemd has it.
class NotifyReceiver {
 public:
  explicit NotifyReceiver(std::string name)
      : name_(std::move(name)),
        socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name_.data(), name_.size());
    std::size_t bytes = offsetof(sockaddr_un, sun_path) + name_.size();
    if (name_[0] == '@') {
      address.sun_path[0] = '\0';
    } else {
      ++bytes;
    }
    bound_ =
        bind(socket_, reinterpret_cast<sockaddr*>(&address), static_cast<socklen_t>(bytes)) == 0;
  }
  ~NotifyReceiver() {
    close(socket_);
    if (name_[0] == '/') unlink(name_.c_str());
  }
  NotifyReceiver(const NotifyReceiver&) = delete;
  NotifyReceiver& operator=(const NotifyReceiver&) = delete;

  bool bound() const { return bound_; }
  std::vector<std::string> received() const {
    std::vector<std::string> all;
    std::array<char, 4096> buffer;
    for (ssize_t n; (n = recv(socket_, buffer.data(), buffer.size(), 0)) >= 0;)
      all.emplace_back(buffer.data(), static_cast<std::size_t>(n));
    return all;
  }

 private:
  std::string name_;
  int socket_;
  bool bound_;
};

}  // namespace gazed::test
