// A robot's NAOqi on a port of this computer, in the test's own thread: it does something when
// serve() is called, and nothing else.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <vector>

#include "agent/base/endpoint.hpp"
#include "agent/base/file_descriptor.hpp"
#include "drivers/naoqi/connection.hpp"

namespace gazed::naoqi {

struct FakeAnswer {
  QiWriter payload;
  QiType type = QiType::reply;
  std::uint8_t flags = 0;
  bool silent = false;
};

/// An answer is not always there when send() returns: the computer may be busy.
void await_arrival(int descriptor);

[[nodiscard]] FakeAnswer fake_error(std::string_view text);
[[nodiscard]] FakeAnswer fake_silence();
/// "[f]".
[[nodiscard]] FakeAnswer fake_numbers(std::initializer_list<float> numbers);

class FakeNaoqi {
 public:
  using Handler = std::function<FakeAnswer(QiReader arguments)>;
  struct Method {
    std::string name, parameters, returns;
    Handler handler;
  };

  FakeNaoqi();

  /// Takes connections, answers what has come. True when it has answered something.
  bool serve();
  [[nodiscard]] base::Endpoint endpoint() const { return {0x7f000001, port_}; }
  /// The names of the methods called so far.
  [[nodiscard]] int calls_of(const std::string& name) const;
  void close_all() { clients_.clear(); }
  void send_to_all(QiBytes bytes);

  // How it behaves.
  std::vector<Method> methods;
  bool answers = true;               // false: it takes connections, and says nothing
  bool listens = true;               // false: whoever comes is sent away
  bool knows_authentication = true;  // false: as NAOqi 2.1
  std::uint32_t authentication_state = 3;
  std::string user, token;          // as whom the last one came
  std::vector<std::string> places;  // of every service; empty: here
  std::vector<QiType> received;     // every message, in order
  std::vector<std::string> called;  // methods
  int connections = 0;

 private:
  struct Client {
    base::FileDescriptor socket;
    std::string received;  // not yet a whole message
  };

  void accept_clients();
  [[nodiscard]] bool receive(Client& client);
  void answer(Client& client, const QiMessage& message);
  [[nodiscard]] FakeAnswer answer_to(const QiMessage& message);
  [[nodiscard]] FakeAnswer authenticate(QiBytes capabilities);
  [[nodiscard]] FakeAnswer service_info() const;
  [[nodiscard]] FakeAnswer meta_object() const;

  base::FileDescriptor listener_;
  std::uint16_t port_ = 0;
  bool answered_ = false;
  std::list<Client> clients_;
};

}  // namespace gazed::naoqi
