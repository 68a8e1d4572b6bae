// LCM's other providers, for workstations: mpudpm, tcpq, memq and file, as liblcm has them.
#pragma once

#include <lcm/lcm.h>
#include <memory>
#include <string>

#include "drivers/lcm/connection.hpp"

namespace gazed::lcm {

class LiblcmConnection final : public Connection {
 public:
  /// None where liblcm cannot connect. `subscriptions` must outlive the connection.
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

}  // namespace gazed::lcm
