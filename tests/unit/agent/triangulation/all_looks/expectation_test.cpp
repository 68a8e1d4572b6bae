// What one more look is expected to be worth, held to what it is worth.
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <optional>
#include <span>

#include "agent/triangulation/all_looks/locate.hpp"

#include "tests/unit/agent/triangulation/rooms.hpp"

namespace gazed::triangulation::all_looks::expectation_test {
namespace {

Room exact_room(std::size_t features, bool torso_may_move) {
  Random random(71);
  RoomModel model{.looks = 6, .range_m = 0.6, .features = features};
  model.torso_may_move = torso_may_move;
  model.exact = true;
  return random_room(model, random);
}

Estimate first_looks(const Room& room, std::size_t count, const NextLook& next = {}) {
  return locate(room.rig, std::span(room.looks).first(count), room.features, {}, next);
}

/// Expected of the look after `count`, over what came of it.
double expected_over_found(const Room& room, std::size_t count) {
  const Estimate now = first_looks(
      room, count, [&](const Estimate&) { return std::optional(room.looks[count].head); });
  return now.expected_sigma_per_m / first_looks(room, count + 1).point.inverse_range_sigma_per_m;
}

TEST(ExpectedSigma, IsThatOfTheNextLook) {
  for (const bool torso_may_move : {false, true}) {
    for (const std::size_t features : {0U, 100U}) {
      const Room room = exact_room(features, torso_may_move);
      for (std::size_t count = 2; count < 6; ++count) {
        EXPECT_NEAR(expected_over_found(room, count), 1.0, 0.1)
            << count << " looks, " << features << " features" << (torso_may_move ? ", torso" : "");
      }
    }
  }
}

TEST(ExpectedSigma, AsksWithWhatTheLooksSoFarTell) {
  const Room room = exact_room(100, false);
  double asked_with_m = 0.0;
  const Estimate found = first_looks(room, 4, [&](const Estimate& so_far) {
    asked_with_m = so_far.point.range_m;
    return std::optional<geometry::HeadAngles>();
  });
  EXPECT_EQ(asked_with_m, found.point.range_m);
  EXPECT_TRUE(std::isnan(found.expected_sigma_per_m));
}

TEST(ExpectedSigma, ChangesNothingElse) {
  const Room room = exact_room(100, true);
  const Estimate with =
      first_looks(room, 4, [&](const Estimate&) { return std::optional(room.looks[4].head); });
  const Estimate without = first_looks(room, 4);
  EXPECT_EQ(with.point.range_m, without.point.range_m);
  EXPECT_EQ(with.point.inverse_range_sigma_per_m, without.point.inverse_range_sigma_per_m);
  EXPECT_TRUE(std::isnan(without.expected_sigma_per_m));
}

TEST(ExpectedSigma, IsNoneWhereTheTargetWouldNotBeSeen) {
  const Room room = exact_room(100, false);
  const Estimate found = first_looks(room, 4, [&](const Estimate&) {
    return std::optional(room.looks[0].head + geometry::HeadAngles{1.5, 0.0});
  });
  EXPECT_TRUE(std::isnan(found.expected_sigma_per_m));
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::expectation_test
