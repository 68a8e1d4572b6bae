#include "drivers/naoqi/service.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "agent/text.hpp"

namespace gazed {

namespace {

constexpr std::int64_t answer_due_us = 1'000'000;
constexpr std::int64_t first_back_off_us = 100'000;
constexpr std::int64_t longest_back_off_us = 500'000;
// Whoever comes back is found within this and a back-off, also when packets to it were dropped.
constexpr std::int64_t authenticated_due_us = 500'000;

// Numbers and signatures that are the same on every robot (QiLoop, about-qimessaging.md).
constexpr std::uint32_t server = 0, directory = 1, main_object = 1;
constexpr std::uint32_t authenticate_action = 8, service_action = 100, methods_action = 2;
constexpr std::string_view whole_answer = "r";  // as one: taken apart by hand

/// {sm}: what this end of the connection can do, and who it is.
void write_capabilities(QiWriter& writer, const QiRobot& robot) {
  const bool known = !robot.user.empty() || !robot.token.empty();
  writer.u32(known ? 3 : 1).text("ClientServerSocket").text("b").integer(1, 1);
  if (!known) return;
  write_dynamic(writer.text("auth_user"), robot.user);
  write_dynamic(writer.text("auth_token"), robot.token);
}

}  // namespace

QiService::QiService(WakeUp& wake_up, QiRobot robot, std::string name,
                     std::span<const QiMethod> methods)
    : robot_(std::move(robot)),
      name_(std::move(name)),
      methods_(methods),
      found_(methods.size()),
      connection_(wake_up),
      back_off_us_(first_back_off_us) {}

void QiService::serve(std::int64_t now_us) {
  now_us_ = now_us;
  if (stage_ == Stage::lost) {
    if (now_us_ < next_attempt_us_) return;
    connect(robot_.directory, Stage::asking_directory);
  }
  if (connection_.exchange()) heard_us_ = now_us_;
  while (const auto message = connection_.next()) take(*message);
  expire();
  if (const std::string problem = connection_.problem(); !problem.empty()) lose(problem);
}

std::int64_t QiService::due_us() const {
  if (stage_ == Stage::lost) return next_attempt_us_;
  std::int64_t due_us = now_us_ + answer_due_us;
  for (const Pending& call : pending_) due_us = std::min(due_us, call.deadline_us);
  return due_us;
}

void QiService::connect(const Endpoint& to, Stage stage) {
  stage_ = stage;
  connected_to_ = to;
  heard_us_ = now_us_;
  connection_.open(to);
  authenticate();
}

void QiService::lose(const std::string& why) {
  if (stage_ == Stage::lost) return;
  stage_ = Stage::lost;
  fault_ = name_ + " at " + to_string(connected_to_) + ": " + why;
  connection_.close();
  next_attempt_us_ = now_us_ + back_off_us_;
  back_off_us_ = std::min(2 * back_off_us_, longest_back_off_us);
  for (const Pending& call : std::exchange(pending_, {})) call.done({std::nullopt, fault_});
}

void QiService::call(std::size_t method, QiBytes arguments, Done done) {
  if (!has(method)) {
    done({std::nullopt, "no such method"});
    return;
  }
  const QiFoundMethod& found = *found_[method];
  request(service_, found.action, found.returns, arguments, std::move(done));
}

void QiService::request(std::uint32_t service, std::uint32_t action, std::string_view returns,
                        QiBytes arguments, Done done) {
  if (pending_.empty()) heard_us_ = now_us_;
  const std::int64_t due_us = service == server ? authenticated_due_us : answer_due_us;
  pending_.push_back({++last_id_, returns, now_us_ + due_us, std::move(done)});
  connection_.send({.id = last_id_,
                    .service = service,
                    .object = service == server ? 0 : main_object,
                    .action = action},
                   arguments);
}

void QiService::take(const QiMessage& message) {
  const QiHeader& header = message.header;
  const bool failed = header.type == QiType::error;
  if (header.type != QiType::reply && !failed) return;
  const auto call = std::ranges::find(pending_, header.id, &Pending::id);
  if (call == pending_.end()) return;  // too late
  const Pending answered = std::move(*call);
  pending_.erase(call);
  const bool dynamic = failed || (header.flags & qi_dynamic_payload) != 0;
  QiReader reader(message.payload);
  std::string_view signature = dynamic ? "m" : answered.returns;
  auto value = signature == whole_answer ? QiValue{whole_answer, message.payload}
                                         : take_value(reader, signature);
  if (failed) {
    const auto text = value ? value->text() : std::nullopt;
    answered.done({std::nullopt, text ? *text : "an error without a text"});
  } else {
    answered.done({value, value ? "" : "an answer that is not what it should be"});
  }
}

void QiService::expire() {
  // Answers that waited in the socket while the loop was away are heard first.
  if (pending_.empty() || pending_.front().deadline_us > now_us_ || connection_.has_more()) return;
  const bool silent = now_us_ - heard_us_ >= answer_due_us;
  if (silent) return lose(text("no answer for %.1f s", 1e-6 * answer_due_us));
  while (!pending_.empty() && pending_.front().deadline_us <= now_us_) {
    const Pending late = std::move(pending_.front());
    pending_.erase(pending_.begin());
    late.done({std::nullopt, "no answer in time"});
  }
}

void QiService::fail(std::string_view step, const QiResult& result) {
  lose(text("%.*s: ", static_cast<int>(step.size()), step.data()) + excerpt(result.error));
}

void QiService::authenticate() {
  QiWriter arguments;
  write_capabilities(arguments, robot_);
  request(server, authenticate_action, "{sm}", arguments.bytes(),
          [this](const QiResult& result) { on_authenticated(result); });
}

void QiService::on_authenticated(const QiResult& result) {
  // NAOqi 2.1 has no service 0, and says so: "can't find service, address: {0.0.8 ..."
  if (!result.value && result.error.find("find service") != std::string_view::npos) {
    QiWriter capabilities;
    write_capabilities(capabilities, {});
    connection_.send({.id = ++last_id_, .type = QiType::capability}, capabilities.bytes());
    return on_known();
  }
  if (!result.value) return fail("authentication", result);
  if (authentication_is_done(*result.value)) return on_known();
  lose("authentication: refused; naoqi.user and naoqi.token are what it asks for");
}

void QiService::on_known() {
  QiWriter argument;
  if (stage_ == Stage::asking_directory) {
    argument.text(name_);
    return request(directory, service_action, qi_service_info, argument.bytes(),
                   [this](const QiResult& result) { on_place(result); });
  }
  argument.u32(main_object);
  request(service_, methods_action, whole_answer, argument.bytes(),
          [this](const QiResult& result) { on_methods(result); });
}

void QiService::on_place(const QiResult& result) {
  if (!result.value) return fail("directory", result);
  const auto place = place_in(*result.value, connected_to_);
  if (const auto* why = std::get_if<std::string>(&place)) return lose("directory: " + *why);
  const auto& [service, endpoint] = std::get<QiPlace>(place);
  service_ = service;
  if (endpoint != connected_to_) return connect(endpoint, Stage::asking_service);
  stage_ = Stage::asking_service;
  on_known();
}

void QiService::on_methods(const QiResult& result) {
  if (!result.value) return fail("methods", result);
  found_.assign(methods_.size(), {});
  if (!find_methods(result.value->bytes, methods_, found_)) return lose("methods: not understood");
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    const auto& [name, parameters, required] = methods_[i];
    if (required && !found_[i])
      return lose("no method " + std::string(name) + std::string(parameters));
  }
  stage_ = Stage::ready;
  back_off_us_ = first_back_off_us;
  fault_.clear();
}

}  // namespace gazed
