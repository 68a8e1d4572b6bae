#include "tests/unit/drivers/naoqi/fake_naoqi.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>

#include "tests/unit/drivers/naoqi/message_bytes.hpp"

namespace gazed::naoqi {

namespace {

constexpr std::uint32_t first_method = 100;
constexpr std::uint32_t service_number = 7;

}  // namespace

FakeAnswer fake_error(std::string_view text) {
  FakeAnswer answer;
  answer.type = QiType::error;
  answer.payload.dynamic(text);
  return answer;
}

FakeAnswer fake_silence() {
  FakeAnswer answer;
  answer.silent = true;
  return answer;
}

FakeAnswer fake_numbers(std::initializer_list<float> numbers) {
  FakeAnswer answer;
  answer.payload.u32(static_cast<std::uint32_t>(numbers.size()));
  for (const float number : numbers) answer.payload.f32(number);
  return answer;
}

FakeNaoqi::FakeNaoqi() : listener_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* any = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (bind(listener_.get(), any, size) != 0 || listen(listener_.get(), 8) != 0 ||
      getsockname(listener_.get(), any, &size) != 0)
    throw std::system_error(errno, std::generic_category(), "listening on the loopback");
  port_ = ntohs(address.sin_port);
}

bool FakeNaoqi::serve() {
  answered_ = false;
  accept_clients();
  clients_.remove_if([this](Client& client) { return !receive(client); });
  return answered_;
}

void await_arrival(int descriptor) {
  constexpr int longest_ms = 5;  // nothing comes at a connection that was given up
  pollfd arrival{descriptor, POLLIN, 0};
  poll(&arrival, 1, longest_ms);
}

void FakeNaoqi::accept_clients() {
  while (true) {
    base::FileDescriptor socket(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK));
    if (socket.get() < 0) return;
    if (!listens) continue;
    const int on = 1;  // several small answers at once are not to wait for each other
    setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ++connections;
    clients_.push_back({std::move(socket), {}});
  }
}

bool FakeNaoqi::receive(Client& client) {
  if (!answers) return true;
  std::array<char, 4096> some{};
  const ssize_t count = recv(client.socket.get(), some.data(), some.size(), 0);
  if (count <= 0) return count < 0 && errno == EAGAIN;
  client.received.append(some.data(), static_cast<std::size_t>(count));
  while (client.received.size() >= sizeof(QiHeader)) {
    QiHeader header;
    std::memcpy(&header, client.received.data(), sizeof header);
    const std::size_t whole = sizeof header + header.payload_bytes;
    if (client.received.size() < whole) break;
    const std::string message = client.received.substr(0, whole);
    client.received.erase(0, whole);
    answer(client, {header, QiBytes(message).substr(sizeof header)});
  }
  return true;
}

void FakeNaoqi::answer(Client& client, const QiMessage& message) {
  received.push_back(message.header.type);
  if (message.header.type != QiType::call) return;
  const FakeAnswer answer = answer_to(message);
  if (answer.silent) return;
  QiHeader header = message.header;
  header.type = answer.type;
  header.flags = answer.flags;
  const std::string bytes = message_bytes(header, answer.payload.bytes());
  answered_ = true;
  for (QiBytes rest = bytes; !rest.empty();) {
    const ssize_t sent = send(client.socket.get(), rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent < 0) return;
    rest.remove_prefix(static_cast<std::size_t>(sent));
  }
}

FakeAnswer FakeNaoqi::answer_to(const QiMessage& message) {
  const QiHeader& header = message.header;
  if (header.service == 0) return authenticate(message.payload);
  if (header.service == 1) return service_info();
  if (header.service != service_number) return fake_error("can't find service");
  if (header.action == 2) return meta_object();
  const std::size_t method = header.action - first_method;
  if (method >= methods.size()) return fake_error("can't find method");
  called.push_back(methods[method].name);
  const std::string_view parameters = methods[method].parameters;
  const std::string_view types = parameters.substr(1, parameters.size() - 2);
  return methods[method].handler(QiReader(message.payload, types));
}

FakeAnswer FakeNaoqi::authenticate(QiBytes capabilities) {
  // The words of NAOqi 2.1, which has no service 0 (QiLoop, bus/auth.go).
  if (!knows_authentication) return fake_error("can't find service, address: {0.0.8, id: 1}");
  QiReader entries = QiReader(capabilities, "{sm}").next().elements();
  while (const auto key = entries.next().text()) {
    const QiValue value = entries.next();
    if (key == "auth_user") user = value.text().value_or("");
    if (key == "auth_token") token = value.text().value_or("");
  }
  FakeAnswer answer;
  answer.payload.u32(2).text("MessageFlags").text("b").integer(1, 1);
  answer.payload.text("__qi_auth_state").text("I").u32(authentication_state);
  return answer;
}

FakeAnswer FakeNaoqi::service_info() const {
  FakeAnswer answer;
  answer.payload.text("ALMotion").u32(service_number).text("machine").u32(1);
  const std::vector<std::string> here{"qi:anything", "tcp://" + base::to_string(endpoint())};
  const auto& listed = places.empty() ? here : places;
  answer.payload.u32(static_cast<std::uint32_t>(listed.size()));
  for (const std::string& place : listed) answer.payload.text(place);
  answer.payload.text("session").text("an object's number");
  return answer;
}

FakeAnswer FakeNaoqi::meta_object() const {
  FakeAnswer answer;
  answer.payload.u32(static_cast<std::uint32_t>(methods.size()));
  std::uint32_t number = first_method;
  for (const Method& method : methods) {
    answer.payload.u32(number).u32(number).text(method.returns).text(method.name);
    answer.payload.text(method.parameters).text("what it does");
    answer.payload.u32(1).text("a parameter").text("what it is").text("what it returns");
    ++number;
  }
  answer.payload.u32(0).u32(0).text("signals, properties and a description");
  return answer;
}

int FakeNaoqi::calls_of(const std::string& name) const {
  return static_cast<int>(std::ranges::count(called, name));
}

void FakeNaoqi::send_to_all(QiBytes bytes) {
  for (const Client& client : clients_)
    static_cast<void>(!send(client.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL));
}

}  // namespace gazed::naoqi
