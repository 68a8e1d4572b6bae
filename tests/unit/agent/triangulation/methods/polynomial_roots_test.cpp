#include "agent/triangulation/methods/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "agent/base/random.hpp"

namespace gazed::triangulation::methods::polynomial_roots_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The polynomial with these roots, of which the complex ones come in pairs.
Polynomial with_roots(const std::vector<std::complex<double>>& roots, double leading) {
  std::vector<std::complex<double>> product{leading};
  for (const std::complex<double>& root : roots) {
    product.insert(product.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < product.size(); ++k) product[k] -= root * product[k + 1];
  }
  Polynomial g{};
  for (std::size_t k = 0; k < product.size(); ++k) g[k] = product[k].real();
  return g;
}

std::vector<double> sorted_real_parts(const Polynomial& g, double negligible = epsilon) {
  const RealParts found = real_parts_of_roots(g, negligible);
  std::vector<double> all(found.values().begin(), found.values().end());
  std::ranges::sort(all);
  return all;
}

TEST(PolynomialRoots, RealOnesAndPairs) {
  EXPECT_THAT(sorted_real_parts(with_roots({1, 2, 3, 4, 5, 6}, 0.5)),
              Pointwise(DoubleNear(1e-9), {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
  EXPECT_THAT(sorted_real_parts(with_roots({{0.5, 2}, {0.5, -2}, -1}, 1)),
              Pointwise(DoubleNear(1e-12), {-1.0, 0.5, 0.5}));
  EXPECT_THAT(sorted_real_parts({-6, 2}), ElementsAre(3));
}

TEST(PolynomialRoots, SmallOnesBesideLargeOnesKeepTheirDigits) {
  const std::vector<double> found = sorted_real_parts(with_roots({1e-6, 2e-6, 1e3, 3e3}, 1));
  EXPECT_THAT(found, Pointwise(testing::DoubleNear(1e-15), {1e-6, 2e-6, found[2], found[3]}));
  EXPECT_NEAR(found[2], 1e3, 1e-8);
}

// Ordinary shifts leave it as it is.
TEST(PolynomialRoots, RootsOfOneNeedAnotherShift) {
  const double cosine = 0.5;
  EXPECT_THAT(sorted_real_parts({-1, 0, 0, 0, 0, 0, 1}),
              Pointwise(DoubleNear(1e-12), {-1.0, -cosine, -cosine, cosine, cosine, 1.0}));
  EXPECT_THAT(sorted_real_parts({1, 0, 1}), Pointwise(DoubleNear(1e-12), {0.0, 0.0}));
}

TEST(PolynomialRoots, ManyAtOnePlaceAreRightToTheirShareOfTheDigits) {
  EXPECT_THAT(sorted_real_parts(with_roots({0.5, 0.5, 0.5}, 1)),
              Pointwise(DoubleNear(1e-4), {0.5, 0.5, 0.5}));
  EXPECT_THAT(sorted_real_parts({0, 0, 0, 1}), ElementsAre(0, 0, 0));
}

TEST(PolynomialRoots, ANegligibleLeadingCoefficientIsDropped) {
  EXPECT_EQ(sorted_real_parts({-1, 2, 1e-12}, 1e-10), std::vector{0.5});
  EXPECT_EQ(sorted_real_parts({-1, 2, 1e-12}, 1e-14).size(), 2U);
}

TEST(PolynomialRoots, OfWhatHasNone) {
  EXPECT_EQ(real_parts_of_roots({}, epsilon).count, 0);
  EXPECT_EQ(real_parts_of_roots({3}, epsilon).count, 0);
  EXPECT_EQ(real_parts_of_roots({1, std::nan("")}, epsilon).count, 0);
  EXPECT_EQ(real_parts_of_roots({1, INFINITY}, epsilon).count, 0);
}

TEST(PolynomialRoots, OfRandomOnesAllAreFound) {
  base::Random random(5, 1);
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<std::complex<double>> roots;
    std::vector<double> real_parts;
    while (roots.size() < 5) {
      const std::complex<double> root{random.uniform(-1, 1), random.uniform(0.1, 1)};
      const bool pair = random.uniform(0, 1) < 0.5;
      if (pair)
        roots.insert(roots.end(), {root, std::conj(root)});
      else
        roots.emplace_back(root.real());
    }
    for (const auto& root : roots) real_parts.push_back(root.real());
    std::ranges::sort(real_parts);
    // Two that nearly meet are known to half of the digits.
    EXPECT_THAT(sorted_real_parts(with_roots(roots, random.uniform(0.1, 10))),
                Pointwise(DoubleNear(1e-5), real_parts))
        << trial;
  }
}

}  // namespace
}  // namespace gazed::triangulation::methods::polynomial_roots_test
