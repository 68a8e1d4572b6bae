#include "tests/lola_robot/robot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <poll.h>
#include <stdexcept>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>
#include <variant>

namespace lola_robot {

namespace {

constexpr std::array<std::string_view, 17> fault_names{
    "eof",      "down", "stall", "deaf",  "hold_back", "pieces", "cut_short", "too_long", "garbage",
    "stranger", "nan",  "limp",  "stuck", "hot",       "pushed", "fallen",    "blank"};

constexpr double pi = 3.14159265358979323846;
constexpr double encoder_step = 2.0 * pi / 4096.0;  // 12 bits
constexpr double time_constant_s = 0.03;
constexpr double push_rad = 0.3;
constexpr double head_speed_rad_s[] = {8.26797, 7.19407};
constexpr double head_min_rad[] = {-2.0857, -0.6720}, head_max_rad[] = {2.0857, 0.5149};

// Standing, as a game's stand has it; arms hanging.
constexpr Joints standing{0.0F,  0.0F,  1.5F,  0.1F, 0.0F, -0.1F, 0.0F, 0.0F,  0.0F,
                          -0.4F, 0.9F,  -0.5F, 0.0F, 0.0F, -0.4F, 0.9F, -0.5F, 0.0F,
                          1.5F,  -0.1F, 0.0F,  0.1F, 0.0F, 0.0F,  0.0F};

}  // namespace

std::optional<Fault> fault_of(const std::string& name) {
  const auto* const found = std::find(fault_names.begin(), fault_names.end(), name);
  if (found == fault_names.end()) return std::nullopt;
  return static_cast<Fault>(found - fault_names.begin());
}

Robot::Robot(std::string path, bool shuffled) : path_(std::move(path)), shuffled_(shuffled) {
  sensors_.position = standing;
  sensors_.stiffness.fill(0.8F);
  sensors_.stiffness[yaw] = sensors_.stiffness[pitch] = 0.0F;
  sensors_.temperature.fill(38.0F);
  std::copy(standing.begin(), standing.end(), angle_.begin());
  listen();
}

Robot::~Robot() {
  close_all();
}

void Robot::listen() {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) throw std::runtime_error(path_ + ": too long");
  path_.copy(address.sun_path, path_.size());
  ::unlink(path_.c_str());
  listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0 ||
      ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener_, 1) != 0)
    throw std::runtime_error(path_ + ": " + std::strerror(errno));
}

void Robot::end_connection() {
  if (client_ >= 0) ::close(client_);
  client_ = -1;
  ignores_ = false;
  incoming_.clear();
  outgoing_.clear();
}

void Robot::close_all() {
  end_connection();
  if (listener_ >= 0) ::close(listener_);
  listener_ = -1;
  ::unlink(path_.c_str());
}

bool Robot::suffers(Fault fault) const {
  const auto found = left_.find(fault);
  return found != left_.end() && found->second > 0;
}

void Robot::suffer(Fault fault, int cycles) {
  left_[fault] = cycles;
  if (fault == Fault::eof) end_connection();
  if (fault == Fault::down) close_all();
  if (fault == Fault::pushed) push_from_ = angle_[yaw];
}

void Robot::bend(std::size_t joint, double angle_rad) {
  angle_[joint] = angle_rad;
  if (order_) order_->position[joint] = static_cast<float>(angle_rad);
}

void Robot::loosen(std::size_t joint) {
  sensors_.stiffness[joint] = 0.0F;
  if (order_) order_->stiffness[joint] = 0.0F;
}

void Robot::cycle() {
  if (listener_ < 0 && !suffers(Fault::down)) listen();
  if (listener_ >= 0) take_connection();
  if (!suffers(Fault::stall)) {
    if (!suffers(Fault::deaf)) read_orders();
    move();
    measure();
    send(state());
  }
  for (auto& [fault, cycles] : left_) cycles = std::max(0, cycles - 1);
}

void Robot::wait(std::chrono::nanoseconds at_most) {
  const bool hears = !suffers(Fault::stall) && !suffers(Fault::deaf);
  pollfd client{hears ? client_ : -1, POLLIN, 0};
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
  const timespec timeout{static_cast<std::time_t>(seconds.count()),
                         static_cast<long>((at_most - seconds).count())};
  if (::ppoll(&client, 1, &timeout, nullptr) > 0) read_orders();
}

