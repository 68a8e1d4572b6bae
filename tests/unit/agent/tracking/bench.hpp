// The objects, moves and the robot that the registration's tests share.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "agent/geometry/robot.hpp"
#include "agent/tracking/registration.hpp"

#include "scene.hpp"

namespace gazed::tracking {

enum class Object { disc, square, two_colours, textured, small };
inline constexpr std::array all_objects = {Object::disc, Object::square, Object::two_colours,
                                           Object::textured, Object::small};

inline std::string name(Object object) {
  constexpr std::array names = {"disc", "square", "two colours", "textured", "small"};
  return names[static_cast<std::size_t>(object)];
}

/// The step rule's smallest move, and two larger ones.
inline constexpr std::array moves = {geometry::HeadAngles{0.1, 0.1},
                                     geometry::HeadAngles{-0.3, 0.15},
                                     geometry::HeadAngles{0.45, -0.2}};

/// The saliency winner is good to a map cell, 16 px.
inline const geometry::Pixel winner_error(9.0, -7.0);

/// Boards of random colours, side by side, as they are seen at range_m: 67 px wide, 27 px high.
inline std::function<Colour(double u_m, double v_m)> boards(double range_m, std::uint64_t seed) {
  return [=](double u_m, double v_m) {
    const double row = std::floor(v_m / (0.045 * range_m));
    const double column = std::floor(u_m / (0.11 * range_m) + 0.3 * row);
    const auto channel = [&](std::uint64_t number) {
      return 60.0 + 150.0 * value_noise(column, row, 1.0, seed + number);
    };
    return Colour(channel(0), channel(1), channel(2));
  };
}

struct Bench {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  base::Random random{1};

  /// An object of about half_size_px in look 1, seen in the middle between the two looks' centres.
  [[nodiscard]] Scene scene(Object object, double half_size_px, double range_m,
                            geometry::HeadAngles move) const {
    Scene scene;
    scene.camera = rig.camera;
    scene.head = rig.head;
    const double f = rig.camera.focal_px.mean();
    scene.object_px = rig.camera.centre_px +
                      0.5 * f * geometry::Pixel(-move.yaw_rad, move.pitch_rad) +
                      geometry::Pixel(0.3, 0.6);
    scene.range_m = range_m;
    const double size = scene.half_size_m = half_size_px / f * range_m;
    scene.round = object == Object::disc || object == Object::small;
    if (object == Object::two_colours) {
      scene.paint = [size](double u, double v) {
        return u + v > 0.3 * size ? Colour(40, 90, 200) : Colour(220, 200, 30);
      };
    }
    if (object == Object::textured) {
      scene.paint = [size](double u, double v) {
        return Colour(40 + 200 * value_noise(u, v, size / 6, 7),
                      30 + 150 * value_noise(u, v, size / 3, 9), 60);
      };
    }
    return scene;
  }

  [[nodiscard]] Registration registration(const RegistrationSettings& settings = {}) const {
    return {rig, settings};
  }
};

}  // namespace gazed::tracking
