#include "drivers/naoqi/service.hpp"

#include <algorithm>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::naoqi {

namespace {

constexpr std::int64_t answer_due_us = 1'000'000;
constexpr std::int64_t first_back_off_us = 100'000;
constexpr std::int64_t longest_back_off_us = 500'000;
// Also bounds, with a back-off, how long it takes to find a robot that is back after dropping
// packets.
constexpr std::int64_t authenticated_due_us = 500'000;

constexpr std::uint32_t server = 0, directory = 1, main_object = 1;  // the same on every robot

/// {sm}: the capabilities of this end of the connection, and its user.
QiWriter capabilities(const QiRobot& robot) {
  const bool known = !robot.login.user.empty() || !robot.login.token.empty();
  QiWriter map;
  map.u32(known ? 3 : 1).text("ClientServerSocket").text("b").integer(1, 1);
  if (known)
    map.text("auth_user").dynamic(robot.login.user).text("auth_token").dynamic(robot.login.token);
  return map;
}

constexpr const char* authentication_advice = "; naoqi.user and naoqi.token are what it asks for";

}  // namespace

bool authentication_is_done(const QiValue& answer) {
  constexpr double done = 3.0;  // an "I" of libqi 4, an "i" of libqi 2.5
  QiReader entries = answer.elements();
  while (const auto key = entries.next().text()) {
    const QiValue value = entries.next();
    if (key == "__qi_auth_state") return value.number() == done;
  }
  return false;
}

QiFailure failure_in(std::string_view error) {
  // The text of NAOqi 2.1: "can't find service, address: {0.0.8 ..."
  const bool no_such_service = error.find("find service") != std::string_view::npos;
  return no_such_service ? QiFailure::no_such_service : QiFailure::other;
}

std::optional<base::Endpoint> address_in(const QiValue& service, const base::Endpoint& reached) {
  constexpr std::string_view tcp = "tcp://";
  std::optional<base::Endpoint> best;
  QiReader urls = service.element(4).elements();
  while (const auto url = urls.next().text()) {
    if (!url->starts_with(tcp)) continue;
    const auto place = base::parse_endpoint(url->substr(tcp.size()), reached.port);
    // Another computer's 127.0.0.1 is not ours.
    if (!place || (place->is_this_computer() && !reached.is_this_computer())) continue;
    if (!best || place->address == reached.address) best = place;
  }
  return best;
}

std::optional<QiFunction> find_method(const QiValue& meta_object, const QiMethod& method) {
  QiReader entries = meta_object.element(0).elements();
  while (entries.next()) {  // the number is repeated
    QiReader info = entries.next().elements();
    const QiFunction found{info.u32(), std::string(info.text())};
    if (info.text() == method.name && info.text() == method.parameters) return found;
  }
  return std::nullopt;
}

QiService::QiService(WakeUp& wake_up, QiRobot robot, std::string name,
                     std::span<const QiMethod> methods)
    : wake_up_(wake_up), robot_(std::move(robot)), name_(std::move(name)), methods_(methods) {}

bool QiService::serve(std::int64_t now_us) {
  now_us_ = now_us;
  if (!connection_ && now_us_ < next_attempt_us_) return false;
  if (!connection_) connect(robot_.directory, [this] { find_service(); });
  const auto message = connection_->receive();
  if (connection_->heard()) heard_us_ = now_us_;
  if (message) take(*message);
  // Not in a call that took a message: its data is valid until the next call.
  if (!message && !connection_->problem().empty()) lose(connection_->problem());
  expire();
  return message.has_value();
}

std::int64_t QiService::due_us() const {
  if (!connection_) return next_attempt_us_;
  return pending_.empty() ? now_us_ + answer_due_us : pending_.front().deadline_us;
}

void QiService::call(std::size_t method, QiBytes arguments, Done done) {
  if (!has(method)) return done({{}, "no such method"});
  request(service_, *found_[method], arguments, std::move(done));
}

