#include "agent/triangulation/two_view.hpp"

#include <Eigen/LU>

namespace gazed::triangulation {

std::string_view name(Status status) {
  switch (status) {
    case Status::located:
      return "LOCATED";
    case Status::target_lost:
      return "TARGET_LOST";
    case Status::degenerate:
      return "DEGENERATE";
    case Status::behind_camera:
      return "BEHIND_CAMERA";
    case Status::uncertain:
      return "UNCERTAIN";
    case Status::invalid_input:
      break;
  }
  return "INVALID_INPUT";
}

std::optional<ImagePoint> image_point(const geometry::CameraModel& camera,
                                      const geometry::Pixel& pixel,
                                      const Eigen::Matrix2d& covariance_px2) {
  const std::optional<Eigen::Vector2d> normalised = geometry::normalise(camera, pixel);
  if (!normalised) return std::nullopt;
  return ImagePoint{.normalised = *normalised,
                    .distorted = (pixel - camera.centre_px).cwiseQuotient(camera.focal_px),
                    .pixel_jacobian = geometry::pixel_jacobian(camera, *normalised),
                    .covariance_px2 = covariance_px2};
}

Eigen::Matrix2d normalised_covariance(const ImagePoint& point) {
  const Eigen::Matrix2d to_normalised = point.pixel_jacobian.inverse();
  return to_normalised * point.covariance_px2 * to_normalised.transpose();
}

}  // namespace gazed::triangulation
