// How each driver of the table (drivers/table.hpp) is constructed: one row per driver.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "agent/settings/settings.hpp"
#include "drivers/camera.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/link.hpp"
#include "drivers/sim/sim_robot.hpp"
#include "drivers/table.hpp"

namespace gazed::daemon {

/// What drivers are made from.
struct Ingredients {
  const settings::Settings& settings;
  lcm::LcmLink& link;                  // outlives the drivers
  std::shared_ptr<sim::SimRobot> sim;  // if the camera or the head is simulated
};

struct DriverFactory {
  std::string_view name;  // of its row
  /// Null if the driver has no such part. They throw std::invalid_argument if something cannot be
  /// opened.
  std::unique_ptr<drivers::CameraDriver> (*camera)(const Ingredients& ingredients) = nullptr;
  std::unique_ptr<drivers::HeadDriver> (*head)(const Ingredients& ingredients) = nullptr;
  /// The resource it opens, under a name that is the same for every gazed on this computer. Null if
  /// the driver is not exclusive.
  std::string (*opens)(const settings::Settings& settings, drivers::Part part) = nullptr;
  /// Releases a head that a killed gazed left stiff. Returns why that failed; empty on success.
  /// Null if the driver leaves no motor stiff.
  std::string (*release_head)(const settings::Settings& settings) = nullptr;
};

[[nodiscard]] std::span<const DriverFactory> all_factories();
[[nodiscard]] const DriverFactory& factory_of(const drivers::DriverRow& driver);

}  // namespace gazed::daemon
