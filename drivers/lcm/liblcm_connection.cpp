#include "drivers/lcm/liblcm_connection.hpp"

namespace gazed::lcm {

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

}  // namespace gazed::lcm
