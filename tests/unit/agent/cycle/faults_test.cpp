// Heads that do not do as they are told, and sources that fall silent.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "agent/cycle/cycle.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::faults_test {
namespace {

using ::testing::HasSubstr;

TEST(Cycle, AHeadThatDoesNotTurnIsAFault) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  dut.obeys = false;
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
  EXPECT_TRUE(fixation->counts);
  EXPECT_THAT(fixation->reason, HasSubstr("3.0 s"));
  // It is tried again at once, but reported every 10 s only.
  EXPECT_FALSE(dut.run(9.0));
  EXPECT_GE(dut.commands, 3);
  EXPECT_TRUE(dut.run(5.0));
}

TEST(Cycle, AHeadThatTurnsAfterAllIsUsed) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  dut.obeys = false;
  ASSERT_EQ(dut.run()->status, Status::head_fault);
  dut.obeys = true;
  EXPECT_EQ(dut.run(15.0)->status, Status::located);
}

TEST(Cycle, AnglesFarOutsideTheLimitsAreAFault) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  dut.measured = [](geometry::HeadState state) {
    state.measured.pitch_rad = 1.2;
    return state;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
  EXPECT_THAT(fixation->reason, HasSubstr("1.200"));
  EXPECT_EQ(fixation->views, 1);
  EXPECT_EQ(fixation->head_1.pitch_rad, 1.2);
  EXPECT_GT(fixation->distinctness, 0.0F);
  EXPECT_EQ(dut.commands, 0);
}

// More than encoders and the margin can explain, 0.1 rad.
TEST(Cycle, AnglesALittleOutsideTheLimitsAreBelieved) {
  const HeadSetup setup = calibrated_nao_v6();
  const geometry::HeadLimits limits(setup.cycle.motion.margin_rad);
  const double limit_rad = limits.clamp({0.0, 1.2}).pitch_rad;
  for (const double outside_rad : {0.099, 0.101}) {
    SimulatedHead dut(report_test_1, setup);
    dut.measured = [&](geometry::HeadState state) {
      state.measured.pitch_rad = limit_rad + outside_rad;
      return state;
    };
    const bool refused = dut.run(1.0).has_value();
    EXPECT_EQ(refused, outside_rad > 0.1);
    EXPECT_EQ(dut.commands, refused ? 0 : 1);
  }
}

TEST(Cycle, SilenceIsAFaultOnceThenEveryTenSeconds) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  EXPECT_FALSE(dut.cycle.on_silence({1.9, 0.0, "", "", 1.9}).fixation);
  const auto fault = dut.cycle.on_silence({2.0, 0.0, "no device", "", 2.0}).fixation;
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, Status::camera_fault);
  EXPECT_FALSE(fault->counts);
  EXPECT_THAT(fault->reason, HasSubstr("no device"));
  EXPECT_EQ(dut.cycle.state(), CycleState::fault);
  EXPECT_FALSE(dut.cycle.on_silence({11.9, 0.0, "", "", 11.9}).fixation);
  EXPECT_TRUE(dut.cycle.on_silence({12.1, 0.0, "", "", 12.1}).fixation);
  EXPECT_FALSE(dut.cycle.on_silence({13.0, 0.0, "", "", 13.0}).fixation);
}

TEST(Cycle, ACameraThatComesAndGoesIsSpokenOfEveryTenSeconds) {
  SimulatedHead dut(bare_wall, calibrated_nao_v6());
  ASSERT_TRUE(dut.cycle.on_silence({2.0, 0.0, "", "", 2.0}).fixation);
  EXPECT_FALSE(dut.run(0.2));
  EXPECT_FALSE(dut.cycle.on_silence({2.0, 0.0, "", "", 5.0}).fixation);
  EXPECT_EQ(dut.cycle.state(), CycleState::fault);
  EXPECT_FALSE(dut.run(0.2));
  EXPECT_TRUE(dut.cycle.on_silence({2.0, 0.0, "", "", 12.0}).fixation);
}

TEST(Cycle, AFrameFromBeforeTheFirstHeadStateIsLetGo) {
  Cycle dut = calibrated_nao_v6().made();
  const base::Image grey(640, 480, base::PixelFormat::grey);
  EXPECT_TRUE(dut.on_frame({grey.view(), 1'000'000}).consumed);
  EXPECT_TRUE(dut.on_head_state({1'010'000, {}, {}}).consumed);
  // It would wait for ever, and every later frame with it.
  EXPECT_TRUE(dut.on_frame({grey.view(), 1'033'000}).consumed);
}

