#include "agent/daemon/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

TEST(ReportJson, CarriesEveryNumberExactly) {
  const cycle::Fixation fixation = example_fixation();
  const Json json = Json::parse(to_json(to_message(fixation)));
  EXPECT_EQ(json["utime"], fixation.utime_us);
  EXPECT_EQ(json["status"], "LOCATED");
  EXPECT_EQ(json["reason"], fixation.estimate.reason);
  EXPECT_EQ(json["position_m"][2].get<double>(), 0.19);
  EXPECT_EQ(json["covariance_m2"][0][2].get<double>(), 2e-5);
  EXPECT_EQ(json["inverse_range_per_m"].get<double>(), 1.0 / 0.30);
  EXPECT_EQ(json["head_2_rad"][1].get<double>(), 0.109);
}

TEST(ReportJson, WritesNullForWhatHasNoMeaning) {
  cycle::Fixation fixation;
  fixation.estimate.status = triangulation::Status::no_salient_object;
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
  fixation.estimate.reason = "two\nlines and \xff bad bytes";
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

TEST(ReportText, AnUncertainPointWithoutRangeStillSaysWhatIsKnown) {
  cycle::Fixation fixation = example_fixation();
  fixation.estimate = {};
  fixation.estimate.status = triangulation::Status::uncertain;
  fixation.estimate.reason = "the reason";
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
  fixation.estimate.status = triangulation::Status::camera_fault;
  fixation.estimate.reason = "no usable frame for 2.0 s";
  EXPECT_EQ(to_text(fixation, {}),
            "between fixations: CAMERA_FAULT\n    no usable frame for 2.0 s");
}

}  // namespace
}  // namespace gazed::daemon::report_test
