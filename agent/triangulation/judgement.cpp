#include "agent/triangulation/judgement.hpp"

#include "agent/base/text.hpp"

namespace gazed::triangulation {

namespace {

/// Fills in the position and everything that follows from it.
void fill_position(const geometry::InverseDepthPoint& point, const Propagated& propagated,
                   const std::optional<geometry::Pose>& torso_from_cam1, PointEstimate& out) {
  out.point_m = point.point_m();
  out.covariance_m2 = propagated.covariance_m2;
  if (torso_from_cam1) {
    out.torso_point_m = *torso_from_cam1 * out.point_m;
    out.torso_covariance_m2 = propagated.torso_covariance_m2;
  }
  out.range_m = 1.0 / out.inverse_range_per_m;
  out.range_sigma_m = out.range_m * out.range_m * out.inverse_range_sigma_per_m;
}

}  // namespace

void judge_sigma(const geometry::InverseDepthPoint& point, const Propagated& propagated,
                 const std::optional<geometry::Pose>& torso_from_cam1, const Gate& gate,
                 PointEstimate& out) {
  const double sigma = out.inverse_range_sigma_per_m;
  if (out.inverse_range_per_m <= sigma) {
    out.status = Status::uncertain;
    out.reason = base::text("inverse range %.3f +- %.3f 1/m: may be at infinity",
                            out.inverse_range_per_m, sigma);
    return;
  }
  fill_position(point, propagated, torso_from_cam1, out);
  const double relative_sigma = sigma / out.inverse_range_per_m;
  const bool passed = relative_sigma <= gate.relative_sigma_max;
  out.status = passed ? Status::located : Status::uncertain;
  out.reason =
      base::text("relative sigma %.1f %% is %s the gate of %.3g %%", 100.0 * relative_sigma,
                 passed ? "within" : "over", 100.0 * gate.relative_sigma_max);
}

}  // namespace gazed::triangulation
