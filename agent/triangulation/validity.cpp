#include "agent/triangulation/validity.hpp"

#include <Eigen/LU>
#include <cmath>

#include "agent/base/text.hpp"

namespace gazed::triangulation {

namespace {

bool is_covariance(const Eigen::Matrix2d& m) {
  constexpr double rounding = 1e-9;
  const double product = m(0, 0) * m(1, 1);
  return m.allFinite() && m(0, 0) >= 0.0 && m(1, 1) >= 0.0 &&
         std::abs(m(0, 1) - m(1, 0)) <= rounding * std::sqrt(product) &&
         m(0, 1) * m(0, 1) <= product * (1.0 + rounding);
}

std::optional<std::string> what_is_invalid(const ImagePoint& point, const char* view) {
  if (!point.normalised.allFinite() || !point.distorted.allFinite()) {
    return base::text("image point %s (%g, %g) is not finite", view, point.normalised.x(),
                      point.normalised.y());
  }
  if (point.normalised.norm() > off_axis_max || point.distorted.norm() > off_axis_max) {
    return base::text("image point %s (%g, %g) is over 89.9 degrees off the optical axis", view,
                      point.normalised.x(), point.normalised.y());
  }
  if (!point.pixel_jacobian.allFinite() || point.pixel_jacobian.determinant() == 0.0) {
    return base::text("the camera model cannot be inverted at image point %s", view);
  }
  if (!is_covariance(point.covariance_px2)) {
    return base::text("the pixel covariance of view %s is none: [%g %g; %g %g] px^2", view,
                      point.covariance_px2(0, 0), point.covariance_px2(0, 1),
                      point.covariance_px2(1, 0), point.covariance_px2(1, 1));
  }
  return std::nullopt;
}

bool all_finite(const geometry::Pose& pose) {
  return pose.rotation.allFinite() && pose.translation.allFinite();
}

bool all_finite(const PoseChange& change) {
  return change.rotation_rad.allFinite() && change.translation_m.allFinite();
}

}  // namespace

std::optional<std::string> what_is_invalid(const TwoViews& views, const ErrorSources& errors,
                                           const Gate& gate) {
  if (auto reason = what_is_invalid(views.point_1, "1")) return reason;
  if (auto reason = what_is_invalid(views.point_2, "2")) return reason;
  if (!all_finite(views.cam2_from_cam1) ||
      (views.torso_from_cam1 && !all_finite(*views.torso_from_cam1))) {
    return "a camera pose is not finite";
  }
  for (const ErrorSource& source : errors.all()) {
    if (!source.normalised_1.allFinite() || !source.normalised_2.allFinite() ||
        !all_finite(source.cam2_from_cam1) || !all_finite(source.torso_from_cam1)) {
      return "the size of an error source is not finite";
    }
  }
  if (std::isnan(gate.relative_sigma_max) || std::isnan(gate.epipolar_chi2_max) ||
      std::isnan(gate.baseline_sigmas)) {
    return "a limit of the gate is not a number";
  }
  return std::nullopt;
}

std::optional<std::string> what_is_invalid(const methods::Prior& prior) {
  const Eigen::Vector3d &mean = prior.mean_m, &sigma = prior.sigma_m;
  if (mean.allFinite() && sigma.allFinite() && (sigma.array() > 0.0).all()) return std::nullopt;
  return base::text("the prior is none: mean (%g, %g, %g) m, sigma (%g, %g, %g) m", mean.x(),
                    mean.y(), mean.z(), sigma.x(), sigma.y(), sigma.z());
}

std::optional<std::string> what_is_invalid(const geometry::Uncertainty& u) {
  for (const double sigma :
       {u.pixel_sigma_px, u.encoder_sigma_rad, u.zero_sigma_rad, u.focal_sigma_px,
        u.centre_sigma_px, u.distortion_sigma[0], u.distortion_sigma[1], u.mount_offset_sigma_m,
        u.mount_rotation_sigma_rad, u.torso_rotation_sigma_rad, u.torso_translation_sigma_m}) {
    if (sigma < 0.0) return base::text("a sigma is negative: %g", sigma);
  }
  if (!(u.corner_slip >= 1.0)) return base::text("corner_slip %g is less than 1", u.corner_slip);
  return std::nullopt;
}

}  // namespace gazed::triangulation
