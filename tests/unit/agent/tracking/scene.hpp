// A small exact renderer for the registration's tests: one flat object before a wall, seen by the
// camera of a head that turns.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "agent/base/random.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/view.hpp"

namespace gazed::tracking {

using Colour = Eigen::Vector3d;  // r, g, b, 0 to 255

/// Distances in camera 1's optical frame, metres.
struct Scene {
  geometry::CameraModel camera;
  geometry::HeadGeometry head;
  geometry::HeadAngles head_1;                         // true angles of look 1
  geometry::Pixel object_px = {320.0, 240.0};          // where look 1 sees the object's centre
  double range_m = 0.3;                                // of the object's centre
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();  // of the object's plane about x and y
  double half_size_m = 0.03;
  bool round = true;  // a disc, else a square
  bool ball = false;  // a ball of that radius; `paint` is seen from its front
  /// Of a ball: how much of its light falls on it from the lamp alone, and the mirrored lamp's
  /// brightness, grey levels, which follows the half-way vector's cosine to that power (Blinn
  /// 1977).
  double shading = 0.0, gloss_levels = 0.0;
  int shininess = 50;
  Eigen::Vector3d to_lamp = {-0.5, -0.6, -0.6};  // far away, camera 1's axes
  std::function<Colour(double u_m, double v_m)> paint = [](double, double) {
    return Colour(200, 30, 30);
  };
  Colour wall_colour = {200, 200, 200};
  std::function<Colour(double u_m, double v_m)> wall;  // instead, where there is one
  double wall_behind_m = 0.0;  // wall's plane behind the object's, along its normal
  bool present = true;         // false: only the wall
};

struct Capture {
  double noise_levels = 0.0;
  double gain = 1.0;
  double bias_levels = 0.0;
  base::PixelFormat format = base::PixelFormat::rgb24;
};

/// An image that owns its pixels, with the view of it.
struct Shot {
  base::Image image;
  geometry::HeadAngles head;
  [[nodiscard]] geometry::View view() const { return {image.view(), head, 0}; }
};

/// A colour in 1/256 of a level: what is done to every pixel is done in whole numbers, which an
/// emulated CPU takes a tenth of the time for.
using FixedColour = std::array<std::int32_t, 3>;

/// What falls on the sensor: one colour per pixel, row by row.
struct Radiance {
  int width_px = 0;
  int height_px = 0;
  geometry::HeadAngles head;
  std::vector<FixedColour> pixels;
};

/// What the camera sees with the head at `head`: every pixel the mean of 8 x 8 rays, or of its
/// corners where those hardly differ.
[[nodiscard]] Radiance look(const Scene& scene, geometry::HeadAngles head);

/// What the camera makes of it.
[[nodiscard]] Shot expose(const Radiance& radiance, const Capture& capture, base::Random& random);

/// Where look 2 sees the point of the object's plane that look 1 sees at `pixel_1`.
[[nodiscard]] geometry::Pixel true_pixel_2(const Scene& scene, geometry::HeadAngles head_2,
                                           const geometry::Pixel& pixel_1);

/// True when the ray of `pixel_1` meets the object.
[[nodiscard]] bool on_object(const Scene& scene, const geometry::Pixel& pixel_1);

/// Standard normal numbers in 1/1024 for a row of pixels. Drawing one for every channel of every
/// pixel would take most of the tests' time: a row takes them in turn from a long table, from a
/// random place on.
class NormalRow {
 public:
  static constexpr double one = 1024.0;

  explicit NormalRow(base::Random& random) : at_(random.bits() % table_size) {}
  [[nodiscard]] std::int32_t next() { return table_[at_++ % table_size]; }

 private:
  static constexpr std::size_t table_size = 1 << 15;
  static const std::vector<std::int32_t>& table();

  const std::vector<std::int32_t>& table_ = table();
  std::size_t at_;
};

/// A texture without repetition: random cells of `cell_m`, smoothly interpolated; about 0 to 1.
[[nodiscard]] double value_noise(double u_m, double v_m, double cell_m, std::uint64_t seed);

}  // namespace gazed::tracking
