#include "agent/base/nearest.hpp"

#include <gtest/gtest.h>

namespace gazed::base::nearest_test {
namespace {

TEST(Nearest, CountsEdits) {
  Nearest nearest("--fixatoin");
  nearest.offer("", "nothing");
  nearest.offer("--seed", "--seed");
  nearest.offer("--fixations", "--fixations");
  nearest.offer("--profile", "--profile");
  EXPECT_EQ(nearest.result(), "--fixations");
}

TEST(Nearest, WhatIsLikeNothingHasNoNearest) {
  Nearest nearest("colour_temperature");
  nearest.offer("gain", "gain");
  nearest.offer("exposure", "exposure");
  EXPECT_EQ(nearest.result(), "");
  EXPECT_EQ(nearest.clause(), "");
  nearest.offer("colour_temperture", "that");
  EXPECT_EQ(nearest.clause(), "; the nearest known is that");
}

}  // namespace
}  // namespace gazed::base::nearest_test
