// The table of drivers: the values of --camera and --head, and what is known of each driver without
// linking it. How each is constructed is in agent/daemon/factories.cpp.
//
// Vocabulary. A source is what a configuration names: a driver and what it opens, such as
// "v4l2:/dev/video2". A part is what the source is used for.
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
  lcm,         // another program, live; what came over LCM is not published again
  simulation,  // scheduled; its camera is the scene's, not the robot's
  recording    // scheduled; nothing in it can be commanded
};

/// The text after the driver's name and a colon.
struct Argument {
  enum class Need : std::uint8_t { none, optional, required } need = Need::none;
  /// Never called with an empty argument, which counts as none. Null: accepts any other.
  bool (*accepts)(std::string_view argument) = nullptr;
};

struct DriverRow {
  std::string_view name;
  std::string_view forms;  // in words, the sources that name this driver: "v4l2, v4l2:DEVICE"
  bool has_camera = false;
  bool has_head = false;
  Origin origin = Origin::device;
  Argument argument{};
  bool exclusive = false;  // only one gazed at a time may use what it opens

  [[nodiscard]] bool has(Part part) const { return part == Part::camera ? has_camera : has_head; }
};

/// All drivers, in the order in which they are listed to the user.
[[nodiscard]] std::span<const DriverRow> all_drivers();
/// The sources of a part: "sim, lcm, log:FILE, ...".
[[nodiscard]] std::string allowed_sources(Part part);

/// A valid source; by default the simulator.
class Source {
 public:
  Source() : Source(all_drivers().front(), std::string(all_drivers().front().name)) {}

  /// None if the text does not name a driver of that part, or its argument is invalid.
  [[nodiscard]] static std::optional<Source> parse(Part part, std::string_view text);

  [[nodiscard]] const DriverRow& driver() const { return *driver_; }
  [[nodiscard]] bool is(Origin origin) const { return driver_->origin == origin; }
  /// As written: "log:walk.lcm".
  [[nodiscard]] const std::string& text() const { return text_; }
  /// "walk.lcm"; empty if there is no argument.
  [[nodiscard]] std::string argument() const;

 private:
  Source(const DriverRow& driver, std::string text) : driver_(&driver), text_(std::move(text)) {}

  const DriverRow* driver_;
  std::string text_;
};

}  // namespace gazed::drivers
