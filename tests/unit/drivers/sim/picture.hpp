// Help for tests that look at rendered pictures.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"
#include "drivers/sim/render.hpp"
#include "drivers/sim/world.hpp"

namespace gazed::sim::testing {

/// A rendered picture before noise, in grey levels.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> rgb;

  [[nodiscard]] float at(int x, int y, int channel = 0) const {
    return rgb[static_cast<std::size_t>((y * width_px + x) * 3 + channel)];
  }
};

[[nodiscard]] Picture render(const World& world, const geometry::CameraModel& camera,
                             const geometry::Pose& cam_from_torso);

/// A picture whose grey levels are the columns' numbers.
[[nodiscard]] std::shared_ptr<const MipMap> ramp(int width, int height);

/// What one pixel sees of a map, `channels` values.
[[nodiscard]] std::array<float, 3> look_up(const MipMap& map, double x, double y, float footprint);

/// Centre of gravity of what differs from `background` in channel 0.
[[nodiscard]] geometry::Pixel centroid(const Picture& picture, float background);

/// Between x0 and x1 of row y, where channel 0 passes `level`, between two pixels linearly.
[[nodiscard]] double crossing(const Picture& picture, int y, int x0, int x1, float level);

/// 160 x 120 px, a wide lens.
[[nodiscard]] geometry::CameraModel small_camera(bool distorted);

/// A surface that faces the torso's origin from straight ahead, of one colour.
[[nodiscard]] Surface facing_surface(Shape shape, double ahead_m, double left_m, double up_m,
                                     double width_m, double height_m, double grey);

/// Turned about its own vertical and horizontal axes.
[[nodiscard]] Surface tilted(Surface surface, double about_vertical_rad,
                             double about_horizontal_rad);

/// Of these surfaces, before this grey.
constexpr double dark = 50.0;
[[nodiscard]] World world_of(std::vector<Surface> surfaces);

/// The camera at the torso's origin, looking ahead, then turned.
[[nodiscard]] geometry::Pose looking(double yaw_rad, double pitch_rad);

/// A file that is gone at the end of the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& contents);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace gazed::sim::testing
