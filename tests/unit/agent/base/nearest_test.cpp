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

}  // namespace
}  // namespace gazed::base::nearest_test
