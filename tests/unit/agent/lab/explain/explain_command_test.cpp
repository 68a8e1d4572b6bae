// gazelab explain as a user runs it, on recordings of the simulated robot.
#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "agent/lab/explain/replay.hpp"

#include "tests/integration/program.hpp"
#include "tests/unit/agent/lab/scratch.hpp"

namespace gazed::lab::explain::explain_command_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// In front of a bare wall, two metres away: no robot that turns its head can tell how far.
constexpr const char* far_scene = "repeat = true\n[[report_test]]\nnumber = 1\nrange_m = 2.0\n";
// It is gone before the head has turned.
constexpr const char* fleeing_scene =
    "repeat = true\n[[report_test]]\nnumber = 1\nrange_m = 0.30\nvelocity_m_s = [0.0, 0.5, 0.0]\n";

/// A page without its pictures.
std::string words_of(const std::filesystem::path& page) {
  std::string text = file_text(page);
  for (std::size_t at = 0; (at = text.find("base64,", at)) != std::string::npos;) {
    text.erase(at, text.find('"', at) - at);
  }
  return text;
}

class GazelabExplain : public ::testing::Test {
 protected:
  std::string record(const std::string& scene, int fixations = 1) {
    std::vector<std::string> arguments{GAZED_PROGRAM, "--fixations", std::to_string(fixations),
                                       "--record",    log_,          "--print",
                                       "none",        "--lcm-url",   "memq://"};
    if (!scene.empty()) {
      write_text(folder_ / "scene.toml", scene);
      arguments.insert(arguments.end(), {"--scene", (folder_ / "scene.toml").string()});
    }
    const integration::ProgramResult run = integration::run_program(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return log_;
  }
  Outcome explain(const std::vector<std::string>& options = {},
                  const Surroundings& surroundings = {}) {
    std::vector<std::string> arguments{"explain", log_, "--out", out_.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_gazelab(arguments, surroundings);
  }
  [[nodiscard]] bool has(const std::string& file) const {
    return std::filesystem::exists(out_ / file);
  }

  ScratchFolder folder_;
  std::string log_ = (folder_ / "walk.lcm").string();
  std::filesystem::path out_ = folder_ / "out";
};

TEST_F(GazelabExplain, ReplaysWhatGazedReplays) {
  record("", 2);
  const integration::ProgramResult gazed =
      integration::run_program({GAZED_PROGRAM, "--camera", "log:" + log_, "--head", "log:" + log_,
                                "--print", "json", "--lcm-url", "memq://"});
  Replay replay(settings_of(log_, {}), log_);
  std::istringstream lines(gazed.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto point = nlohmann::json::parse(line);
    const auto replayed = replay.next();
    ASSERT_TRUE(replayed);
    EXPECT_EQ(point["status"], cycle::name(replayed->fixation.status));
    EXPECT_EQ(point["utime"], replayed->fixation.utime_us);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(point["position_m"][static_cast<std::size_t>(i)].get<double>(),
                replayed->fixation.estimate.torso_point_m(i));
    }
    // A frame for each look, and what stood out in it.
    ASSERT_EQ(replayed->frames.size(), replayed->fixation.look_count);
    for (std::size_t k = 0; k < replayed->fixation.look_count; ++k) {
      ASSERT_NE(replayed->frame_at(replayed->fixation.looks[k].utime_us), nullptr);
    }
    EXPECT_FALSE(replayed->frames.front().map_samples.empty());
  }
  EXPECT_EQ(count, 2);
  EXPECT_FALSE(replay.next());
}

TEST_F(GazelabExplain, ALocatedOneHasEverything) {
  record("", 2);
  const Outcome run = explain({"--fixation", "1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("fixation 1: LOCATED"));
  EXPECT_THAT(run.out, HasSubstr("fixation 2: LOCATED"));
  for (const char* file :
       {"fixation-1.html", "fixation-1-look-1.png", "fixation-1-look-2.png", "fixation-1-map-1.png",
        "fixation-1-patches.png", "fixation-1-range.png", "fixation-1-range.svg",
        "fixation-1-costs.png", "fixation-1-costs.svg"}) {
    EXPECT_TRUE(has(file)) << file;
  }
  const std::string page = words_of(out_ / "fixation-1.html");
  for (const char* words :
       {"LOCATED", "How far away", "What each source of error costs", "lever arm",
        "The report&#39;s six steps", "Here they do not", "What is believed of the robot"}) {
    EXPECT_THAT(page, HasSubstr(words));
  }
  EXPECT_THAT(page, Not(HasSubstr("nan<")));
}

TEST_F(GazelabExplain, AnUncertainOneSaysWhatCostsMost) {
  record(far_scene);
  ASSERT_EQ(explain().exit_code, 0);
  const std::string page = words_of(out_ / "fixation-1.html");
  EXPECT_THAT(page, HasSubstr("UNCERTAIN"));
  EXPECT_THAT(page, HasSubstr("over the gate of 15 %"));
  EXPECT_THAT(page, HasSubstr("focal length"));
}

TEST_F(GazelabExplain, ALostOneSaysWhyEachLookMissed) {
  record(fleeing_scene);
  const Outcome run = explain();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("fixation 1: TARGET_LOST"));
  const std::string page = words_of(out_ / "fixation-1.html");
  EXPECT_THAT(page, HasSubstr("nothing like the target"));
  EXPECT_THAT(page, HasSubstr("No two looks saw the target"));
  EXPECT_THAT(page, HasSubstr("There is no answer whose error could be split."));
  EXPECT_TRUE(has("fixation-1-look-2.png"));
  EXPECT_FALSE(has("fixation-1-range.png"));
}

TEST_F(GazelabExplain, OtherSettingsGiveAnotherAnswer) {
  record("");
  const Outcome run = explain({"--set", "locate.looks=2"});
  EXPECT_THAT(run.out, HasSubstr("2 looks")) << run.err;
}

TEST_F(GazelabExplain, WithoutGnuplotThePageIsThereAllTheSame) {
  record("");
  const Outcome run = explain({}, {.path = folder_.path().string()});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("gnuplot is not installed"));
  EXPECT_THAT(words_of(out_ / "fixation-1.html"), HasSubstr("No chart"));
}

TEST_F(GazelabExplain, RefusesWhatIsNotThere) {
  record("");
  EXPECT_EQ(explain({"--fixation", "7"}).exit_code, 2);
  EXPECT_THAT(explain({"--fixation", "7"}).err, HasSubstr("--fixation: 7 found; allowed: 1 to 1"));
  EXPECT_EQ(explain({"--fixation", "0"}).exit_code, 2);
  EXPECT_THAT(explain({"--set", "nonsense"}).err, HasSubstr("allowed: KEY=VALUE"));
  EXPECT_EQ(explain({"--robot", "nao-v9"}).exit_code, 2);
  log_ = (folder_ / "none.lcm").string();
  EXPECT_EQ(explain().exit_code, 2);
  write_text(log_, "no log");
  EXPECT_EQ(explain().exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace gazed::lab::explain::explain_command_test
