// lola_robot: a simulated NAO V6 behind LoLA's socket.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "tests/lola_robot/robot.hpp"

namespace {

constexpr const char* help =
    R"(Usage: lola_robot SOCKET [--for SECONDS] [--orders FILE.csv] [--shuffled] [--at SECONDS FAULT [SECONDS]]...

A NAO V6's LoLA at a unix socket: a state of 896 bytes every 12 ms, joints that follow their orders with a time constant of 30 ms, within
their limits and speeds. It stands, stiff but for its head.

  --for SECONDS       ends after so long; without it at SIGINT or SIGTERM
  --orders FILE.csv   every order as it came: seconds, what the head was told and measured, and what the other joints were told at most
                      beside what they had been told first
  --shuffled          the keys of its packets come in another order each time
  --at SECONDS FAULT [SECONDS]
                      so long after the first order; those that last do so for the second number, one cycle without it:
                      eof, cut_short, too_long, garbage, stranger (once);
                      down, stall, deaf, hold_back, pieces, nan, limp, stuck, hot, pushed, fallen, blank (lasting)

Exit: 0, 1 when a real LoLA would have crashed over an order, 2 bad arguments, 3 when it ended before all of the faults had begun.
)";

struct Arguments {
  struct Event {
    double at_s;
    lola_robot::Fault fault;
    int cycles;
  };
  std::string socket, orders;
  double for_s = 0.0;
  bool shuffled = false;
  std::vector<Event> events;
};

int cycles(double seconds) {
  return std::max(1, static_cast<int>(seconds / lola_robot::cycle_s + 0.5));
}

/// False for what is no argument.
bool parse(const std::vector<std::string>& given, Arguments& arguments) {
  const auto number = [&](std::size_t i, double& value) {
    if (i >= given.size()) return false;
    char* end = nullptr;
    value = std::strtod(given[i].c_str(), &end);
    return end != given[i].c_str() && *end == '\0' && value >= 0.0;
  };
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] == "--shuffled") {
      arguments.shuffled = true;
    } else if (given[i] == "--orders" && i + 1 < given.size()) {
      arguments.orders = given[++i];
    } else if (given[i] == "--for") {
      if (!number(++i, arguments.for_s)) return false;
    } else if (given[i] == "--at") {
      double at_s = 0.0, for_s = 0.0;
      if (!number(++i, at_s) || ++i >= given.size()) return false;
      const auto fault = lola_robot::fault_of(given[i]);
      if (!fault) return false;
      if (number(i + 1, for_s)) ++i;
      arguments.events.push_back({at_s, *fault, cycles(for_s)});
    } else if (arguments.socket.empty() && !given[i].starts_with("--")) {
      arguments.socket = given[i];
    } else {
      return false;
    }
  }
  return !arguments.socket.empty();
}

volatile std::sig_atomic_t ended = 0;

/// Every order as a line.
class OrderLog {
 public:
  explicit OrderLog(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {
    if (file_ != nullptr)
      std::fputs(
          "time_s,yaw_rad,pitch_rad,yaw_stiffness,pitch_stiffness,measured_yaw_rad,"
          "measured_pitch_rad,others_moved_rad,others_stiffness\n",
          file_);
  }
  ~OrderLog() {
    if (file_ != nullptr) std::fclose(file_);
  }
  OrderLog(const OrderLog&) = delete;
  OrderLog& operator=(const OrderLog&) = delete;

  void write(double time_s, const lola_robot::Order& order, const lola_robot::Sensors& sensors) {
    if (file_ == nullptr) return;
    if (lines_++ == 0) first_ = order;
    double moved = 0.0, stiffness = 0.0;
    for (std::size_t i = lola_robot::pitch + 1; i < lola_robot::joints; ++i) {
      moved =
          std::max(moved, std::abs(static_cast<double>(order.position[i] - first_.position[i])));
      stiffness = std::max(stiffness, static_cast<double>(order.stiffness[i]));
    }
    const auto number = [](float value) { return static_cast<double>(value); };
    std::fprintf(file_, "%.6f,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", time_s,
                 number(order.position[0]), number(order.position[1]), number(order.stiffness[0]),
                 number(order.stiffness[1]), number(sensors.position[0]),
                 number(sensors.position[1]), moved, stiffness);
    std::fflush(file_);
  }

 private:
  std::FILE* file_;
  std::int64_t lines_ = 0;
  lola_robot::Order first_;
};

int run(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  lola_robot::Robot robot(arguments.socket, arguments.shuffled);
  OrderLog log(arguments.orders);
  std::vector<Arguments::Event> events = arguments.events;
  const Clock::time_point start = Clock::now();
  Clock::time_point first_order{};
  robot.on_order = [&](const auto& order, const auto& sensors) {
    if (first_order == Clock::time_point{}) first_order = Clock::now();
    log.write(seconds_since(start), order, sensors);
  };
  Clock::time_point next = start;
  while (ended == 0 && robot.crash().empty() &&
         (arguments.for_s == 0.0 || seconds_since(start) < arguments.for_s)) {
    std::erase_if(events, [&](const Arguments::Event& event) {
      const bool due =
          first_order != Clock::time_point{} && seconds_since(first_order) >= event.at_s;
      if (due) robot.suffer(event.fault, event.cycles);
      return due;
    });
    robot.cycle();
    next += std::chrono::microseconds(12'000);
    for (auto now = Clock::now(); now < next && ended == 0; now = Clock::now())
      robot.wait(next - now);
  }
  const auto& counts = robot.counts();
  std::printf("%lld states, %lld orders, %lld connections\n", static_cast<long long>(counts.states),
              static_cast<long long>(counts.orders), static_cast<long long>(counts.connections));
  if (!robot.crash().empty()) {
    std::printf("crashed: %s\n", robot.crash().c_str());
    return 1;
  }
  if (events.empty()) return 0;
  std::printf("%zu faults not reached\n", events.size());
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> given(argv + 1, argv + argc);
  if (std::find(given.begin(), given.end(), "--help") != given.end()) {
    std::fputs(help, stdout);
    return 0;
  }
  Arguments arguments;
  if (!parse(given, arguments)) {
    std::fputs(help, stderr);
    return 2;
  }
  const auto end = [](int) { ended = 1; };
  std::signal(SIGINT, end);
  std::signal(SIGTERM, end);
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lola_robot: %s\n", error.what());
    return 2;
  }
}
