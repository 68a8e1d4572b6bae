#include "drivers/sim/other_camera.hpp"

#include <Eigen/Core>

#include "agent/base/text.hpp"

namespace gazed::sim {

std::string other_camera(const geometry::CameraModel& simulated, const geometry::Rig& configured) {
  constexpr double sigmas = 5.0;
  // Where no sigma is configured: within it no point is off by more than a hundredth.
  constexpr double least_share = 0.01;
  const geometry::CameraModel& camera = configured.camera;
  const auto differs = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double sigma_px) {
    return !((a - b).lpNorm<Eigen::Infinity>() <=
             sigmas * sigma_px + least_share * simulated.focal_px.maxCoeff());
  };
  if (!differs(simulated.focal_px, camera.focal_px, configured.uncertainty.focal_sigma_px) &&
      !differs(simulated.centre_px, camera.centre_px, configured.uncertainty.centre_sigma_px)) {
    return {};
  }
  return base::text(
      "the simulated camera has a focal length of (%.1f, %.1f) px and its centre at (%.1f, %.1f) "
      "px, "
      "configured are (%.1f, %.1f) and (%.1f, %.1f): as with another robot's calibration, points "
      "will be wrong. [robot] focal_px and centre_px of a scene change the simulated camera",
      simulated.focal_px.x(), simulated.focal_px.y(), simulated.centre_px.x(),
      simulated.centre_px.y(), camera.focal_px.x(), camera.focal_px.y(), camera.centre_px.x(),
      camera.centre_px.y());
}

}  // namespace gazed::sim
