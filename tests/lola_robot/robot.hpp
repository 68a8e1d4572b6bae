// A V6 behind LoLA's socket, cycle by cycle: what it measures, how its joints follow, and
// everything that can go wrong with it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "tests/lola_robot/encoding.hpp"

namespace lola_robot {

inline constexpr double cycle_s = 0.012;

/// The faults, by the names that the program's command line has for them. Those that last do so for
/// a number of cycles.
enum class Fault {
  eof,        // ends the connection; takes the next one
  down,       // lasts: no connection, no socket
  stall,      // lasts: sends nothing, reads nothing
  deaf,       // lasts: reads no orders
  hold_back,  // lasts: what it would have sent comes at once after it
  pieces,     // lasts: what comes comes in pieces
  cut_short,  // one packet without its last 100 bytes
  too_long,   // one packet with 50 bytes more
  garbage,    // one packet of random bytes
  stranger,   // one packet that is MessagePack of 896 bytes, but no state
  nan,        // lasts: HeadYaw is at NaN
  limp,       // lasts: the head has no stiffness
  stuck,      // lasts: HeadYaw does not move
  hot,        // lasts: HeadPitch is at 85 C
  pushed,     // lasts: somebody holds HeadYaw 0.3 rad beside where it was
  fallen,     // lasts: the torso leans by 1.4 rad
  blank,      // lasts: all numbers are 0
};

/// None for an unknown name.
[[nodiscard]] std::optional<Fault> fault_of(const std::string& name);

class Robot {
 public:
  struct Counts {
    std::int64_t states = 0;       // sent
    std::int64_t orders = 0;       // read
    std::int64_t connections = 0;  // taken
  };

  /// Listens at `path`; throws std::runtime_error when it cannot. `shuffled`: the keys of its
  /// packets come in another order each time.
  explicit Robot(std::string path, bool shuffled = false);
  ~Robot();
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// 12 ms: takes a connection, reads what was ordered, moves, sends its state.
  void cycle();
  /// Between two cycles: reads orders as they come, for at most so long.
  void wait(std::chrono::nanoseconds at_most);
  void suffer(Fault fault, int cycles = 1);
  /// Somebody bends a joint, and it stays there until it is told otherwise.
  void bend(std::size_t joint, double angle_rad);
  /// Somebody takes a joint its stiffness, until it is told otherwise.
  void loosen(std::size_t joint);

  /// Called for every order, with the sensors that the joints had then.
  std::function<void(const Order&, const Sensors&)> on_order;

  [[nodiscard]] const Sensors& sensors() const { return sensors_; }
  /// To set up a robot as it is before gazed starts.
  [[nodiscard]] Sensors& sensors() { return sensors_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Why a real LoLA would have crashed; empty when it lives.
  [[nodiscard]] const std::string& crash() const { return crash_; }

 private:
  [[nodiscard]] bool suffers(Fault fault) const;
  void listen();
  void close_all();
  void take_connection();
  void read_orders();
  void obey(const Order& order);
  void move();
  void measure();
  [[nodiscard]] std::string state();
  void send(const std::string& bytes);
  void end_connection();

  std::string path_;
  bool shuffled_;
  std::mt19937_64 random_{1};
  int listener_ = -1, client_ = -1;
  bool ignores_ = false;  // the client did not read: no more for it
  std::string incoming_, outgoing_;
  std::map<Fault, int> left_;  // cycles
  std::optional<Order> order_;
  std::array<double, joints> angle_{};  // true
  double push_from_ = 0.0;
  Sensors sensors_;
  Counts counts_;
  std::string crash_;
};

}  // namespace lola_robot
