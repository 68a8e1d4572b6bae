#include "drivers/sim/random.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace gazed::sim::random_test {
namespace {

TEST(RandomStream, SameSeedAndStreamGiveTheSameNumbers) {
  RandomStream a(7, 3), b(7, 3), other_stream(7, 4), other_seed(8, 3);
  const std::uint64_t first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, other_stream.bits());
  EXPECT_NE(first, other_seed.bits());
}

TEST(RandomStream, MomentsOfUniformAndGaussian) {
  RandomStream random(1, 1);
  constexpr int n = 200'000;
  constexpr double five_sigma = 5.0 / 447.2;  // of a mean of n standard values
  double uniform = 0.0, sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    uniform += u;
    const double g = random.gaussian();
    ASSERT_TRUE(std::isfinite(g));
    sum += g;
    squares += g * g;
  }
  EXPECT_NEAR(uniform / n, 0.5, five_sigma / std::sqrt(12.0));
  EXPECT_NEAR(sum / n, 0.0, five_sigma);
  EXPECT_NEAR(squares / n, 1.0, std::sqrt(2.0) * five_sigma);
}

}  // namespace
}  // namespace gazed::sim::random_test
