// gazed at the socket of a robot without a robot, the camera in the simulator's room: it renders
// what the head says.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/limits.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/exclusive.hpp"

#include "tests/integration/program.hpp"
#include "tests/integration/report_tests.hpp"

namespace gazed::integration::lola_daemon_test {
namespace {

using Json = nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;

// Where a look takes seconds, the loop now and then hears of the head too late. Then more fixations
// are made, and what is located must be right all the same.
constexpr bool too_slow_for_a_robot = GAZED_FEW_TRIALS;
constexpr int fixations_a_test = too_slow_for_a_robot ? 2 : 1;

/// Along the ray through pixel_1 of a camera that may have looked at the report's wall from any
/// head angles: the wall stands 0.30 m before the camera, across its optical axis, with the head at
/// (0, 0).
double true_inverse_range_per_m(const Json& point) {
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  const geometry::Pose torso_from_cam0 = geometry::cam_from_torso(rig.head, {}).inverse();
  const Eigen::Vector3d normal = torso_from_cam0.rotation.col(2);
  const Eigen::Vector3d on_wall = torso_from_cam0.translation + 0.30 * normal;
  const geometry::HeadAngles head{point["head_1_rad"][0].get<double>(),
                                  point["head_1_rad"][1].get<double>()};
  const geometry::Pose torso_from_cam1 = geometry::cam_from_torso(rig.head, head).inverse();
  const geometry::Pixel pixel(point["pixel_1"][0].get<double>(), point["pixel_1"][1].get<double>());
  const Eigen::Vector2d seen = geometry::normalise(rig.camera, pixel).value();
  const Eigen::Vector3d ray =
      torso_from_cam1.rotation * Eigen::Vector3d(seen.x(), seen.y(), 1.0).normalized();
  return normal.dot(ray) / normal.dot(on_wall - torso_from_cam1.translation);
}

double sigmas_off_the_wall(const Json& point) {
  return std::abs(point["inverse_range_per_m"].get<double>() - true_inverse_range_per_m(point)) /
         point["inverse_range_sigma_per_m"].get<double>();
}

struct OrderLine {
  double time_s, yaw_rad, pitch_rad, yaw_stiffness, pitch_stiffness, measured_yaw_rad,
      measured_pitch_rad, others_moved_rad, others_stiffness;
};

std::vector<OrderLine> orders_in(const std::string& file) {
  std::vector<OrderLine> orders;
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);  // the names
  while (std::getline(lines, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream numbers(line);
    OrderLine order{};
    numbers >> order.time_s >> order.yaw_rad >> order.pitch_rad >> order.yaw_stiffness >>
        order.pitch_stiffness >> order.measured_yaw_rad >> order.measured_pitch_rad >>
        order.others_moved_rad >> order.others_stiffness;
    EXPECT_TRUE(numbers) << line;
    orders.push_back(order);
  }
  return orders;
}

class LolaDaemon : public testing::Test {
 protected:
  /// gazed until it has so many points of one of the report's tests, with a robot that suffers
  /// these faults. Of one: where the other's object is, the head may not look any more.
  void run(int fixations, const std::vector<std::string>& faults = {}, int report_test = 1) {
    const std::string scene = temporary_file(
        "report_test.toml", "[[report_test]]\nnumber = " + std::to_string(report_test) + "\n");
    std::vector<std::string> robot{LOLA_ROBOT, socket_, "--orders", orders_, "--shuffled"};
    robot.insert(robot.end(), faults.begin(), faults.end());
    RunningProgram running(robot);
    const std::vector<std::string> arguments{
        GAZED_PROGRAM, "--lcm-url", "memq://", "--print", "json", "--scene", scene, "--head",
        "lola:" + socket_, "--fixations", std::to_string(fixations),
        // The robot's torso stands still, which two looks cannot find out.
        "--set", "locate.looks=2", "--set", "uncertainty.torso_rotation_sigma_rad=0", "--set",
        "uncertainty.torso_translation_sigma_m=0"};
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    notes_ = result.err;
    points_ = points_in(result.out);
    running.send_signal(SIGTERM);
    const ProgramResult robots = running.finish();
    EXPECT_EQ(robots.exit_code, 0) << robots.out << robots.err;
  }
  [[nodiscard]] std::vector<std::string> values(const std::string& key) const {
    std::vector<std::string> all;
    for (const Json& point : points_) all.push_back(point[key]);
    return all;
  }

