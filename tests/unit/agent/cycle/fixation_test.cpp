// What a fixation says of itself, held to the maps and the head states that it was made of.
#include "agent/cycle/fixation.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::fixation_test {
namespace {

/// The maps that were used for a fixation, whose samples are gone by now.
struct SeenFixation {
  explicit SeenFixation(const Parts& parts) : dut(report_test_1, parts) {
    dut.looked = [this](const UsedSaliency& used) { maps.push_back(used); };
    dut.measured = [this](const geometry::HeadState& state) {
      states.push_back(state);
      return state;
    };
    fixation = dut.run();
  }
  [[nodiscard]] geometry::HeadAngles head_at(std::int64_t utime_us) const {
    for (std::size_t i = 1; i < states.size(); ++i) {
      if (states[i].utime_us < utime_us) continue;
      const double share = static_cast<double>(utime_us - states[i - 1].utime_us) /
                           static_cast<double>(states[i].utime_us - states[i - 1].utime_us);
      const geometry::HeadAngles move = states[i].measured - states[i - 1].measured;
      return states[i - 1].measured +
             geometry::HeadAngles{share * move.yaw_rad, share * move.pitch_rad};
    }
    return {NAN, NAN};
  }

  SimulatedHead dut;
  std::vector<UsedSaliency> maps;
  std::vector<geometry::HeadState> states;
  std::optional<Fixation> fixation;
};

constexpr double interpolation_tolerance_rad = 1e-12;

TEST(Fixation, TellsWhatWasSeenAndFromWhere) {
  const SeenFixation seen(calibrated_nao_v6());
  ASSERT_TRUE(seen.fixation);
  ASSERT_EQ(seen.maps.size(), 2U);
  const UsedSaliency &first = seen.maps[0], &second = seen.maps[1];
  EXPECT_TRUE(first.first_view);
  EXPECT_FALSE(second.first_view);
  const Fixation& fixation = *seen.fixation;
  EXPECT_EQ(fixation.utime_us, second.utime_us);
  EXPECT_EQ(fixation.saliency, first.result.saliency);
  EXPECT_EQ(fixation.distinctness, first.result.distinctness);
  EXPECT_NE(fixation.saliency, fixation.distinctness);
  constexpr double object_px = 64.0;
  EXPECT_LT((fixation.pixel_1 - first.result.peak_px).norm(), object_px);
  EXPECT_LT((fixation.pixel_2 - second.result.peak_px).norm(), object_px);
  EXPECT_GT((fixation.pixel_2 - fixation.pixel_1).norm(), object_px);
  EXPECT_LT(geometry::greatest_difference(fixation.head_1, seen.head_at(first.utime_us)),
            interpolation_tolerance_rad);
  EXPECT_LT(geometry::greatest_difference(fixation.head_2, seen.head_at(second.utime_us)),
            interpolation_tolerance_rad);
  EXPECT_DOUBLE_EQ(fixation.duration_s,
                   1e-6 * static_cast<double>(second.utime_us - first.utime_us));
}

TEST(Fixation, WithoutAnObjectTellsWhatWasSeenLast) {
  Parts parts = calibrated_nao_v6();
  parts.cycle.saliency.distinctness_min = 1.0;
  const SeenFixation seen(parts);
  ASSERT_TRUE(seen.fixation);
  ASSERT_EQ(seen.maps.size(), 1U);
  const UsedSaliency& last = seen.maps[0];
  const Fixation& fixation = *seen.fixation;
  EXPECT_EQ(fixation.views, 1);
  EXPECT_EQ(fixation.utime_us, last.utime_us);
  EXPECT_EQ(fixation.saliency, last.result.saliency);
  EXPECT_EQ(fixation.distinctness, last.result.distinctness);
  EXPECT_NE(fixation.saliency, fixation.distinctness);
  EXPECT_LT(geometry::greatest_difference(fixation.head_1, seen.head_at(last.utime_us)),
            interpolation_tolerance_rad);
}

}  // namespace
}  // namespace gazed::cycle::fixation_test
