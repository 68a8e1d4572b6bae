#include "agent/lab/explain/words.hpp"

#include <gmock/gmock.h>
#include <string>

#include "agent/geometry/robot.hpp"

namespace gazed::lab::explain::words_test {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::SizeIs;

geometry::Rig nao() {
  return geometry::robot_profile("nao-v6")->rig;
}

cycle::Fixation two_looks(geometry::HeadAngles second) {
  cycle::Fixation fixation;
  fixation.robot = triangulation::all_looks::believed_before(nao());
  fixation.look_count = 2;
  fixation.looks[0].measured = fixation.looks[0].refined = {};
  fixation.looks[1].measured = fixation.looks[1].refined = second;
  fixation.pixel_1 = nao().camera.centre_px;
  return fixation;
}

TEST(ExplainWords, ALostTargetHasAReasonAndNoRange) {
  cycle::Fixation fixation;
  fixation.status = cycle::Status::target_lost;
  fixation.reason = "nothing like the target";
  EXPECT_EQ(answer_sentence(fixation), "No range: nothing like the target.");
  EXPECT_EQ(summary_line(fixation), "fixation 0: TARGET_LOST, 0 looks");
}

TEST(ExplainWords, AnIntervalThatReachesInfinitySaysSo) {
  cycle::Fixation fixation;
  fixation.estimate.inverse_range_per_m = 0.5;
  fixation.estimate.inverse_range_sigma_per_m = 0.6;
  EXPECT_THAT(answer_sentence(fixation), HasSubstr("68 % interval from 0.909 m to infinity"));
}

TEST(ExplainWords, TheReportsAnswerMayBeBehindTheCamera) {
  cycle::Fixation fixation = two_looks({-0.2, 0.1});
  fixation.report_position_m = {-0.2, 0.0, 0.1};
  fixation.report_range_m = -0.23;
  EXPECT_THAT(report_sentence(fixation), HasSubstr("say 0.230 m, behind the camera"));
  fixation.look_count = 1;
  EXPECT_THAT(report_sentence(fixation), HasSubstr("need two looks"));
}

// 59 mm of arm and 0.22 rad: 13 mm. A milliradian of encoder error is 0.12 mm of it.
TEST(ExplainWords, EpipolesCoincideOnlyWhereTheHeadDidNotTurn) {
  const std::string turned = epipoles_sentence(two_looks({-0.2, 0.1}), nao());
  EXPECT_THAT(turned, HasSubstr("Here they do not"));
  EXPECT_THAT(epipoles_sentence(two_looks({1e-4, 0.0}), nao()),
              HasSubstr("Here they cannot be told apart"));
  EXPECT_THAT(epipoles_sentence({}, nao()), HasSubstr("There is no second look"));
}

TEST(ExplainWords, EveryRowOfATableHasACellForEachColumn) {
  const cycle::Fixation fixation = two_looks({-0.2, 0.1});
  for (const Table& table :
       {table_of_looks(fixation), table_of_epipoles(fixation), table_of_robot(fixation, nao())}) {
    EXPECT_FALSE(table.rows.empty());
    EXPECT_THAT(table.rows, Each(SizeIs(table.header.size())));
  }
  EXPECT_THAT(table_of_robot(fixation, nao()).rows, SizeIs(13));
}

}  // namespace
}  // namespace gazed::lab::explain::words_test
