#include "estimates.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace gazed::triangulation {

void expect_filled(const PointEstimate& estimate, Filled filled) {
  EXPECT_EQ(std::isfinite(estimate.residual_px), filled >= Filled::residual);
  EXPECT_EQ(std::isfinite(estimate.parallax_rad), filled >= Filled::residual);
  EXPECT_EQ(std::isfinite(estimate.inverse_range_per_m), filled >= Filled::inverse_range);
  EXPECT_EQ(std::isfinite(estimate.inverse_range_sigma_per_m), filled >= Filled::inverse_range);
  const bool position = filled >= Filled::position;
  EXPECT_EQ(estimate.point_m.allFinite(), position);
  EXPECT_EQ(estimate.covariance_m2.allFinite(), position);
  EXPECT_EQ(std::isfinite(estimate.range_m), position);
  EXPECT_EQ(std::isfinite(estimate.range_sigma_m), position);
  // All or nothing: no half-filled vector.
  EXPECT_EQ(estimate.point_m.array().isNaN().any(), !position);
  EXPECT_EQ(estimate.covariance_m2.array().isNaN().all(), !position);
  EXPECT_FALSE(estimate.reason.empty());
}

}  // namespace gazed::triangulation
