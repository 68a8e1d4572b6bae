#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "agent/triangulation/estimate.hpp"

#include "estimates.hpp"
#include "random.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::triangulation::invalid_input_test {
namespace {

TEST(InvalidInput, NanAndInfinityInEachInput) {
  using Change = std::function<void(Fixture&, double)>;
  const std::vector<std::pair<std::string, Change>> changes{
      {"pixel_1.x", [](Fixture& f, double v) { f.looks.pixel_1.x() = v; }},
      {"pixel_1.y", [](Fixture& f, double v) { f.looks.pixel_1.y() = v; }},
      {"pixel_2.x", [](Fixture& f, double v) { f.looks.pixel_2.x() = v; }},
      {"pixel_2.y", [](Fixture& f, double v) { f.looks.pixel_2.y() = v; }},
      {"covariance xx", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(0, 0) = v; }},
      {"covariance xy", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(0, 1) = v; }},
      {"covariance yx", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(1, 0) = v; }},
      {"covariance yy", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(1, 1) = v; }},
      {"yaw 1", [](Fixture& f, double v) { f.looks.head_1.yaw_rad = v; }},
      {"pitch 1", [](Fixture& f, double v) { f.looks.head_1.pitch_rad = v; }},
      {"yaw 2", [](Fixture& f, double v) { f.looks.head_2.yaw_rad = v; }},
      {"pitch 2", [](Fixture& f, double v) { f.looks.head_2.pitch_rad = v; }},
      {"zero", [](Fixture& f, double v) { f.rig.head.zero.pitch_rad = v; }},
      {"neck", [](Fixture& f, double v) { f.rig.head.neck_offset_m.z() = v; }},
      {"mount offset", [](Fixture& f, double v) { f.rig.head.mount_offset_m.x() = v; }},
      {"mount rotation", [](Fixture& f, double v) { f.rig.head.mount_rotation_rad.z() = v; }},
      {"focal", [](Fixture& f, double v) { f.rig.camera.focal_px.y() = v; }},
      {"centre", [](Fixture& f, double v) { f.rig.camera.centre_px.x() = v; }},
      {"distortion", [](Fixture& f, double v) { f.rig.camera.distortion[1] = v; }},
      {"pixel sigma", [](Fixture& f, double v) { f.rig.uncertainty.pixel_sigma_px = v; }},
      {"encoder sigma", [](Fixture& f, double v) { f.rig.uncertainty.encoder_sigma_rad = v; }},
      {"zero sigma", [](Fixture& f, double v) { f.rig.uncertainty.zero_sigma_rad = v; }},
      {"focal sigma", [](Fixture& f, double v) { f.rig.uncertainty.focal_sigma_px = v; }},
      {"centre sigma", [](Fixture& f, double v) { f.rig.uncertainty.centre_sigma_px = v; }},
      {"offset sigma", [](Fixture& f, double v) { f.rig.uncertainty.mount_offset_sigma_m = v; }},
      {"rotation sigma",
       [](Fixture& f, double v) { f.rig.uncertainty.mount_rotation_sigma_rad = v; }},
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [input, change] : changes) {
    for (const double value : {not_a_number, infinity, -infinity}) {
      SCOPED_TRACE(input + " = " + std::to_string(value));
      ASSERT_EQ(Fixture().estimate().status, Status::located);  // a point that must not come back
      Fixture fixture;
      change(fixture, value);
      const PointEstimate out = fixture.estimate();
      EXPECT_EQ(out.status, Status::invalid_input) << out.reason;
      expect_filled(out, Filled::nothing);
      EXPECT_TRUE(out.torso_point_m.array().isNaN().all());
    }
  }
}

TEST(InvalidInput, ACornerSlipThatWouldMakeCornersBetterThanTheyAre) {
  for (const double slip : {0.99, 0.0, -1.0, not_a_number}) {
    Fixture fixture;
    fixture.rig.uncertainty.corner_slip = slip;
    EXPECT_EQ(fixture.estimate().status, Status::invalid_input) << slip;
  }
}

