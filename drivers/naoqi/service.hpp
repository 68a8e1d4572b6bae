// One service of a robot's NAOqi, such as "ALMotion", over its own connection.
//
// The directory, service 1, knows where a service lives; the service itself lists its methods.
// Method numbers differ between robots, so here methods are identified by name and parameters.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/naoqi/connection.hpp"
#include "drivers/naoqi/settings.hpp"

namespace gazed::naoqi {

/// The robot, and the user to log in as.
struct QiRobot {
  base::Endpoint directory;
  NaoqiLogin login;
};

/// A method to look up.
struct QiMethod {
  std::string_view name, parameters;  // "getAngles", "(mb)"
  bool required = true;               // the service is unusable without it
};

/// A method to call.
struct QiFunction {
  std::uint32_t action = 0;
  std::string returns;
};

/// Why a call failed, where that decides what to do next.
enum class QiFailure : std::uint8_t { no_such_service, no_answer, other };

/// The result of a call. Valid in the callback and until the next serve().
struct QiResult {
  QiValue value;                         // none if the call failed
  std::string_view error;                // the reason, in words
  QiFailure failure = QiFailure::other;  // kind of failure, if it failed
};

// Requests that every robot must answer before a service can be used (QiLoop,
// about-qimessaging.md), and their answers.

inline const QiFunction qi_authenticate{8, "{sm}"};
[[nodiscard]] bool authentication_is_done(const QiValue& answer);
/// An error's payload is only a text, without a number (QiLoop, about-qimessaging.md). Only this
/// function interprets it.
[[nodiscard]] QiFailure failure_in(std::string_view error);

/// Asks the directory where a service lives: name, number, machine, process, addresses, session.
inline const QiFunction qi_service{100, "(sIsI[s]s)"};
/// Prefers the address that was already `reached`; otherwise the first that can be reached.
[[nodiscard]] std::optional<base::Endpoint> address_in(const QiValue& service,
                                                       const base::Endpoint& reached);

/// Asks the service for its methods: each number, the number again, return type, name, parameters,
/// and more.
inline const QiFunction qi_methods{2, "({I(Issss[(ss)]s)})"};
[[nodiscard]] std::optional<QiFunction> find_method(const QiValue& meta_object,
                                                    const QiMethod& method);

/// Connects, and reconnects after a loss: after 0.1 s, then 0.2, 0.4, and every 0.5 s. A call fails
/// if it is not answered within a second, an authentication within 0.5 s. Later answers are
/// ignored, except one that is already in the socket when the loop comes round. The connection is
/// lost if the robot sends nothing for a second while requests are pending.
///
/// NAOqi 2.1, which has no authentication, is addressed like the official client does (libqi
/// 4.0.3); not validated on a robot.
class QiService {
 public:
  using Done = std::function<void(const QiResult&)>;

  QiService(WakeUp& wake_up, QiRobot robot, std::string name, std::span<const QiMethod> methods);

  /// Does whatever can be done now; callbacks are called from here. `now_us` must not decrease.
  /// Returns true if a message came, since there may be another.
  bool serve(std::int64_t now_us);
  /// When serve() must be called even if nothing arrives.
  [[nodiscard]] std::int64_t due_us() const;

  [[nodiscard]] bool ready() const { return ready_; }
  [[nodiscard]] bool busy() const { return !pending_.empty(); }
  /// `method` is an index into the constructor's methods.
  [[nodiscard]] bool has(std::size_t method) const { return ready_ && found_[method].has_value(); }
  /// `done` is called exactly once, unless the service is destroyed first. Calling a method that
  /// does not exist fails at once.
  void call(std::size_t method, QiBytes arguments, Done done);

  /// Why it is not ready; empty if it is, and until the first attempt has failed.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  struct Pending {
    std::uint32_t id = 0;
    std::string_view returns;  // of a QiFunction, which outlives the call
    std::int64_t deadline_us = 0;
    Done done;
  };

  void request(std::uint32_t service, const QiFunction& call, QiBytes arguments, Done done);
  void take(const QiMessage& message);
  void expire();
  void finish(std::vector<Pending>::iterator call, const QiResult& result);
  void lose(const std::string& why);

  void connect(const base::Endpoint& to, const std::function<void()>& then);
  void find_service();
  void find_methods();

  WakeUp& wake_up_;
  QiRobot robot_;
  std::string name_;
  std::span<const QiMethod> methods_;
  std::vector<std::optional<QiFunction>> found_;
  std::optional<QiConnection> connection_;  // none between two attempts
  base::Endpoint connected_to_;
  bool ready_ = false;
  std::uint32_t service_ = 0;
  std::uint32_t last_id_ = 0;
  std::vector<Pending> pending_;  // oldest first
  std::int64_t now_us_ = 0, heard_us_ = 0, next_attempt_us_ = 0, back_off_us_ = 0;
  std::string fault_;
};

}  // namespace gazed::naoqi
