#include "drivers/naoqi/motion.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "agent/geometry/limits.hpp"
#include "drivers/head_guard.hpp"

#include "tests/unit/trials.hpp"

namespace gazed::naoqi::motion_test {
namespace {

// Between 2 and 4 two reals of 32 bits are 2^-22 apart.
constexpr double float_step_rad = 2.4e-7;

/// What a robot reads out of the arguments of setAngles().
struct Read {
  geometry::HeadAngles target;
  double speed_fraction = 0.0;
};

Read read_back(QiBytes arguments) {
  QiReader reader(arguments, "mmf");
  reader.next();
  const auto angles = per_joint({reader.next(), {}});
  const QiValue speed = reader.next();
  EXPECT_TRUE(reader.rest().empty());
  return {{static_cast<double>(angles.value()[0]), static_cast<double>(angles.value()[1])},
          speed.number().value()};
}

/// Of any size, often near a limit or none at all.
double any_number(std::mt19937_64& random) {
  switch (random() % 8) {
    case 0:
      return std::bit_cast<double>(random());  // any bits: infinities, NaN, denormal
    case 1:
      return geometry::HeadLimits::break_yaws_rad()[random() %
                                                    geometry::HeadLimits::break_yaws_rad().size()];
    case 2:
      return std::array{2.08567, -2.08567, -0.671952, 0.514872, 0.0, 1.0}[random() % 6];
    default:
      return 8.0 * (static_cast<double>(random()) / 18446744073709551616.0 - 0.5);
  }
}

TEST(SetAngles, WhateverIsCommandedStaysInTheTableAndUnderFullSpeed) {
  std::mt19937_64 random(7);
  const geometry::HeadLimits table;
  int sent = 0;
  for (int i = 0; i < test::trials(1'000'000, 20'000); ++i) {
    const geometry::HeadCommand command{
        0, {any_number(random), any_number(random)}, any_number(random)};
    const auto admitted = drivers::admit(command);
    if (!admitted) continue;
    ++sent;
    QiWriter arguments;
    write_set_angles(arguments, admitted->target, admitted->speed_fraction);
    const Read read = read_back(arguments.bytes());
    ASSERT_TRUE(table.contains(read.target)) << read.target.yaw_rad << ' ' << read.target.pitch_rad;
    ASSERT_TRUE(read.speed_fraction >= 0.0 && read.speed_fraction <= 1.0);
    // And an allowed command is what it was, as near as 32 bits are.
    if (table.contains(command.target)) {
      ASSERT_LT(geometry::greatest_difference(read.target, command.target), float_step_rad);
    }
  }
  EXPECT_GT(sent, test::trials(300'000, 6'000));
}

}  // namespace
}  // namespace gazed::naoqi::motion_test
