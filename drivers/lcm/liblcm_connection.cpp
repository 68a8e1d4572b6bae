#include <cstdint>
#include <lcm/lcm.h>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "drivers/lcm/other_providers.hpp"
#include "drivers/lcm/settings.hpp"

namespace gazed::lcm {

namespace {

class LiblcmConnection final : public Connection {
 public:
  [[nodiscard]] static std::unique_ptr<LiblcmConnection> open(const std::string& url,
                                                              Subscriptions& subscriptions);

  [[nodiscard]] int descriptor() const override;
  [[nodiscard]] bool read_channel(const Subscription& subscription) override;
  [[nodiscard]] bool receive(int most, Clock::time_point now) override;
  [[nodiscard]] bool send(const std::string& channel,
                          std::span<const std::uint8_t> message) override;

 private:
  struct Destroy {
    void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
  };
  LiblcmConnection(lcm_t* lcm, Subscriptions& subscriptions)
      : subscriptions_(subscriptions), lcm_(lcm) {}
  static void deliver(const lcm_recv_buf_t* buffer, const char* channel, void* connection);

  Subscriptions& subscriptions_;
  std::unique_ptr<lcm_t, Destroy> lcm_;
};

std::unique_ptr<LiblcmConnection> LiblcmConnection::open(const std::string& url,
                                                         Subscriptions& subscriptions) {
  lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) return nullptr;
  std::unique_ptr<LiblcmConnection> made(new LiblcmConnection(lcm, subscriptions));
  for (const Subscription& one : subscriptions.all()) {
    if (!made->read_channel(one)) return nullptr;
  }
  if (made->descriptor() < 0) return nullptr;
  return made;
}

int LiblcmConnection::descriptor() const {
  return lcm_get_fileno(lcm_.get());
}

bool LiblcmConnection::read_channel(const Subscription& subscription) {
  return lcm_subscribe(lcm_.get(), subscription.channel.c_str(), &LiblcmConnection::deliver,
                       this) != nullptr;
}

void LiblcmConnection::deliver(const lcm_recv_buf_t* buffer, const char* channel,
                               void* connection) {
  static_cast<LiblcmConnection*>(connection)
      ->subscriptions_.deliver(channel,
                               {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

bool LiblcmConnection::receive(int most, Clock::time_point /*now*/) {
  for (int i = 0; i < most; ++i) {
    const int handled = lcm_handle_timeout(lcm_.get(), 0);
    if (handled < 0) return false;
    if (handled == 0) return true;
  }
  return true;
}

bool LiblcmConnection::send(const std::string& channel, std::span<const std::uint8_t> message) {
  return lcm_publish(lcm_.get(), channel.c_str(), message.data(),
                     static_cast<unsigned>(message.size())) == 0;
}

}  // namespace

std::span<const std::string_view> other_providers() {
  return liblcm_providers;
}

std::unique_ptr<Connection> open_other_provider(const std::string& url,
                                                Subscriptions& subscriptions) {
  return LiblcmConnection::open(url, subscriptions);
}

}  // namespace gazed::lcm
