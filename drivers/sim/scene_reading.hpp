// How a scene file's tables are read, table by table: parse_scene() alone uses it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "agent/base/strict_toml.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed::sim::reading {

inline constexpr base::Range grey_levels{0.0, 255.0};

template <class T, class Value>
void take(T& member, const std::optional<Value>& value) {
  if (value) member = static_cast<T>(*value);
}

inline void take(Eigen::Vector3d& member, const std::optional<std::array<double, 3>>& value) {
  if (value) member = Eigen::Vector3d((*value)[0], (*value)[1], (*value)[2]);
}

template <class Enum, std::size_t size>
void take_choice(Enum& member, base::StrictTable& table, std::string_view key,
                 const std::array<std::string_view, size>& names) {
  if (const std::optional<std::size_t> index = table.choice(key, names))
    member = static_cast<Enum>(*index);
}

// Tables that are not there change nothing.

void read_robot(std::optional<base::StrictTable> table, RobotTruth& robot);
void read_joints(std::optional<base::StrictTable> table, JointBehaviour& joints);
void read_sway(std::optional<base::StrictTable> table, Sway& sway);
void read_camera(std::optional<base::StrictTable> table, CameraBehaviour& camera);
void read_uncertainty(std::optional<base::StrictTable> table,
                      geometry::UncertaintyOverride& uncertainty);

// Textures are looked for in `directory`.

void read_whole_appearance(std::optional<base::StrictTable> table, Appearance& appearance,
                           const std::string& directory);
/// [[plane]] or [[target]], as `key` says.
void read_planes(base::StrictTable& root, std::string_view key, bool target, Scene& scene,
                 const std::string& directory);
void read_report_tests(base::StrictTable& root, const Appearance& object, Scene& scene,
                       const std::string& directory);
void read_target_tests(base::StrictTable& root, const Appearance& object, Scene& scene,
                       const std::string& directory);

}  // namespace gazed::sim::reading