TEST(InvalidInput, AnImagePointThatNoLensCanSee) {
  // At a focal length of some 550 px: 4e5 px are beyond 89.9 degrees, 2e4 px are not.
  for (const methods::Method method : methods::all_methods) {
    for (const double far_px : {4e5, 1e6, 1e20, 1e200}) {
      for (geometry::Pixel TwoLooks::*pixel : {&TwoLooks::pixel_1, &TwoLooks::pixel_2}) {
        Fixture fixture;
        fixture.rig.camera.distortion = {};
        fixture.looks.*pixel = {far_px, 240.0};
        const PointEstimate out = estimate_point(fixture.rig, fixture.looks, fixture.gate, method);
        EXPECT_EQ(out.status, Status::invalid_input) << methods::name(method) << " " << far_px;
        expect_filled(out, Filled::nothing);
      }
    }
  }
  Fixture within;
  within.rig.camera.distortion = {};
  within.looks.pixel_1 = {2e4, 240.0};
  EXPECT_NE(within.estimate().status, Status::invalid_input);
}

TEST(InvalidInput, APriorThatIsNone) {
  const Fixture f;
  const auto with = [&f](const methods::Prior& prior, methods::Method method) {
    return estimate_point(f.rig, f.looks, f.gate, method, prior).status;
  };
  methods::Prior nan_mean, zero_sigma, negative_sigma;
  nan_mean.mean_m.z() = not_a_number;
  zero_sigma.sigma_m.x() = 0.0;
  negative_sigma.sigma_m.y() = -0.1;
  for (const methods::Prior& prior : {nan_mean, zero_sigma, negative_sigma}) {
    EXPECT_EQ(with(prior, methods::Method::linear_mmse), Status::invalid_input);
    EXPECT_EQ(with(prior, methods::Method::optimal), Status::located) << "it asks for no prior";
  }
}

TEST(InvalidInput, NanInTheGate) {
  for (double Gate::*limit :
       {&Gate::relative_sigma_max, &Gate::epipolar_chi2_max, &Gate::baseline_sigmas}) {
    Fixture fixture;
    fixture.gate.*limit = not_a_number;
    EXPECT_EQ(fixture.estimate().status, Status::invalid_input);
  }
}

TEST(InvalidInput, ACameraWithoutAFocalLength) {
  Fixture fixture;
  fixture.rig.camera.focal_px.setZero();
  EXPECT_EQ(fixture.estimate().status, Status::invalid_input);
}

TEST(InvalidInput, ANegativeSigmaOrACovarianceThatIsNone) {
  Fixture negative;
  negative.rig.uncertainty.encoder_sigma_rad = -1e-3;
  EXPECT_EQ(negative.estimate().status, Status::invalid_input);
  Fixture indefinite;
  indefinite.looks.pixel_2_covariance_px2 << 1.0, 2.0, 2.0, 1.0;
  EXPECT_EQ(indefinite.estimate().status, Status::invalid_input);
}

TEST(InvalidInput, AnyNumbersWhatsoeverGetAnAnswer) {
  Random random(77);
  const auto wild = [&random] {
    const double magnitude = std::pow(10.0, random.uniform(-320.0, 308.0));
    return random.uniform() < 0.5 ? magnitude : -magnitude;
  };
  for (int i = 0; i < test::trials(20'000, 4'000); ++i) {
    Fixture fixture;
    TwoLooks& looks = fixture.looks;
    for (double* value : {&looks.pixel_1.x(), &looks.pixel_1.y(), &looks.pixel_2.x(),
                          &looks.pixel_2.y(), &looks.head_1.yaw_rad, &looks.head_1.pitch_rad,
                          &looks.head_2.yaw_rad, &looks.head_2.pitch_rad}) {
      if (random.uniform() < 0.3) *value = wild();
    }
    const methods::Method method =
        methods::all_methods[static_cast<std::size_t>(i) % methods::all_methods.size()];
    const PointEstimate out = estimate_point(fixture.rig, looks, fixture.gate, method);
    EXPECT_FALSE(out.reason.empty());
    if (out.status == Status::located) {
      EXPECT_TRUE(out.torso_point_m.allFinite() && out.torso_covariance_m2.allFinite());
      EXPECT_GT(out.range_m, 0.0);
    }
  }
}

}  // namespace
}  // namespace gazed::triangulation::invalid_input_test
