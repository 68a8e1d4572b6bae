#include "drivers/sim/course.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace gazed::sim::course_test {
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

TEST(Course, PerspectiveIsWithinTheErrorThatIsSaid) {
  // One unit is about a pixel: a plane at 60 degrees, going away and coming nearer, as a camera
  // with a focal length of 550 px sees it in 16 px.
  constexpr double said_px = 0.06 * (1.732 * 15 / 550) * (1.732 * 15 / 550) * 16, chord_px = 0.1;
  for (const double shrinks : {1.732 / 550, -1.732 / 550}) {
    const auto value = [&](double i) { return i / (1.0 + shrinks * i); };
    Course course(value(0), value(7), value(15), 15);
    for (int i = 0; i <= 15; ++i)
      EXPECT_NEAR(course.next() / one, value(i), said_px + tolerance) << i;
    EXPECT_GT(std::abs(value(7.5) - 0.5 * value(15)), chord_px) << "else a line would do";
  }
}

TEST(Course, ValuesThatAreNoPlacesAreHeld) {
  for (const double value : {1e300, -1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    Course course(value, 0.0, -value, 15);
    EXPECT_EQ(course.next(), 0) << "2^24 modulo 2^16";
    for (int i = 1; i <= 15; ++i) static_cast<void>(course.next());  // defined: sanitizers watch
  }
}

}  // namespace
}  // namespace gazed::sim::course_test
