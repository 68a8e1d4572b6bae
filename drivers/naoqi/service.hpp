// One service of a robot's NAOqi ("ALMotion"), over a connection of its own.
//
// Where a service lives is asked for at the directory, service 1; what its methods are is asked for
// at the service. Numbers of methods differ from robot to robot: here they go by name and
// parameters.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/naoqi/answers.hpp"
#include "drivers/naoqi/connection.hpp"

namespace gazed {

/// Whom to ask for services, and as whom.
struct QiRobot {
  Endpoint directory;
  std::string user, token;  // for a robot that asks; else empty
};

/// What came of a call. Borrowed: valid in the callback, and until the next serve().
struct QiResult {
  std::optional<QiValue> value;  // none when it failed
  std::string_view error;        // why
};

/// Connects, and again when the connection is lost, after 0.1 s, then 0.2, 0.4, and every
/// 0.5 s. A call that is not answered within a second has failed, an authentication within 0.5 s;
/// an answer that comes later is passed over, but not one that waits until the loop turns again. A
/// robot that sends nothing at all for a second while it is asked is lost.
///
/// NAOqi 2.1, which knows no authentication, is spoken to as the official client does it (libqi
/// 4.0.3): not validated on a robot.
class QiService {
 public:
  using Done = std::function<void(const QiResult&)>;

  QiService(WakeUp& wake_up, QiRobot robot, std::string name, std::span<const QiMethod> methods);

  /// Does what can be done now; callbacks are called from here. `now_us` never goes back.
  void serve(std::int64_t now_us);
  /// When serve() has something to do even if nothing comes.
  [[nodiscard]] std::int64_t due_us() const;

  [[nodiscard]] bool ready() const { return stage_ == Stage::ready; }
  [[nodiscard]] bool busy() const { return !pending_.empty(); }
  /// `method` is an index of the methods handed to the constructor.
  [[nodiscard]] bool has(std::size_t method) const { return ready() && found_[method].has_value(); }
  /// `done` is called exactly once, but for a service that ends before. A method that is not there
  /// fails at once.
  void call(std::size_t method, QiBytes arguments, Done done);

  /// Why it is not ready; empty when it is, and until the first attempt has failed.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  enum class Stage : std::uint8_t { lost, asking_directory, asking_service, ready };
  struct Pending {
    std::uint32_t id = 0;
    std::string_view returns;
    std::int64_t deadline_us = 0;
    Done done;
  };

  void connect(const Endpoint& to, Stage stage);
  void lose(const std::string& why);
  void request(std::uint32_t service, std::uint32_t action, std::string_view returns,
               QiBytes arguments, Done done);
  void take(const QiMessage& message);
  void expire();
  void fail(std::string_view step, const QiResult& result);

  void authenticate();
  void on_authenticated(const QiResult& result);
  void on_known();
  void on_place(const QiResult& result);
  void on_methods(const QiResult& result);

  QiRobot robot_;
  std::string name_;
  std::span<const QiMethod> methods_;
  std::vector<std::optional<QiFoundMethod>> found_;
  QiConnection connection_;
  Endpoint connected_to_;
  Stage stage_ = Stage::lost;
  std::uint32_t service_ = 0;
  std::uint32_t last_id_ = 0;
  std::vector<Pending> pending_;
  std::int64_t now_us_ = 0, heard_us_ = 0, next_attempt_us_ = 0, back_off_us_;
  std::string fault_;
};

}  // namespace gazed