void QiService::request(std::uint32_t service, const QiFunction& call, QiBytes arguments,
                        Done done) {
  const std::int64_t due_us = service == server ? authenticated_due_us : answer_due_us;
  pending_.push_back({++last_id_, call.returns, now_us_ + due_us, std::move(done)});
  const std::uint32_t object = service == server ? 0 : main_object;
  const QiHeader header{
      .id = last_id_, .service = service, .object = object, .action = call.action};
  connection_->send(header, arguments);
}

void QiService::take(const QiMessage& message) {
  const bool failed = message.header.type == QiType::error;
  if (message.header.type != QiType::reply && !failed) return;
  const auto call = std::ranges::find(pending_, message.header.id, &Pending::id);
  if (call == pending_.end()) return;  // it came too late
  const bool dynamic = failed || (message.header.flags & qi_dynamic_payload) != 0;
  const QiValue value = QiReader(message.payload, dynamic ? "m" : call->returns).next();
  if (failed) {
    const std::string_view error = value.text().value_or("an error without a text");
    return finish(call, {{}, error, failure_in(error)});
  }
  finish(call, {value, value ? "" : "an answer that is not what it should be"});
}

void QiService::expire() {
  // Handle answers that arrived while the loop was busy before declaring a timeout.
  while (!pending_.empty() && pending_.front().deadline_us <= now_us_ && !connection_->has_more()) {
    const bool silent = now_us_ - heard_us_ >= answer_due_us;
    if (silent) return lose(base::text("no answer for %.1f s", 1e-6 * answer_due_us));
    finish(pending_.begin(), {{}, "no answer in time", QiFailure::no_answer});
  }
}

void QiService::finish(std::vector<Pending>::iterator call, const QiResult& result) {
  const Done done = std::move(call->done);
  pending_.erase(call);
  done(result);  // may call again
}

void QiService::lose(const std::string& why) {
  if (!connection_) return;
  fault_ = name_ + " at " + base::to_string(connected_to_) + ": " + why;
  connection_.reset();
  ready_ = false;
  back_off_us_ = std::clamp(2 * back_off_us_, first_back_off_us, longest_back_off_us);
  next_attempt_us_ = now_us_ + back_off_us_;
  for (const Pending& call : std::exchange(pending_, {}))
    call.done({{}, fault_, QiFailure::no_answer});
}

void QiService::connect(const base::Endpoint& to, const std::function<void()>& then) {
  connected_to_ = to;
  connection_.emplace(wake_up_, to);
  request(server, qi_authenticate, capabilities(robot_).bytes(), [=, this](const QiResult& result) {
    if (connection_ &&
        result.failure == QiFailure::no_such_service) {  // NAOqi 2.1 has no service 0
      connection_->send({.id = ++last_id_, .type = QiType::capability}, capabilities({}).bytes());
    } else if (!result.value) {
      return lose("authentication: " + base::excerpt(result.error) + authentication_advice);
    } else if (!authentication_is_done(result.value)) {
      return lose(std::string("authentication: refused") + authentication_advice);
    }
    then();
  });
}

void QiService::find_service() {
  request(directory, qi_service, QiWriter().text(name_).bytes(), [this](const QiResult& result) {
    if (!result.value) return lose("directory: " + base::excerpt(result.error));
    const auto place = address_in(result.value, connected_to_);
    if (!place) return lose("directory: lists no address that can be reached from here");
    service_ = QiReader(result.value.element(1).bytes).u32();
    if (*place == connected_to_) return find_methods();
    connect(*place, [this] { find_methods(); });
  });
}

void QiService::find_methods() {
  request(service_, qi_methods, QiWriter().u32(main_object).bytes(), [this](const QiResult& list) {
    if (!list.value) return lose("methods: " + base::excerpt(list.error));
    found_.clear();
    for (const QiMethod& method : methods_) {
      found_.push_back(find_method(list.value, method));
      if (method.required && !found_.back())
        return lose("no method " + std::string(method.name) + std::string(method.parameters));
    }
    ready_ = true;
    back_off_us_ = 0;
    fault_.clear();
  });
}

}  // namespace gazed::naoqi
