// What the loop asks of any driver, of a camera as of a head.
//
// Vocabulary. A live driver's events come by its descriptor, at the wall clock's times; a scheduled
// one (simulated or recorded) knows when its next event is due. An event is a frame or a head
// state.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gazed::drivers {

enum class HealthKind : std::uint8_t {
  ok,
  lost,       // not there, not to be opened, or gone; the driver goes on trying
  no_data,    // it is there, and nothing comes
  refused,    // what comes cannot be used
  disobeyed,  // the head does not do what it is told
  no_link     // the fault is the LCM connection's, which is reported as such
};

/// How a driver is. Decisions are made by `kind`; the words are for people.
struct Health {
  HealthKind kind = HealthKind::ok;
  std::string words{};       // what is wrong; empty when all is well
  std::int64_t dropped = 0;  // events lost or dropped so far

  [[nodiscard]] bool ok() const { return kind == HealthKind::ok; }
  /// One fault more, unless there are no words for it; the first one decides the kind.
  void add(HealthKind fault, std::string_view why) {
    if (why.empty()) return;
    if (ok()) kind = fault;
    words.append(words.empty() ? "" : "; ").append(why);
  }
};

/// No call blocks, and none throws once the driver is made: what goes wrong shows in health().
class Driver {
 public:
  virtual ~Driver() = default;

  /// Readable when an event may have come; -1 for a scheduled driver.
  [[nodiscard]] virtual int descriptor() const { return -1; }
  /// When a scheduled driver's next event is due, never earlier than the one before; none for a
  /// live one and after the last event.
  [[nodiscard]] virtual std::optional<std::int64_t> next_utime_us() { return std::nullopt; }
  /// True when no event will ever come again (a log or a scene at its end).
  [[nodiscard]] virtual bool finished() const { return false; }

  /// Asked for at every turn of the loop; allocates nothing while all is well.
  [[nodiscard]] virtual Health health() const { return {}; }
  /// Beside its health, asked for at the end: what was passed over so far (a damaged recording), in
  /// words; empty when nothing was.
  [[nodiscard]] virtual std::string notes() const { return {}; }
  /// A message for the person who runs gazed, once; empty when there is nothing new.
  [[nodiscard]] virtual std::string warning() { return {}; }
};

}  // namespace gazed::drivers
