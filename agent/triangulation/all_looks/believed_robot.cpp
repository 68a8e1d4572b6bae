#include "agent/triangulation/all_looks/believed_robot.hpp"

namespace gazed::triangulation::all_looks {

BelievedRobot believed_before(const geometry::Rig& rig) {
  const geometry::Uncertainty& sigmas = rig.uncertainty;
  BelievedRobot out;
  out.camera = rig.camera;
  out.head = rig.head;
  out.focal_sigma_px = sigmas.focal_sigma_px;
  out.centre_sigma_px.setConstant(sigmas.centre_sigma_px);
  out.distortion_sigma = {sigmas.distortion_sigma[0], sigmas.distortion_sigma[1]};
  out.mount_rotation_sigma_rad.setConstant(sigmas.mount_rotation_sigma_rad);
  out.mount_offset_sigma_m.setConstant(sigmas.mount_offset_sigma_m);
  out.zero_sigma_rad.setConstant(sigmas.zero_sigma_rad);
  return out;
}

}  // namespace gazed::triangulation::all_looks
