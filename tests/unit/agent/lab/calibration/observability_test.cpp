// Directions that pictures do not tell are found in the information, whatever they are.
#include "agent/lab/calibration/observability.hpp"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <vector>

namespace gazed::lab::calibration::observability_test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Every parameter free with sigma 1, but for the distortion.
Prior unit_prior() {
  Prior prior;
  prior.mean.setConstant(1.0);
  prior.sigma.setOnes();
  prior.sigma.segment<5>(distortion_at).setZero();
  return prior;
}

/// Much of everything, nothing along `direction` (of the free parameters).
Eigen::MatrixXd information_without(const Prior& prior, const Parameters& direction) {
  const std::vector<int> free = prior.free_indices();
  Eigen::VectorXd unit(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    unit[static_cast<Eigen::Index>(i)] = direction[free[i]];
  }
  unit.normalize();
  constexpr double much = 1e4;
  return much * (Eigen::MatrixXd::Identity(unit.size(), unit.size()) - unit * unit.transpose());
}

TEST(Observability, NothingUnknown) {
  const Prior prior = unit_prior();
  const auto free = static_cast<Eigen::Index>(prior.free_indices().size());
  const Certainty certainty =
      certainty_of(99.0 * Eigen::MatrixXd::Identity(free, free), prior, prior.mean);
  EXPECT_THAT(certainty.weak, SizeIs(0));
  EXPECT_NEAR(certainty.sigma[focal_at], 0.1, 1e-12);  // 99 from the data, 1 from the prior
  EXPECT_EQ(certainty.sigma[distortion_at], 0.0);      // held
}

TEST(Observability, YawZero) {
  const Prior prior = unit_prior();
  Parameters direction = Parameters::Zero();
  direction[zero_at] = 1.0;
  const Certainty certainty =
      certainty_of(information_without(prior, direction), prior, prior.mean);
  ASSERT_THAT(certainty.weak, SizeIs(1));
  EXPECT_THAT(certainty.weak[0].name, HasSubstr("yaw zero"));
  EXPECT_NEAR(certainty.weak[0].data_share, 0.0, 1e-9);
  EXPECT_NEAR(certainty.sigma[zero_at], 1.0, 1e-9);  // the prior's
}

TEST(Observability, LengthOfTheArm) {
  const Prior prior = unit_prior();
  Parameters direction = Parameters::Zero();
  direction.segment<3>(mount_offset_at) = prior.mean.segment<3>(mount_offset_at);
  direction.segment<3>(axis_offset_at) = prior.mean.segment<3>(axis_offset_at);
  const Certainty certainty =
      certainty_of(information_without(prior, direction), prior, prior.mean);
  ASSERT_THAT(certainty.weak, SizeIs(1));
  EXPECT_THAT(certainty.weak[0].name, HasSubstr("the arm's length"));
}

TEST(Observability, MixtureWithoutANameIsSpelledOut) {
  const Prior prior = unit_prior();
  Parameters direction = Parameters::Zero();
  direction[centre_at + 1] = 1.0;
  direction[mount_rotation_at] = 1.0;
  const Certainty certainty =
      certainty_of(information_without(prior, direction), prior, prior.mean);
  ASSERT_THAT(certainty.weak, SizeIs(1));
  EXPECT_THAT(certainty.weak[0].name, HasSubstr("camera.centre_px y"));
  EXPECT_THAT(certainty.weak[0].name, HasSubstr("camera.mount_rotation_rad roll"));
}

TEST(Observability, SeveralAtOnceAreToldApart) {
  const Prior prior = unit_prior();
  Parameters yaw = Parameters::Zero(), roll = Parameters::Zero();
  yaw[zero_at] = 1.0;
  roll[mount_rotation_at] = 1.0;
  // Each takes its own direction out of the same whole.
  const auto size = static_cast<Eigen::Index>(prior.free_indices().size());
  const Eigen::MatrixXd information = information_without(prior, yaw) +
                                      information_without(prior, roll) -
                                      1e4 * Eigen::MatrixXd::Identity(size, size);
  const Certainty certainty = certainty_of(information, prior, prior.mean);
  ASSERT_THAT(certainty.weak, SizeIs(2));
  EXPECT_THAT(certainty.weak[0].name + certainty.weak[1].name, HasSubstr("yaw zero"));
  EXPECT_THAT(certainty.weak[0].name + certainty.weak[1].name,
              HasSubstr("camera.mount_rotation_rad roll"));
}

}  // namespace
}  // namespace gazed::lab::calibration::observability_test