TEST(Cycle, BothSilentAreBothNamed) {
  SimulatedHead dut(bare_wall, calibrated_nao_v6());
  const auto fault = dut.cycle.on_silence({3.0, 4.0, "no device", "angle is NaN", 4.0}).fixation;
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->reason, HasSubstr("no device"));
  EXPECT_THAT(fault->reason, HasSubstr("angle is NaN"));
  EXPECT_TRUE(std::isnan(fault->saliency));
}

TEST(Cycle, AHeadThatIsNeverStillIsAFault) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  const std::int64_t start_us = dut.robot->now_us();
  dut.measured = [&](geometry::HeadState state) {
    state.velocity_rad_s.yaw_rad = 0.3;
    state.measured.yaw_rad += 0.3e-6 * static_cast<double>(state.utime_us - start_us);
    return state;
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
  EXPECT_THAT(fixation->reason, HasSubstr("0.300"));
  EXPECT_EQ(fixation->views, 0);
  EXPECT_TRUE(std::isnan(fixation->pixel_1.x()));
  EXPECT_EQ(dut.commands, 0);
}

TEST(Cycle, AHeadThatPassesItsGoalAndRestsElsewhereIsAFault) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  std::optional<std::int64_t> there_us;
  dut.measured = [&](geometry::HeadState state) {
    if (dut.cycle.state() == CycleState::relooking && !there_us) there_us = state.utime_us;
    if (there_us) state.measured.yaw_rad = 0.5;
    return state;
  };
  dut.seen = [&](const geometry::Frame& frame) {
    // No frame falls into the moment at the goal.
    return there_us || dut.commands == 0 ? frame : geometry::Frame{frame.image, 0};
  };
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::head_fault);
  EXPECT_EQ(fixation->views, 1);
  EXPECT_FALSE(std::isnan(fixation->pixel_1.x()));
}

TEST(Cycle, SilenceOfTheHeadIsAHeadFault) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  const auto fault = dut.cycle.on_silence({0.0, 2.0, "", "angle is NaN"}).fixation;
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, Status::head_fault);
  EXPECT_THAT(fault->reason, HasSubstr("angle is NaN"));
}

TEST(Cycle, GoesOnWhenTheFaultIsOver) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  ASSERT_TRUE(dut.cycle.on_silence({2.5, 0.0, "", ""}).fixation);
  EXPECT_EQ(dut.run()->status, Status::located);
  ASSERT_TRUE(dut.cycle.on_silence({0.0, 2.5, "", ""}).fixation);
  dut.robot->next_test();
  EXPECT_EQ(dut.run()->status, Status::located);
}

TEST(Cycle, AFaultInTheMiddleOfALookCounts) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  dut.obeys = false;
  EXPECT_FALSE(dut.run(1.0));
  ASSERT_EQ(dut.cycle.state(), CycleState::turning);
  const auto fault = dut.cycle.on_silence({2.0, 0.0, "", ""}).fixation;
  ASSERT_TRUE(fault);
  EXPECT_TRUE(fault->counts);
  EXPECT_EQ(fault->views, 1);
}

// Planned looks have the target at the ends of the frame: where the head stayed there, the next
// fixation would find another object or none.
TEST(Cycle, ASilenceAmidManyLooksSendsTheHeadBackToItsFirstLook) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = 6;
  constexpr Silence of_camera{2.5, 0.0, "", "", 2.5}, of_head{0.0, 2.5, "", "", 2.5};
  for (const Silence& silence : {of_camera, of_head}) {
    SimulatedHead dut(report_test_1, setup);
    std::vector<geometry::HeadAngles> sent;
    dut.commanded = [&sent](const geometry::HeadCommand& command) {
      sent.push_back(command.target);
    };
    int looks = 0;
    dut.looked = [&looks](const UsedSaliency&) { ++looks; };
    while (looks < 3) ASSERT_FALSE(dut.run(0.02));
    ASSERT_TRUE(dut.cycle.on_silence(silence).fixation);
    // A second one on the way back must not leave the head there.
    ASSERT_FALSE(dut.run(0.02));
    (void)dut.cycle.on_silence(silence);
    const std::size_t sent_before = sent.size();
    const auto next = dut.run();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->status, Status::located) << next->reason;
    ASSERT_GT(sent.size(), sent_before);
    EXPECT_EQ(geometry::greatest_difference(sent[sent_before], sent.front()), 0.0);
    constexpr double arrived_rad = 0.02;
    EXPECT_LT(geometry::greatest_difference(next->head_1, sent.front()), arrived_rad);
  }
}

}  // namespace
}  // namespace gazed::cycle::faults_test
