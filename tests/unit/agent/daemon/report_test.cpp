#include "agent/daemon/report.hpp"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "agent/daemon/publisher.hpp"

#include "tests/unit/agent/daemon/example_fixation.hpp"

namespace gazed::daemon::report_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReportJson, HasTheFieldsOfLocatedPointInTheirOrder) {
  const Json json = Json::parse(to_json(to_message(example_fixation())));
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  // In the order of msgs/located_point_t.lcm.
  EXPECT_THAT(
      keys, testing::ElementsAre("utime", "fixation", "status", "reason", "views", "position_m",
                                 "covariance_m2", "camera_position_m", "range_m", "range_sigma_m",
                                 "inverse_range_per_m", "inverse_range_sigma_per_m", "parallax_rad",
                                 "residual_px", "pixel_1", "pixel_2", "head_1_rad", "head_2_rad",
                                 "saliency", "distinctness"));
}

TEST(ReportJson, CarriesEveryFieldExactly) {
  const cycle::Fixation fixation = example_fixation();
  const triangulation::PointEstimate& estimate = fixation.estimate;
  const auto list = [](const auto& vector) {
    return std::vector<double>(vector.data(), vector.data() + vector.size());
  };
  const auto angles = [](geometry::HeadAngles head) {
    return std::vector{head.yaw_rad, head.pitch_rad};
  };
  Json covariance;
  for (int row = 0; row < 3; ++row)
    covariance.push_back(list(Eigen::Vector3d(estimate.torso_covariance_m2.row(row))));
  const Json expected{{"utime", fixation.utime_us},
                      {"fixation", fixation.number},
                      {"status", "LOCATED"},
                      {"reason", fixation.reason},
                      {"views", fixation.views},
                      {"position_m", list(estimate.torso_point_m)},
                      {"covariance_m2", covariance},
                      {"camera_position_m", list(estimate.point_m)},
                      {"range_m", estimate.range_m},
                      {"range_sigma_m", estimate.range_sigma_m},
                      {"inverse_range_per_m", estimate.inverse_range_per_m},
                      {"inverse_range_sigma_per_m", estimate.inverse_range_sigma_per_m},
                      {"parallax_rad", estimate.parallax_rad},
                      {"residual_px", estimate.residual_px},
                      {"pixel_1", list(fixation.pixel_1)},
                      {"pixel_2", list(fixation.pixel_2)},
                      {"head_1_rad", angles(fixation.head_1)},
                      {"head_2_rad", angles(fixation.head_2)},
                      {"saliency", fixation.saliency},
                      {"distinctness", fixation.distinctness}};
  EXPECT_EQ(Json::parse(to_json(to_message(fixation))), expected);
}

TEST(ReportJson, WritesNullForWhatHasNoMeaning) {
  cycle::Fixation fixation;
  fixation.status = cycle::Status::no_salient_object;
  const Json json = Json::parse(to_json(to_message(fixation)));
  EXPECT_EQ(json["status"], "NO_SALIENT_OBJECT");
  for (const char* key :
       {"range_m", "range_sigma_m", "inverse_range_per_m", "parallax_rad", "residual_px"}) {
    EXPECT_TRUE(json[key].is_null()) << key;
  }
  EXPECT_TRUE(json["position_m"][0].is_null());
  EXPECT_TRUE(json["covariance_m2"][1][1].is_null());
  EXPECT_TRUE(json["pixel_2"][0].is_null());
  EXPECT_TRUE(json["head_2_rad"][0].is_null());
}

TEST(ReportJson, IsOneLineWhateverTheReasonHolds) {
  cycle::Fixation fixation = example_fixation();
  fixation.reason = "two\nlines and \xff bad bytes";
  EXPECT_THAT(to_json(to_message(fixation)), Not(HasSubstr("\n")));
}

TEST(ReportText, SaysWhereAndHowSure) {
  const std::string text = to_text(example_fixation(), {2.0, 4.0});
  EXPECT_THAT(text, HasSubstr("fixation 3: LOCATED"));
  EXPECT_THAT(text, HasSubstr("0.300 m away +- 0.018 m (6.0 %)"));
  // The interval of inverse range: 1 / (3.3333 + 0.2) and 1 / (3.3333 - 0.2).
  EXPECT_THAT(text, HasSubstr("0.283 to 0.319 m"));
  EXPECT_THAT(text, HasSubstr("x 0.350  y 0.040  z 0.190 m   +- 0.020  0.030  0.010"));
}

TEST(ReportText, HasTheReportsAnswerWhereItWasAskedFor) {
  cycle::Fixation fixation = example_fixation();
  fixation.look_count = 2;
  fixation.report_position_m = {-0.17, 0.03, 0.19};
  fixation.report_range_m = -0.229;
  EXPECT_THAT(to_text(fixation, {}), Not(HasSubstr("six steps")));
  fixation.method = cycle::LocateMethod::report;
  EXPECT_THAT(to_text(fixation, {}),
              HasSubstr("\n    by the report's six steps: -0.229 m away; torso frame: x -0.170  y "
                        "0.030  z 0.190 m\n"));
  fixation.report_position_m.setConstant(triangulation::not_a_number);
  const std::string without = to_text(fixation, {});
  EXPECT_THAT(without, HasSubstr("by the report's six steps: no answer"));
  EXPECT_THAT(without, Not(HasSubstr("nan")));
}

TEST(ReportText, AnUncertainPointWithoutRangeStillSaysWhatIsKnown) {
  cycle::Fixation fixation = example_fixation();
  fixation.estimate = {};
  fixation.status = cycle::Status::uncertain;
  fixation.reason = "the reason";
  fixation.estimate.inverse_range_per_m = 0.5;
  fixation.estimate.inverse_range_sigma_per_m = 0.7;
  const std::string text = to_text(fixation, {});
  EXPECT_THAT(text, HasSubstr("UNCERTAIN"));
  EXPECT_THAT(text, HasSubstr("0.500 +- 0.700 per metre"));
  EXPECT_THAT(text, HasSubstr("the reason"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(ReportText, AFaultWithoutAnyViewHasNoNumbers) {
  cycle::Fixation fixation;
  fixation.counts = false;
  fixation.status = cycle::Status::camera_fault;
  fixation.reason = "no usable frame for 2.0 s";
  EXPECT_EQ(to_text(fixation, {}),
            "between fixations: CAMERA_FAULT\n    no usable frame for 2.0 s");
}

}  // namespace
}  // namespace gazed::daemon::report_test
