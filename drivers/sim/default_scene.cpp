#include <string_view>

#include "drivers/sim/scene.hpp"

namespace gazed::sim {

std::string_view default_scene_toml() {
  return R"toml(# The set-up of the report's tests 1 and 2: a red object taped to a white wall, 0.30 m away, in the
# centre and in a corner of the first image. The robot is a calibrated one.
repeat = true

[joints]
settling_error_rad = 0.02   # a command ends up to so far off
encoder_step_rad = 0.00153  # 12 bit: 2 pi / 4096
encoder_noise_rad = 0.0005

[camera]
pixel_noise = 2.0           # grey levels
blur_sigma_px = 0.5

[uncertainty]               # of a calibrated robot: what the agent is told
focal_sigma_px = 0.5
centre_sigma_px = 1.0
distortion_sigma = [0.003, 0.01]
mount_offset_sigma_m = 0.001
mount_rotation_sigma_rad = 0.003
zero_sigma_rad = 0.003

[wall]                      # white plaster, the light from the upper left
size_m = [4.0, 3.0]
texture = { pattern = "natural", colour = [226, 224, 219], contrast = 2.5, tile_m = 0.5, gradient = [-0.25, -0.2], vignette = 0.1 }

[object]                    # a printed disc
shape = "disc"
size_m = [0.06, 0.06]
texture = { pattern = "natural", colour = [196, 26, 30], contrast = 2.0, tile_m = 0.1, seed = 2 }
mark = "ring"
mark_colour = [128, 10, 16]

[[report_test]]
number = 1
range_m = 0.30

[[report_test]]
number = 2
range_m = 0.30
)toml";
}

}  // namespace gazed::sim