  const std::string socket_ = temporary_file("lola.socket"), orders_ = temporary_file("orders.csv");
  std::vector<Json> points_;
  std::string notes_;
};

TEST_F(LolaDaemon, LocatesTheReportsTests) {
  int located = 0;
  for (const int report_test : {1, 2}) {
    run(fixations_a_test, {}, report_test);
    for (const Json& point : points_) {
      if (too_slow_for_a_robot && point["status"] == "HEAD_FAULT") continue;
      // Who is late sees the head on its way elsewhere, and its looks may be too near each other.
      if (point["status"] == "LOCATED") {
        ++located;
      } else {
        ASSERT_TRUE(too_slow_for_a_robot && point["status"] == "UNCERTAIN") << point << notes_;
      }
      EXPECT_EQ(point["views"], 2);
      // Two sigmas as with the simulated head; these joints settle better than its do.
      EXPECT_LT(sigmas_off_the_wall(point), 2.0) << point;
    }
  }
  EXPECT_GE(located, too_slow_for_a_robot ? 1 : 2) << notes_;
}

TEST_F(LolaDaemon, LeavesTheBodyAloneAndTheHeadLimp) {
  run(1);
  const auto orders = orders_in(orders_);
  ASSERT_FALSE(orders.empty());
  const geometry::HeadLimits limits;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    ASSERT_TRUE(limits.contains({orders[i].yaw_rad, orders[i].pitch_rad})) << i;
    ASSERT_EQ(orders[i].others_moved_rad, 0.0) << i;
    ASSERT_NEAR(orders[i].others_stiffness, 0.8, 1e-6) << i;
    if (i == 0) continue;
    ASSERT_LT(std::abs(orders[i].yaw_stiffness - orders[i - 1].yaw_stiffness), 0.02) << i;
  }
  EXPECT_EQ(orders.front().yaw_stiffness, 0.0);
  if (too_slow_for_a_robot) return;
  EXPECT_NEAR(std::ranges::max(orders, {}, &OrderLine::yaw_stiffness).yaw_stiffness, 0.7, 1e-6);
  // As it was found; the test may end the robot before it reads the very last order.
  EXPECT_LT(orders.back().yaw_stiffness, 0.05);
}

// A gazed that is killed cannot give the head back: LoLA keeps it as stiff as it was.
TEST_F(LolaDaemon, KilledItLeavesAStiffHeadWhichIsThenReleased) {
  RunningProgram robot({LOLA_ROBOT, socket_, "--orders", orders_});
  const std::vector<std::string> gazed{GAZED_PROGRAM, "--lcm-url", "memq://",        "--print",
                                       "json",        "--head",    "lola:" + socket_};
  const auto release = [&](std::vector<std::string> options) {
    options.insert(options.begin(), gazed.begin(), gazed.end());
    options.push_back("--release-head");
    return run_program(options);
  };
  RunningProgram killed(gazed);
  // Where it is too slow, it is enough that it drives the head.
  ASSERT_TRUE(killed.prints("LOCATED", too_slow_for_a_robot ? 20.0 : 120.0) ||
              too_slow_for_a_robot);
  const ProgramResult refused = release({});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("is used by process"));
  killed.send_signal(SIGKILL);
  EXPECT_EQ(killed.finish().exit_code, 128 + SIGKILL);
  EXPECT_EQ(release({"--set", "head.limp_after_kill=false"}).exit_code, 0);
  const OrderLine before = orders_in(orders_).back();
  EXPECT_TRUE(too_slow_for_a_robot || before.yaw_stiffness > 0.6) << before.yaw_stiffness;
  const ProgramResult released = release({});
  EXPECT_EQ(released.exit_code, 0) << released.err;
  robot.send_signal(SIGTERM);
  EXPECT_EQ(robot.finish().exit_code, 0);
  const OrderLine after = orders_in(orders_).back();
  // The robot may be ended before it reads the very last order.
  EXPECT_LT(after.yaw_stiffness, 0.05);
  EXPECT_LT(after.pitch_stiffness, 0.05);
  EXPECT_NEAR(after.others_stiffness, 0.8, 1e-6) << "the body stands as it stood";
}

/// What takes the loop in step with a robot's pace. What the driver makes of each fault is tested
/// without a clock, in all builds (tests/unit/drivers/lola/faults_test.cpp).
class LolaFaults : public LolaDaemon {
 protected:
  void SetUp() override {
    if (too_slow_for_a_robot)
      GTEST_SKIP() << "instrumented or emulated: too slow for a robot's pace";
  }
};

TEST_F(LolaFaults, ShortOnesOfTheConnectionAreSurvived) {
  // With the faults these take 6 s or so; lola_robot ends badly when one was not reached.
  run(7,
      {"--at", "0.4",      "eof",  "--at", "0.8",   "cut_short", "--at", "1.2", "garbage", "--at",
       "1.6",  "too_long", "--at", "2.0",  "stall", "0.5",       "--at", "2.8", "nan",     "0.3"});
  ASSERT_EQ(points_.size(), 7U) << notes_;
  EXPECT_THAT(values("status"), testing::Each("LOCATED")) << notes_;
}

TEST_F(LolaFaults, ARobotThatIsAwayIsAHeadFaultAndThenLocatesAgain) {
  run(4, {"--at", "0.8", "down", "3"});
  EXPECT_THAT(values("status"), Contains("HEAD_FAULT")) << notes_;
  EXPECT_THAT(values("reason"),
              Contains(testing::AllOf(HasSubstr("no head state for "),
                                      HasSubstr("lola.socket: No such file or directory"))));
  ASSERT_FALSE(points_.empty());
  EXPECT_EQ(points_.back()["status"], "LOCATED");
}

TEST_F(LolaFaults, AFallenRobotIsAHeadFault) {
  run(4, {"--at", "0.8", "fallen", "3"});
  EXPECT_THAT(values("reason"), Contains(HasSubstr("the torso leans by 1.40 rad"))) << notes_;
  ASSERT_FALSE(points_.empty());
  EXPECT_EQ(points_.back()["status"], "LOCATED");
}

TEST_F(LolaFaults, AStuckJointIsAHeadFault) {
  run(3, {"--at", "0.1", "stuck", "4"});
  EXPECT_THAT(values("status"), Contains("HEAD_FAULT"));
  EXPECT_THAT(values("reason"), Contains(HasSubstr("the head has not settled")));
  EXPECT_THAT(notes_, HasSubstr("HeadYaw is stuck"));
  ASSERT_FALSE(points_.empty());
  EXPECT_EQ(points_.back()["status"], "LOCATED");
}

TEST_F(LolaDaemon, ASecondGazedAtTheSameSocketIsRefused) {
  const drivers::ExclusiveUse first(socket_);
  const ProgramResult second =
      run_program({GAZED_PROGRAM, "--lcm-url", "memq://", "--head", "lola:" + socket_});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr(socket_ + " is used by process"));
}

}  // namespace
}  // namespace gazed::integration::lola_daemon_test
