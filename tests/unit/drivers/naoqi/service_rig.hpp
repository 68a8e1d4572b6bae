// A service and the robot that it belongs to, in the test's own time.
#pragma once

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "drivers/naoqi/service.hpp"

#include "tests/unit/drivers/naoqi/fake_naoqi.hpp"

namespace gazed::naoqi {

// The service's time is the test's, and goes on by 1 ms a turn. What really takes time is only the
// loopback, which is given all the turns it needs.
class QiServiceRig : public testing::Test {
 protected:
  static constexpr std::array<QiMethod, 3> methods{
      {{"ask", "(s)"}, {"tell", "(mf)"}, {"dance", "()", false}}};
  enum : std::size_t { ask, tell, dance };

  QiServiceRig() {
    fake_.methods = {{"ask", "(s)", "[f]",
                      [](QiReader) {
                        return fake_numbers({0.5F, 0.25F});
                      }},
                     {"ask", "(i)", "v", [](QiReader) { return fake_error("the wrong one"); }},
                     {"tell", "(mf)", "v", [](QiReader) { return FakeAnswer{}; }}};
  }

  QiService& dut(const std::string& user = "", const std::string& token = "") {
    if (!dut_) dut_.emplace(wake_up_, QiRobot{fake_.endpoint(), user, token}, "ALMotion", methods);
    return *dut_;
  }

  void turn() {
    if (fake_.serve()) await_arrival(wake_up_.descriptor());
    dut().serve(now_us_ += 1'000);
  }

  template <typename Condition>
  bool turn_until(Condition condition, int turns = 5'000) {
    for (int i = 0; i < turns && !condition(); ++i) turn();
    return condition();
  }
  bool turn_until_ready() {
    return turn_until([this] { return dut().ready(); });
  }
  bool turn_until_fault(const std::string& text) {
    return turn_until([&] { return dut().fault().find(text) != std::string::npos; });
  }

  /// The error of a call; none when it is answered.
  std::string error_of_call(std::size_t method) {
    std::optional<std::string> error;
    dut().call(method, {}, [&](const QiResult& result) { error = result.error; });
    turn_until([&] { return error.has_value(); });
    return error.value_or("never answered");
  }

  FakeNaoqi fake_;
  WakeUp wake_up_;
  std::int64_t now_us_ = 1'000'000'000;
  std::optional<QiService> dut_;
};

}  // namespace gazed::naoqi
