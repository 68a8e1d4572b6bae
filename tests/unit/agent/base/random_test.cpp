#include "agent/base/random.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numbers>

namespace gazed::base::random_test {
namespace {

TEST(Random, SameSeedAndStreamGiveTheSameNumbers) {
  Random a(7, 3), b(7, 3), other_stream(7, 4), other_seed(8, 3);
  const std::uint64_t first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, other_stream.bits());
  EXPECT_NE(first, other_seed.bits());
}

TEST(Random, MomentsOfUniformAndNormal) {
  Random random(1, 1);
  constexpr int n = 200'000;
  constexpr double five_sigma = 5.0 / 447.2;  // of a mean of n standard values
  double uniform = 0.0, sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    uniform += u;
    const double g = random.normal();
    ASSERT_TRUE(std::isfinite(g));
    sum += g;
    squares += g * g;
  }
  EXPECT_NEAR(uniform / n, 0.5, five_sigma / std::sqrt(12.0));
  EXPECT_NEAR(sum / n, 0.0, five_sigma);
  EXPECT_NEAR(squares / n, 1.0, std::sqrt(2.0) * five_sigma);
}

/// Each number next to what the C library has for it.
TEST(Random, NormalIsBoxAndMullers) {
  Random random(11, 5), uniform(11, 5);
  for (int i = 0; i < 10'000; ++i) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform.uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform.uniform();
    EXPECT_NEAR(random.normal(), radius * std::cos(angle), 1e-14);
    EXPECT_NEAR(random.normal(), radius * std::sin(angle), 1e-14);
  }
}

/// On whatever machine this runs.
TEST(Random, NormalHasTheSameBitsEverywhere) {
  Random random(3, 4);
  std::uint64_t hash = 0;
  for (int i = 0; i < 100'000; ++i) {
    hash ^= std::bit_cast<std::uint64_t>(random.normal());
    hash = split_mix(hash);
  }
  EXPECT_EQ(hash, 0x426209448cfd73d1U);
}

}  // namespace
}  // namespace gazed::base::random_test
