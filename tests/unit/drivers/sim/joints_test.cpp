#include "drivers/sim/joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace gazed::sim::joints_test {
namespace {

constexpr geometry::HeadAngles max_speed{8.26797, 7.19407};
constexpr std::int64_t second_us = 1'000'000;

SimJoints make_joints(const JointBehaviour& behaviour, std::uint64_t seed = 1) {
  return {behaviour, max_speed, seed, 0};
}

TEST(JointCourse, BothJointsArriveTogetherWithinTheirLimits) {
  const geometry::HeadAngles from{-0.1, 0.2}, to{0.5, -0.1};
  constexpr geometry::HeadAngles limit{1.0, 0.8};
  constexpr double acceleration = 5.0, dt = 1e-4;
  const JointCourse course(from, to, limit, acceleration);
  geometry::HeadAngles before = course.at(0.0), speed_before;
  EXPECT_EQ(before, from);
  double fastest = 0.0;
  for (double t = dt; t < 2.0; t += dt) {
    const geometry::HeadAngles now = course.at(t);
    const geometry::HeadAngles speed{(now.yaw_rad - before.yaw_rad) / dt,
                                     (now.pitch_rad - before.pitch_rad) / dt};
    ASSERT_LE(std::abs(speed.yaw_rad), limit.yaw_rad + 1e-6);
    ASSERT_LE(std::abs(speed.pitch_rad), limit.pitch_rad + 1e-6);
    ASSERT_LE(std::abs(speed.yaw_rad - speed_before.yaw_rad) / dt, acceleration + 1e-3);
    // On the straight segment: yaw and pitch have gone the same share of their way.
    ASSERT_NEAR((now.yaw_rad - from.yaw_rad) / 0.6, (now.pitch_rad - from.pitch_rad) / -0.3, 1e-9);
    fastest = std::max(fastest, std::abs(speed.yaw_rad));
    before = now;
    speed_before = speed;
  }
  EXPECT_NEAR(fastest, limit.yaw_rad,
              1e-6);  // the slower one, measured by its limit, sets the pace
  EXPECT_DOUBLE_EQ(before.yaw_rad, to.yaw_rad);
  EXPECT_DOUBLE_EQ(before.pitch_rad, to.pitch_rad);
}

TEST(JointCourse, NoWayAtAll) {
  const JointCourse course({0.3, -0.1}, {0.3, -0.1}, max_speed, 20.0);
  EXPECT_EQ(course.at(0.0), (geometry::HeadAngles{0.3, -0.1}));
  EXPECT_EQ(course.at(5.0), (geometry::HeadAngles{0.3, -0.1}));
}

TEST(SimJoints, PerfectOnesRestAtTheCommand) {
  SimJoints joints = make_joints({});
  joints.command({0, {0.4, -0.2}, 0.3});
  joints.advance_to(second_us);
  EXPECT_NEAR(joints.camera_angles(second_us).yaw_rad, 0.4, 1e-9);
  EXPECT_NEAR(joints.camera_angles(second_us).pitch_rad, -0.2, 1e-9);
  const geometry::HeadState state = joints.measure();
  EXPECT_EQ(state.utime_us, second_us);
  EXPECT_EQ(state.measured, (geometry::HeadAngles{0.4, -0.2}));
  constexpr double still_rad_s = 0.05;
  EXPECT_LT(std::abs(state.velocity_rad_s.yaw_rad), still_rad_s);
}

TEST(SimJoints, VelocityIsTheTrueOne) {
  JointBehaviour behaviour;
  behaviour.velocity_noise_rad_s = 0.0;
  behaviour.settle_time_constant_s = 0.0;
  SimJoints joints = make_joints(behaviour);
  joints.command({0, {1.0, 0.0}, 0.1});
  joints.advance_to(second_us / 2);
  EXPECT_NEAR(joints.measure().velocity_rad_s.yaw_rad, 0.1 * max_speed.yaw_rad, 1e-6);
}

TEST(SimJoints, SomeHeadsSayNothingOfTheirVelocityOrNought) {
  JointBehaviour behaviour;
  for (const Velocity velocity : {Velocity::none, Velocity::zero}) {
    behaviour.velocity = velocity;
    SimJoints joints = make_joints(behaviour);
    joints.command({0, {1.0, 0.0}, 0.1});
    joints.advance_to(second_us / 2);
    const geometry::HeadAngles said = joints.measure().velocity_rad_s;
    EXPECT_EQ(std::isnan(said.yaw_rad), velocity == Velocity::none);
    if (velocity == Velocity::zero) {
      EXPECT_EQ(said, geometry::HeadAngles{});
    }
  }
}

TEST(SimJoints, AJointThatDriftsGoesOnWhereItsLastMoveWent) {
  JointBehaviour behaviour;
  behaviour.drift_rad_s = 0.05;
  behaviour.settle_time_constant_s = 0.0;
  SimJoints joints = make_joints(behaviour);
  joints.advance_to(second_us);
  EXPECT_EQ(joints.camera_angles(second_us), geometry::HeadAngles{});  // nobody moved it yet
  joints.command({second_us, {0.3, -0.4}, 0.5});
  joints.advance_to(3 * second_us);
  const geometry::HeadAngles before = joints.camera_angles(3 * second_us - 100'000);
  const geometry::HeadAngles on = joints.camera_angles(3 * second_us) - before;
  EXPECT_NEAR(on.yaw_rad, 0.1 * 0.05 * 0.6, 1e-9);
  EXPECT_NEAR(on.pitch_rad, -0.1 * 0.05 * 0.8, 1e-9);
}

TEST(SimJoints, SettlingErrorIsUniformWithinItsBound) {
  JointBehaviour behaviour;
  behaviour.settling_error_rad = 0.02;
  SimJoints joints = make_joints(behaviour);
  constexpr int moves = 400;
  double squares = 0.0, largest = 0.0;
  for (int i = 0; i < moves; ++i) {
    const geometry::HeadAngles target{i % 2 == 0 ? 0.2 : -0.2, 0.1};
    const std::int64_t start_us = i * second_us;
    joints.advance_to(start_us);
    joints.command({start_us, target, 0.5});
    joints.advance_to(start_us + second_us - 1000);
    const geometry::HeadAngles off = joints.camera_angles(start_us + second_us - 1000) - target;
    for (const double error : {off.yaw_rad, off.pitch_rad}) {
      EXPECT_LE(std::abs(error), 0.02 + 1e-6);
      largest = std::max(largest, std::abs(error));
      squares += error * error;
    }
  }
  EXPECT_GT(largest, 0.019);
  EXPECT_NEAR(std::sqrt(squares / (2 * moves)), 0.02 / std::sqrt(3.0), 0.001);
}

TEST(SimJoints, TheSameCommandAgainChangesNothing) {
  JointBehaviour behaviour;
  behaviour.settling_error_rad = 0.02;
  SimJoints once = make_joints(behaviour), often = make_joints(behaviour);
  once.command({0, {0.2, 0.1}, 0.3});
  for (std::int64_t t = 0; t < second_us; t += 12'000) {
    once.advance_to(t);
    often.advance_to(t);
    often.command({t, {0.2, 0.1}, 0.3});
    ASSERT_EQ(once.camera_angles(t), often.camera_angles(t));
  }
}

TEST(SimJoints, BadCommandsAreIgnoredAndFarOnesClamped) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  SimJoints joints = make_joints({});
  joints.command({0, {nan, 0.0}, 0.3});
  joints.command({0, {0.0, std::numeric_limits<double>::infinity()}, 0.3});
  joints.command({0, {0.3, 0.1}, 0.0});
  joints.command({0, {0.3, 0.1}, -1.0});
  joints.command({0, {0.3, 0.1}, nan});
  joints.advance_to(second_us);
  EXPECT_EQ(joints.camera_angles(second_us), geometry::HeadAngles{});
  joints.command({second_us, {9.0, 9.0}, 5.0});
  joints.advance_to(4 * second_us);
  const geometry::HeadAngles rest = joints.camera_angles(4 * second_us);
  EXPECT_TRUE(geometry::HeadLimits().contains({rest.yaw_rad - 1e-9, rest.pitch_rad - 1e-9}));
  EXPECT_NEAR(rest.yaw_rad, geometry::HeadLimits().yaw_range().max_rad, 1e-6);
}

TEST(SimJoints, ACommandWaitsForItsTime) {
  SimJoints joints = make_joints({});
  joints.command({500'000, {0.3, 0.0}, 1.0});
  joints.advance_to(499'000);
  EXPECT_EQ(joints.camera_angles(499'000), geometry::HeadAngles{});
  joints.advance_to(second_us + 500'000);
  EXPECT_NEAR(joints.camera_angles(second_us + 500'000).yaw_rad, 0.3, 1e-6);
}

TEST(SimJoints, HoldStopsWhereItIs) {
  SimJoints joints = make_joints({});
  joints.command({0, {1.0, 0.0}, 0.1});
  joints.advance_to(400'000);
  const geometry::HeadAngles stopped = joints.camera_angles(400'000);
  joints.hold();
  joints.advance_to(second_us);
  EXPECT_GT(stopped.yaw_rad, 0.1);
  EXPECT_NEAR(joints.camera_angles(second_us).yaw_rad, stopped.yaw_rad, 1e-6);
}

TEST(SimJoints, EncoderStepAndNoise) {
  JointBehaviour behaviour;
  behaviour.encoder_step_rad = 0.00153;
  behaviour.encoder_noise_rad = 0.0005;
  SimJoints joints = make_joints(behaviour);
  joints.reset({0.1, -0.05}, 0);
  constexpr int samples = 20'000;
  std::set<long> steps;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double yaw_rad = joints.measure().measured.yaw_rad;
    const double step = yaw_rad / behaviour.encoder_step_rad;
    ASSERT_NEAR(step, std::round(step), 1e-9);
    steps.insert(std::lround(step));
    sum += yaw_rad - 0.1;
    squares += (yaw_rad - 0.1) * (yaw_rad - 0.1);
  }
  // Sheppard: rounding adds step^2/12 to the variance, nearly so for noise of a third of a step.
  const double expected = std::sqrt(0.0005 * 0.0005 + 0.00153 * 0.00153 / 12.0);
  EXPECT_NEAR(std::sqrt(squares / samples), expected, 0.15 * expected);
  EXPECT_LT(std::abs(sum / samples), 0.0003);
  EXPECT_GE(steps.size(), 2U);
  EXPECT_LE(steps.size(), 5U);
}

TEST(SimJoints, ALooksEncoderErrorStaysUntilTheNextCommand) {
  JointBehaviour behaviour;
  behaviour.encoder_sigma_rad = 0.02;
  SimJoints joints = make_joints(behaviour);
  constexpr int looks = 400;
  double squares = 0.0;
  for (int i = 0; i < looks; ++i) {
    const std::int64_t start_us = i * second_us;
    joints.advance_to(start_us);
    joints.command({start_us, {i % 2 == 0 ? 0.2 : -0.2, 0.0}, 0.5});
    joints.advance_to(start_us + second_us / 2);
    const geometry::HeadAngles true_angles = joints.camera_angles(start_us + second_us / 2);
    const geometry::HeadAngles first = joints.measure().measured;
    joints.advance_to(start_us + second_us - 1000);
    const geometry::HeadAngles last = joints.measure().measured;
    EXPECT_NEAR(first.yaw_rad, last.yaw_rad, 1e-6);  // the lag's tail
    EXPECT_NEAR(first.pitch_rad, last.pitch_rad, 1e-6);
    const geometry::HeadAngles error = first - true_angles;
    squares += error.yaw_rad * error.yaw_rad + error.pitch_rad * error.pitch_rad;
  }
  EXPECT_NEAR(std::sqrt(squares / (2 * looks)), 0.02, 0.002);
}

TEST(SimJoints, SourcesOfErrorAreIndependent) {
  JointBehaviour behaviour;
  behaviour.settling_error_rad = 0.02;
  JointBehaviour noisy = behaviour;
  noisy.encoder_noise_rad = 0.001;
  noisy.encoder_sigma_rad = 0.01;
  SimJoints quiet_joints = make_joints(behaviour), noisy_joints = make_joints(noisy);
  for (SimJoints* joints : {&quiet_joints, &noisy_joints}) {
    joints->command({0, {0.2, 0.1}, 0.3});
    joints->advance_to(second_us);
    (void)joints->measure();
    joints->command({second_us, {-0.2, 0.1}, 0.3});
    joints->advance_to(2 * second_us);
  }
  EXPECT_EQ(quiet_joints.camera_angles(2 * second_us), noisy_joints.camera_angles(2 * second_us));
}

TEST(SimJoints, BacklashDependsOnTheSideOfApproach) {
  JointBehaviour behaviour;
  behaviour.backlash_rad = 0.01;
  SimJoints joints = make_joints(behaviour);
  joints.command({0, {0.2, 0.0}, 0.5});
  joints.advance_to(second_us);
  EXPECT_NEAR(joints.camera_angles(second_us).yaw_rad, 0.2 - 0.005, 1e-6);
  EXPECT_NEAR(joints.measure().measured.yaw_rad, 0.2, 1e-6);  // the encoder does not see the play
  joints.command({second_us, {0.4, 0.0}, 0.5});
  joints.advance_to(2 * second_us);
  joints.command({2 * second_us, {0.2, 0.0}, 0.5});
  joints.advance_to(3 * second_us);
  EXPECT_NEAR(joints.camera_angles(3 * second_us).yaw_rad, 0.2 + 0.005, 1e-6);
}

TEST(SimJoints, FollowsAnotherHead) {
  SimJoints joints = make_joints({});
  constexpr std::int64_t later_us = 77 * second_us;
  joints.follow({0.1, 0.0}, later_us);
  joints.follow({0.2, 0.1}, later_us + 10'000);
  EXPECT_NEAR(joints.camera_angles(later_us).yaw_rad, 0.1, 1e-12);
  EXPECT_NEAR(joints.camera_angles(later_us + 5000).yaw_rad, 0.15, 1e-12);
  EXPECT_NEAR(joints.camera_angles(later_us + 10'000).pitch_rad, 0.1, 1e-12);
  EXPECT_NEAR(joints.camera_angles(later_us + 99'000).yaw_rad, 0.2, 1e-12);  // nothing newer known
  joints.follow({0.5, 0.5}, later_us - second_us);                           // its clock went back
  EXPECT_NEAR(joints.camera_angles(later_us - second_us).yaw_rad, 0.5, 1e-12);
  joints.follow({std::numeric_limits<double>::quiet_NaN(), 0.0}, later_us);
  EXPECT_NEAR(joints.camera_angles(later_us).yaw_rad, 0.5, 1e-12);
}

}  // namespace
}  // namespace gazed::sim::joints_test
