#include "agent/settings/doubts.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "agent/settings/table.hpp"
#include "agent/settings/value.hpp"

namespace gazed::settings {

namespace {

struct Usual {
  std::string_view key;
  Range range;
};

// A NAO's own numbers lie well inside (geometry's README); the limits are a choice.
constexpr auto usual = std::to_array<Usual>({
    {"camera.distortion", {-2, 2}},
    {"camera.mount_offset_m", {-0.3, 0.3}},
    {"camera.mount_rotation_rad", {-0.8, 0.8}},  // the bottom cameras' pitch: 0.69
    {"camera.readout_s", {0, 0.2}},
    {"camera.delay_s", {-0.5, 0.5}},
    {"head.neck_offset_m", {-0.5, 0.5}},
    {"head.zero_rad", {-0.2, 0.2}},
    {"head.settle_velocity_rad_s", {0.005, 1}},
    {"head.settle_tolerance_rad", {0.005, 0.2}},
    {"uncertainty.pixel_sigma_px", {0, 10}},
    {"uncertainty.encoder_sigma_rad", {0, 0.1}},
    {"uncertainty.zero_sigma_rad", {0, 0.2}},
    {"uncertainty.mount_offset_sigma_m", {0, 0.05}},
    {"uncertainty.mount_rotation_sigma_rad", {0, 0.2}},
    {"uncertainty.torso_rotation_sigma_rad", {0, 0.3}},
    {"uncertainty.torso_translation_sigma_m", {0, 0.2}},
    {"locate.relative_sigma_max", {0.01, 1}},
});

// Shares of the image's width.
constexpr Range usual_focal{0.3, 5};
constexpr double usual_focal_sigma = 0.1, usual_centre_sigma = 0.1;

bool is_usual(const Value& value, const Range& range) {
  if (const auto* number = std::get_if<double>(&value)) return range.contains(*number);
  const auto& numbers = std::get<std::vector<double>>(value);
  return std::ranges::all_of(numbers, [&](double number) { return range.contains(number); });
}

std::string doubt(const Settings& settings, std::string_view key, const Range& range) {
  return std::string(key) + ": " + toml_text(read(settings, *find_key(key))) +
         " can hardly be meant; usual: " + plain_number(range.min) + " to " +
         plain_number(range.max);
}

}  // namespace

std::vector<std::string> doubts(const Settings& settings) {
  std::vector<std::string> all;
  const auto look_at = [&](std::string_view key, const Range& range) {
    if (!is_usual(read(settings, *find_key(key)), range))
      all.push_back(doubt(settings, key, range));
  };
  for (const Usual& one : usual) look_at(one.key, one.range);
  const double width_px = settings.rig.camera.width_px;
  look_at("camera.focal_px", {usual_focal.min * width_px, usual_focal.max * width_px});
  look_at("uncertainty.focal_sigma_px", {0, usual_focal_sigma * width_px});
  look_at("uncertainty.centre_sigma_px", {0, usual_centre_sigma * width_px});
  return all;
}

}  // namespace gazed::settings
