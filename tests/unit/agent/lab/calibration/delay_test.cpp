// Delay and readout of a simulated camera, from what a moving head records.
#include "agent/lab/calibration/delay.hpp"

#include <cstdio>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/settings/settings.hpp"

#include "scratch.hpp"
#include "simulated_looks.hpp"

namespace gazed::lab::calibration::delay_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string room(double delay_s, double readout_s) {
  return "[camera]\nfps = 15.0\nblur_sigma_px = 0.5\npixel_noise = 1.0\ndelay_s = " +
         std::to_string(delay_s) + "\nreadout_s = " + std::to_string(readout_s) + R"(
[joints]
encoder_step_rad = 0.00153
encoder_noise_rad = 0.0005
[[plane]]
centre_m = [1.5, 0.0, 0.2]
size_m = [8.0, 6.0]
texture = { pattern = "natural", colour = [150, 140, 130], contrast = 45.0, tile_m = 1.5 }
)";
}

const std::vector<geometry::HeadAngles>& looking_about() {
  static const std::vector<geometry::HeadAngles> targets = grid_of_looks(4, 0.5, 3, 0.25, 0.0);
  return targets;
}

TEST(CameraDelay, ComesBackFromAMovingHead) {
  const ScratchFolder folder;
  const settings::Settings robot = settings::default_settings();
  constexpr double delay_s = -0.03, readout_s = 0.025;
  write_simulated_log(room(delay_s, readout_s), looking_about(), folder / "walk.lcm");
  const DelayEstimate found =
      estimate_delay(folder / "walk.lcm", "GAZED", robot.rig.camera, robot.rig.head);
  std::printf("delay %.2f +- %.2f ms, readout %.2f +- %.2f ms, %zu pairs\n", 1e3 * found.delay_s,
              1e3 * found.delay_sigma_s, 1e3 * found.readout_s, 1e3 * found.readout_sigma_s,
              found.pairs);
  EXPECT_NEAR(found.delay_s, delay_s, 3.0 * found.delay_sigma_s);
  EXPECT_NEAR(found.readout_s, readout_s, 3.0 * found.readout_sigma_s);
  EXPECT_LT(found.delay_sigma_s, 0.003);
  EXPECT_LT(found.readout_sigma_s, 0.006);
}

TEST(CameraDelay, HeadThatRestsTellsNothing) {
  const ScratchFolder folder;
  const settings::Settings robot = settings::default_settings();
  const std::vector<geometry::HeadAngles> rest(3);
  write_simulated_log(room(0.0, 0.0), rest, folder / "rest.lcm");
  EXPECT_THAT(
      [&] {
        static_cast<void>(
            estimate_delay(folder / "rest.lcm", "GAZED", robot.rig.camera, robot.rig.head));
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("Record while the head looks about")));
}

}  // namespace
}  // namespace gazed::lab::calibration::delay_test
