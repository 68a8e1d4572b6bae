// One service of a robot's NAOqi ("ALMotion"), over a connection of its own.
//
// Where a service lives is asked for at the directory, service 1; what its methods are is asked for
// at the service. Numbers of methods differ from robot to robot: here they go by name and
// parameters.
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

/// The robot to ask for services, and the user to log in as.
struct QiRobot {
  base::Endpoint directory;
  NaoqiLogin login;
};

/// A method as it is asked for.
struct QiMethod {
  std::string_view name, parameters;  // "getAngles", "(mb)"
  bool required = true;               // without it the service is of no use
};

/// A method as it is called.
struct QiFunction {
  std::uint32_t action = 0;
  std::string returns;
};

/// Why a call failed, as far as that decides what is done next.
enum class QiFailure : std::uint8_t { no_such_service, no_answer, other };

/// What came of a call. Borrowed: valid in the callback, and until the next serve().
struct QiResult {
  QiValue value;                         // none when it failed
  std::string_view error;                // why, in words
  QiFailure failure = QiFailure::other;  // of one that failed
};

// What every robot is asked before a service can be used (QiLoop, about-qimessaging.md), and what
// is in its answer.

inline const QiFunction qi_authenticate{8, "{sm}"};
[[nodiscard]] bool authentication_is_done(const QiValue& answer);
/// An error's payload is a text and nothing else, no number (QiLoop, about-qimessaging.md). This is
/// the one place that reads it.
[[nodiscard]] QiFailure failure_in(std::string_view error);

/// To the directory, where a service lives: name, number, machine, process, addresses, session.
inline const QiFunction qi_service{100, "(sIsI[s]s)"};
/// Of the addresses the one that was `reached` already, else the first that can be.
[[nodiscard]] std::optional<base::Endpoint> address_in(const QiValue& service,
                                                       const base::Endpoint& reached);

/// To the service, what its methods are: each number, and again, what it returns, name, parameters,
/// and more.
inline const QiFunction qi_methods{2, "({I(Issss[(ss)]s)})"};
[[nodiscard]] std::optional<QiFunction> find_method(const QiValue& meta_object,
                                                    const QiMethod& method);

/// Connects, and again when the connection is lost, after 0.1 s, then 0.2, 0.4, and every
/// 0.5 s. A call that is not answered within a second has failed, an authentication within 0.5 s;
/// an answer that comes later is passed over, but not one that waits whole until the loop turns
/// again. A robot that sends nothing at all for a second while it is asked is lost.
///
/// NAOqi 2.1, which knows no authentication, is addressed as the official client does
/// (libqi 4.0.3); not validated on a robot.
class QiService {
 public:
  using Done = std::function<void(const QiResult&)>;

  QiService(WakeUp& wake_up, QiRobot robot, std::string name, std::span<const QiMethod> methods);

  /// Does what can be done now; callbacks are called from here. `now_us` never goes back. True when
  /// a message came: there may be another.
  bool serve(std::int64_t now_us);
  /// When serve() has something to do even if nothing comes.
  [[nodiscard]] std::int64_t due_us() const;

  [[nodiscard]] bool ready() const { return ready_; }
  [[nodiscard]] bool busy() const { return !pending_.empty(); }
  /// `method` is an index of the methods handed to the constructor.
  [[nodiscard]] bool has(std::size_t method) const { return ready_ && found_[method].has_value(); }
  /// `done` is called exactly once, but for a service that ends before. A method that is not there
  /// fails at once.
  void call(std::size_t method, QiBytes arguments, Done done);

  /// Why it is not ready; empty when it is, and until the first attempt has failed.
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
