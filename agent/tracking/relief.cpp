#include "agent/tracking/relief.hpp"

#include <Eigen/LU>

namespace gazed::tracking {

Relief::Relief(const ObjectMask& object, double focal_px) : inside_(1.0) {
  const ObjectMask::Moments moments = object.moments();
  // Across an ellipse's half axis the variance of its area is a quarter of that axis squared.
  const Eigen::Matrix2d axes_px2 = 4.0 * moments.covariance_px2;
  centre_px_ = moments.centroid_px;
  inverse_ = axes_px2.inverse();
  radius_rad_ = std::sin(std::atan(std::sqrt(std::sqrt(axes_px2.determinant())) / focal_px));
}

}  // namespace gazed::tracking
