// A furnished room with depth, as the simulated camera sees it, for the background's tests.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "agent/geometry/view.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/world.hpp"

namespace gazed::sim {
class Renderer;
}

namespace gazed::tracking {

enum class Paint { natural, checker, blank };

/// What a picture is taken with.
struct Exposure {
  double noise_levels = 2.0;
  double exposure = 1.0;
  base::PixelFormat format = base::PixelFormat::rgb24;
  std::uint64_t seed = 1;
};

/// A picture with the angles that the encoders say.
struct Photo {
  base::Image image;
  geometry::HeadAngles measured;
  [[nodiscard]] geometry::View view() const { return {image.view(), measured, 0}; }
};

class RoomScene {
 public:
  geometry::RobotProfile robot;  // its camera stays: the renderer was made for it
  sim::World world;

  /// Walls ahead, left and right, a table, boxes at 0.4 to 1.4 m, and in the middle, last of the
  /// surfaces, a red object at 0.4 m. `distortion` is the camera's.
  explicit RoomScene(Paint paint, std::uint32_t seed = 1, std::array<double, 5> distortion = {});
  /// A plain white wall before the robot and the object.
  [[nodiscard]] static RoomScene blank_wall();

  /// The head stands at `true_angles`, the encoders say `measured`.
  [[nodiscard]] Photo photo(geometry::HeadAngles true_angles, geometry::HeadAngles measured,
                            const Exposure& exposure = {}) const;

  /// Where a later look sees what look 1 sees at `pixel_1`; none when that is hidden or less than
  /// `border_px` inside the frame.
  [[nodiscard]] std::optional<geometry::Pixel> true_pixel(geometry::HeadAngles angles_1,
                                                          geometry::HeadAngles angles_2,
                                                          const geometry::Pixel& pixel_1,
                                                          double border_px) const;

  /// Where a later look sees a point on look 1's ray of `pixel_1` that is as far as what look 1
  /// sees at `neighbour`: a patch across a depth edge holds two depths.
  [[nodiscard]] std::optional<geometry::Pixel> seen_at_depth_of(
      geometry::HeadAngles angles_1, geometry::HeadAngles angles_2, const geometry::Pixel& pixel_1,
      const geometry::Pixel& neighbour) const;

  void move_object(const Eigen::Vector3d& by_m) { world.surfaces.back().centre_m += by_m; }
  [[nodiscard]] geometry::Pixel object_px(geometry::HeadAngles angles) const;

 private:
  // Kept from photo to photo: the noise of the textures takes longer to make than a picture. Copies
  // share it: each photo gives it its world anew.
  std::shared_ptr<sim::Renderer> renderer_;
};

}  // namespace gazed::tracking
