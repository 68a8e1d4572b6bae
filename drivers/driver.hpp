// The interface of all drivers, for cameras and heads.
//
// Vocabulary. An event is a frame or a head state. A live driver signals events through its
// descriptor and stamps them with the wall clock; a scheduled one (simulated or recorded) knows
// when its next event is due.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gazed::drivers {

enum class HealthKind : std::uint8_t {
  ok,
  lost,       // missing, cannot be opened, or gone; the driver keeps trying
  no_data,    // connected, but no data arrives
  refused,    // data arrives but cannot be used
  disobeyed,  // the head does not do what it is told
  no_link     // the LCM connection has the fault, and reports it itself
};

/// The health of a driver. `kind` is for decisions, the words are for people.
struct Health {
  HealthKind kind = HealthKind::ok;
  std::string words{};       // what is wrong; empty when all is well
  std::int64_t dropped = 0;  // events lost or dropped so far

  [[nodiscard]] bool ok() const { return kind == HealthKind::ok; }
  /// Adds a fault, unless its text is empty; the first one determines the kind.
  void add(HealthKind fault, std::string_view why) {
    if (why.empty()) return;
    if (ok()) kind = fault;
    words.append(words.empty() ? "" : "; ").append(why);
  }
};

/// No call blocks, and after construction none throws: errors show in health().
class Driver {
 public:
  virtual ~Driver() = default;

  /// Readable when an event may have arrived; -1 for a scheduled driver.
  [[nodiscard]] virtual int descriptor() const { return -1; }
  /// When a scheduled driver's next event is due, never earlier than the previous one; none for a
  /// live driver and after the last event.
  [[nodiscard]] virtual std::optional<std::int64_t> next_utime_us() { return std::nullopt; }
  /// True if no event will ever come again (end of a log or scene).
  [[nodiscard]] virtual bool finished() const { return false; }

  /// Called in every turn of the loop; allocates nothing while all is well.
  [[nodiscard]] virtual Health health() const { return {}; }
  /// What was skipped so far (such as a damaged part of a recording), in words, for the end of the
  /// run; empty if nothing was.
  [[nodiscard]] virtual std::string notes() const { return {}; }
  /// A message for the user, reported once; empty if there is nothing new.
  [[nodiscard]] virtual std::string warning() { return {}; }
};

}  // namespace gazed::drivers
