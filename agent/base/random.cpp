#include "agent/base/random.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gazed::base {

namespace {

/// c0 + c1 z + c2 z^2 + ...
template <std::size_t count>
double polynomial(const std::array<double, count>& coefficients, double z) {
  double sum = 0.0;
  for (std::size_t i = count; i-- > 0;) sum = coefficients[i] + z * sum;
  return sum;
}

// The series below go as far as a double can tell.

/// The logarithm of x > 0, as 2 artanh((m - 1) / (m + 1)) of the mantissa m.
double logarithm(double x) {
  constexpr std::array<double, 11> by_odd{1.0,        1.0 / 3.0,  1.0 / 5.0,  1.0 / 7.0,
                                          1.0 / 9.0,  1.0 / 11.0, 1.0 / 13.0, 1.0 / 15.0,
                                          1.0 / 17.0, 1.0 / 19.0, 1.0 / 21.0};
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.5 * std::numbers::sqrt2) {
    mantissa *= 2.0;
    --exponent;
  }
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  return exponent * std::numbers::ln2 + 2.0 * s * polynomial(by_odd, s * s);
}

template <std::size_t count>
constexpr std::array<double, count> alternating_factorials(int first) {
  std::array<double, count> coefficients{};
  double factorial = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    coefficients[i] = (i % 2 == 0 ? 1.0 : -1.0) / factorial;
    const int n = first + 2 * static_cast<int>(i);
    factorial *= (n + 1.0) * (n + 2.0);
  }
  return coefficients;
}

struct Direction {
  double cosine, sine;
};

/// At a share of the whole turn, in [0, 1).
Direction direction_at(double share) {
  constexpr auto of_sine = alternating_factorials<9>(1), of_cosine = alternating_factorials<9>(0);
  const int quarter = static_cast<int>(4.0 * share + 0.5);
  const double angle = 2.0 * std::numbers::pi * (share - 0.25 * quarter);  // within an eighth turn
  const double cosine = polynomial(of_cosine, angle * angle);
  const double sine = angle * polynomial(of_sine, angle * angle);
  switch (quarter % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

std::uint64_t scrambled(std::uint64_t x) {
  return split_mix(x);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : engine_(scrambled(scrambled(seed) + stream)) {}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * logarithm(1.0 - uniform()));
  const Direction direction = direction_at(uniform());
  spare_ = radius * direction.sine;
  has_spare_ = true;
  return radius * direction.cosine;
}

}  // namespace gazed::base