void Robot::take_connection() {
  if (client_ >= 0) return;
  client_ = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (client_ < 0) return;
  ++counts_.connections;
  // Linux's usual 208 KiB, which it makes of half of that: 90 states or so.
  constexpr int buffer_bytes = 106'496;
  ::setsockopt(client_, SOL_SOCKET, SO_SNDBUF, &buffer_bytes, sizeof buffer_bytes);
}

void Robot::read_orders() {
  std::array<char, 4096> buffer;
  ssize_t bytes = 0;
  while (client_ >= 0 && (bytes = ::recv(client_, buffer.data(), buffer.size(), 0)) > 0)
    incoming_.append(buffer.data(), static_cast<std::size_t>(bytes));
  const bool gone = client_ >= 0 && (bytes == 0 || errno != EAGAIN);
  while (incoming_.size() >= order_bytes) {
    const auto order = read_order(std::string_view(incoming_).substr(0, order_bytes));
    incoming_.erase(0, order_bytes);
    if (const auto* problem = std::get_if<std::string>(&order)) {
      crash_ = *problem;
    } else {
      obey(std::get<Order>(order));
    }
  }
  if (gone) end_connection();
}

void Robot::obey(const Order& order) {
  ++counts_.orders;
  order_ = order;
  if (on_order) on_order(order, sensors_);
}

/// First order, limited in speed and range; a joint without stiffness stays where it is.
void Robot::move() {
  for (std::size_t i = 0; order_ && i < joints; ++i) {
    sensors_.stiffness[i] = order_->stiffness[i];
    if (!(sensors_.stiffness[i] > 0.0F)) continue;
    const double way = static_cast<double>(order_->position[i]) - angle_[i];
    double step = way * (1.0 - std::exp(-cycle_s / time_constant_s));
    if (i <= pitch) {
      const double most = head_speed_rad_s[i] * cycle_s;
      step = std::clamp(step, -most, most);
    }
    const bool blocked =
        (i <= pitch && suffers(Fault::limp)) || (i == yaw && suffers(Fault::stuck));
    if (!blocked) angle_[i] += step;
    if (i <= pitch) angle_[i] = std::clamp(angle_[i], head_min_rad[i], head_max_rad[i]);
  }
  if (suffers(Fault::pushed)) angle_[yaw] = push_from_ + push_rad;
}

void Robot::measure() {
  for (std::size_t i = 0; i < joints; ++i) {
    sensors_.position[i] = static_cast<float>(encoder_step * std::round(angle_[i] / encoder_step));
    sensors_.current[i] = sensors_.stiffness[i] > 0.0F ? 0.05F : 0.0F;
  }
  if (suffers(Fault::nan)) sensors_.position[yaw] = NAN;
  if (suffers(Fault::limp)) {
    for (const std::size_t i : {yaw, pitch}) sensors_.stiffness[i] = sensors_.current[i] = 0.0F;
  }
  sensors_.temperature[pitch] = suffers(Fault::hot) ? 85.0F : 38.0F;
  sensors_.status[pitch] = suffers(Fault::hot) ? 1 : 0;
  sensors_.torso[1] = suffers(Fault::fallen) ? 1.4F : 0.02F;
}

std::string Robot::state() {
  const Sensors said = suffers(Fault::blank) ? Sensors{} : sensors_;
  std::string packet = state_packet(said, shuffled_ ? &random_ : nullptr);
  if (suffers(Fault::cut_short)) packet.resize(packet.size() - 100);
  if (suffers(Fault::too_long)) packet.append(50, '\0');
  if (suffers(Fault::garbage)) {
    for (char& byte : packet) byte = static_cast<char>(random_());
  }
  if (suffers(Fault::stranger)) packet = "\xc5\x03\x7d" + std::string(packet.size() - 3, 'x');
  return packet;
}

void Robot::send(const std::string& bytes) {
  if (client_ < 0 || ignores_) return;
  ++counts_.states;
  outgoing_ += bytes;
  if (suffers(Fault::hold_back)) return;
  std::size_t now = outgoing_.size();
  if (suffers(Fault::pieces)) now = std::min<std::size_t>(now, 1 + random_() % 600);
  const ssize_t sent = ::send(client_, outgoing_.data(), now, MSG_NOSIGNAL);
  if (sent > 0) outgoing_.erase(0, static_cast<std::size_t>(sent));
  if (sent < 0 && errno == EAGAIN) ignores_ = true;
  if (sent < 0 && errno != EAGAIN) end_connection();
}

}  // namespace lola_robot
