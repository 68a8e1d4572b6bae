// The report's own steps 5 and 6: right where everything is, and as wrong as the report found them
// where the angles are wrong.
#include "agent/triangulation/report_answer.hpp"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>

#include "agent/geometry/robot.hpp"

namespace gazed::triangulation::report_answer_test {
namespace {

/// The report's NAO, and its two looks at an object 0.3 m away in the middle of the first image.
struct ReportTest1 {
  geometry::Rig rig = geometry::robot_profile("nao-v3")->rig;
  geometry::HeadAngles head_1{}, head_2{0.1, 0.1};
  Eigen::Vector3d in_cam1_m{0.0, 0.0, 0.3};

  [[nodiscard]] geometry::Pose torso_from_cam1() const {
    return geometry::cam_from_torso(rig.head, head_1).inverse();
  }
  [[nodiscard]] TwoLooks looks() const {
    const geometry::Pose pose = geometry::cam2_from_cam1(rig.head, head_1, head_2);
    return {head_1, head_2, geometry::project(rig.camera, in_cam1_m).value(),
            geometry::project(rig.camera, pose * in_cam1_m).value()};
  }
  /// Depth of the answer in camera 1.
  [[nodiscard]] double depth_m(const TwoLooks& looks) const {
    return (torso_from_cam1().inverse() * report_answer_m(rig, looks)).z();
  }
};

TEST(ReportAnswer, IsTheObjectWhereNothingErrs) {
  const ReportTest1 test;
  const Eigen::Vector3d expected_m = test.torso_from_cam1() * test.in_cam1_m;
  EXPECT_LT((report_answer_m(test.rig, test.looks()) - expected_m).norm(), 1e-9);
}

// "The error in the angle is approximately 0.02 radian" (Russcher 2011, chapter 5): in both looks
// it is more than the parallax, so the answer is anywhere, behind the robot too.
TEST(ReportAnswer, IsAnywhereWithTheReportsErrorOfTheAngles) {
  const ReportTest1 test;
  constexpr double error_rad = 0.02;
  bool behind = false, far = false;
  for (const double yaw : {-error_rad, 0.0, error_rad}) {
    for (const double pitch : {-error_rad, 0.0, error_rad}) {
      TwoLooks looks = test.looks();
      looks.head_1 = looks.head_1 - geometry::HeadAngles{yaw, pitch};
      looks.head_2 = looks.head_2 + geometry::HeadAngles{yaw, pitch};
      const double depth_m = test.depth_m(looks);
      behind = behind || depth_m < 0.0;
      far = far || std::abs(depth_m) > 1.0;
    }
  }
  EXPECT_TRUE(behind);
  EXPECT_TRUE(far);
}

TEST(ReportAnswer, IsNotANumberWhereThereIsNone) {
  const ReportTest1 test;
  TwoLooks same = test.looks();
  same.head_2 = same.head_1;  // no baseline
  EXPECT_TRUE(report_answer_m(test.rig, same).array().isNaN().all());
  TwoLooks unseen = test.looks();
  unseen.pixel_2.setConstant(not_a_number);
  EXPECT_TRUE(report_answer_m(test.rig, unseen).array().isNaN().all());
}

}  // namespace
}  // namespace gazed::triangulation::report_answer_test
