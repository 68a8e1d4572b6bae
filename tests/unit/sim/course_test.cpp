#include "drivers/sim/course.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace gazed::course_test {
namespace {

constexpr double one = 1 << 16;  // next() is Q15.16
// Rounding down to Q15.16, and what steps of Q31.32 lose in a run.
constexpr double tolerance = 1.1 / one;

TEST(Course, AQuadraticIsFollowedInRunsOfAnyLength) {
  const auto value = [](double i) { return 100.25 - 3.7 * i + 0.031 * i * i; };
  for (int last = 1; last <= 31; ++last) {
    Course course(value(0), value(last / 2), value(last), last);
    for (int i = 0; i <= last; ++i)
      EXPECT_NEAR(course.next() / one, value(i), tolerance) << i << " of " << last;
  }
}

TEST(Course, WhatStandsStillStandsStill) {
  Course course(-2.5);
  for (int i = 0; i < 32; ++i) EXPECT_EQ(course.next(), -2.5 * one);
}

TEST(Course, PerspectiveIsWithinAFewThousandthsOfAPixel) {
  // One unit is about a pixel: a plane at 60 degrees, as a camera with a focal length of 550 px
  // sees it in 16 px.
  constexpr double shrinks = 1.732 / 550.0, least = 0.002, quadratic = 0.003;
  const auto value = [](double i) { return i / (1.0 + shrinks * i); };
  Course course(value(0), value(7), value(15), 15);
  double worst = 0.0;
  for (int i = 0; i <= 15; ++i) worst = std::max(worst, std::abs(course.next() / one - value(i)));
  EXPECT_LT(worst, quadratic);
  EXPECT_LT(value(15) - 15.0, -least) << "else a line would do";
}

TEST(Course, ValuesThatAreNoPlacesAreHeld) {
  for (const double value : {1e300, -1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    Course course(value, 0.0, -value, 15);
    for (int i = 0; i <= 15; ++i) static_cast<void>(course.next());
  }
}

}  // namespace
}  // namespace gazed::course_test
