#include "agent/saliency/low_pass.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency::low_pass_test {
namespace {

class LowPass : public testing::Test {
 protected:
  std::int32_t& at(int x, int y) { return plane.view().row(y)[x]; }
  void filter() { low_pass(plane.view(), scratch.view()); }

  OwnedPlane<std::int32_t> plane{10, 8}, scratch{10, 8};
};

TEST_F(LowPass, ASampleBecomesTheFilter) {
  at(5, 4) = 256;
  filter();
  EXPECT_EQ(at(5, 4), 36);
  EXPECT_EQ(at(4, 4), 24);
  EXPECT_EQ(at(5, 6), 6);
  EXPECT_EQ(at(7, 6), 1);
  EXPECT_EQ(at(8, 4), 0);
}

TEST_F(LowPass, AFlatPlaneStaysUpToItsBorder) {
  fill(plane.view(), std::int32_t{(1 << 27) - 1});  // the largest that is allowed
  filter();
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 10; ++x) EXPECT_EQ(at(x, y), (1 << 27) - 1) << x << ',' << y;
}

TEST_F(LowPass, TheBorderIsReflectedWithoutItsLastSample) {
  at(1, 0) = 256;
  filter();
  EXPECT_EQ(at(0, 0), 8 * 6);        // 4 + 4 across, 6 down
  EXPECT_EQ(at(1, 0), (6 + 1) * 6);  // its own, and its reflection's two columns away
  EXPECT_EQ(at(0, 1), 8 * 4);
}

TEST(LowPassOfOneColumn, IsFilteredDownwards) {
  OwnedPlane<std::int32_t> plane(1, 5), scratch(1, 5);
  plane.view().row(2)[0] = 16;
  low_pass(plane.view(), scratch.view());
  EXPECT_EQ(plane.view().row(2)[0], 6);
  EXPECT_EQ(plane.view().row(0)[0], 2);  // 1, and 1 reflected
}

}  // namespace
}  // namespace gazed::saliency::low_pass_test
