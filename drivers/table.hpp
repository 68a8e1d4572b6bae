// The table of drivers: what can be said after --camera and --head, and what is known of each
// driver without linking it. Beside it, in agent/daemon/factories.cpp, stands how each is made.
//
// Vocabulary. A source is what a configuration names: a driver and what it opens,
// "v4l2:/dev/video2". A part is what the source is for.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace gazed::drivers {

enum class Part : std::uint8_t { camera, head };

/// Where a driver's events come from.
enum class Origin : std::uint8_t {
  device,      // of the robot, live
  lcm,         // of another program, live: what came over LCM is not sent there once more
  simulation,  // scheduled; its camera is the scene's, not the robot's
  recording    // scheduled; nothing in it can be told to move
};

/// What stands after the driver's name and a colon.
struct Argument {
  enum class Need : std::uint8_t { none, optional, required } need = Need::none;
  /// Never asked about an empty one, which is none. Null: every other text will do.
  bool (*accepts)(std::string_view argument) = nullptr;
};

struct DriverRow {
  std::string_view name;
  std::string_view forms;  // the sources that name it, in words: "v4l2, v4l2:DEVICE"
  bool has_camera = false;
  bool has_head = false;
  Origin origin = Origin::device;
  Argument argument{};
  bool exclusive = false;  // what it opens is for one gazed at a time

  [[nodiscard]] bool has(Part part) const { return part == Part::camera ? has_camera : has_head; }
};

/// All drivers, in the order in which they are listed.
[[nodiscard]] std::span<const DriverRow> all_drivers();
/// "sim, lcm, log:FILE, ...": the sources of a part.
[[nodiscard]] std::string allowed_sources(Part part);

/// One that exists; of camera and head the simulator's, until it is set.
class Source {
 public:
  Source() : Source(all_drivers().front(), std::string(all_drivers().front().name)) {}

  /// None for a text that names no driver of that part, or not as the driver's row wants it.
  [[nodiscard]] static std::optional<Source> parse(Part part, std::string_view text);

  [[nodiscard]] const DriverRow& driver() const { return *driver_; }
  [[nodiscard]] bool is(Origin origin) const { return driver_->origin == origin; }
  /// As it was written: "log:walk.lcm".
  [[nodiscard]] const std::string& text() const { return text_; }
  /// "walk.lcm"; empty when there is none.
  [[nodiscard]] std::string argument() const;

 private:
  Source(const DriverRow& driver, std::string text) : driver_(&driver), text_(std::move(text)) {}

  const DriverRow* driver_;
  std::string text_;
};

}  // namespace gazed::drivers
