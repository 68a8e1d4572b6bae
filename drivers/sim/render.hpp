// The simulated camera's picture of a world: textured surfaces and balls in true perspective,
// through the lens's distortion, one pose for each row (a rolling shutter).
//
// A pixel is the mean over its square: edges by their exact area, textures by filtered look-ups,
// where the pixel meets the surface to within 0.003 of itself.
// Nearer surfaces hide farther ones pixel by pixel. Where several edges share a pixel, each covers
// what the nearer ones left of it, so that surfaces that meet at an edge join without a gap. Where
// two surfaces pass through each other the line between them is not smoothed: let them end there.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"
#include "drivers/sim/light.hpp"
#include "drivers/sim/placed_surface.hpp"
#include "drivers/sim/world.hpp"

namespace gazed::sim {

class Renderer {
 public:
  static constexpr std::size_t most_surfaces = 256;

  /// Throws std::invalid_argument when the distortion cannot be undone somewhere in the image.
  explicit Renderer(const geometry::CameraModel& camera);

  /// Prepares a world's textures; allocates. At most most_surfaces surfaces.
  void set_world(const World& world);

  /// The pose for the rows that follow, and when they are exposed, after the test's start.
  void set_pose(const geometry::Pose& cam_from_torso, double time_s = 0.0);
  /// One row, width x (r, g, b). Allocates nothing.
  void render_row(int y, std::span<Light> rgb);

 private:
  /// The columns of row y, from first to one past the last, where a surface may be seen.
  [[nodiscard]] std::pair<int, int> columns(const PlacedSurface& surface, int y) const;
  void render_run(int y, int x_begin, int x_end, std::span<const std::uint8_t> candidates,
                  std::span<Light> rgb);
  /// Pixels that see a single surface, from x_begin on.
  void paint_block(int y, int x_begin, const OnlySurface& only, std::span<Light> rgb) const;
  [[nodiscard]] Ray ray_with_steps(int x, int y) const;
  [[nodiscard]] Eigen::Vector2f ray(int x, int y) const {
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    if (!columns_.empty()) return {columns_[column], rows_[row]};
    return rays_[row * static_cast<std::size_t>(camera_.width_px) + column];
  }

  geometry::CameraModel camera_;
  // Normalised coordinates: x of each column and y of each row, or, where a distortion bends
  // columns and rows, both of every pixel, which takes 2.5 MB at 640x480.
  std::vector<float> columns_, rows_;
  std::vector<Eigen::Vector2f> rays_;
  std::vector<PlacedSurface> surfaces_;
  std::vector<PixelLayer> layers_;  // of the pixel at hand, room for all surfaces
  std::array<Light, 3> background_{};
  std::vector<std::pair<std::pair<Pattern, std::uint32_t>, std::shared_ptr<const MipMap>>> tiles_;
};

}  // namespace gazed::sim
