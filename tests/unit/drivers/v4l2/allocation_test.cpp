// A frame allocates nothing.
#include <gtest/gtest.h>
#include <string>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/allocations.hpp"
#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::allocation_test {
namespace {

TEST(V4l2Allocation, NoneForAFrame) {
  FakeCamera kernel;
  VideoSystem system = kernel.system();
  long by_the_kernel = 0;  // the played one
  system.ioctl = [&, plain = system.ioctl](int descriptor, unsigned long request, void* argument) {
    const long before = test::allocations();
    const int result = plain(descriptor, request, argument);
    by_the_kernel += test::allocations() - before;
    return result;
  };
  V4l2Camera dut{{.device = "/dev/video0"}, system};
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot();
  EXPECT_TRUE(dut.next_frame());
  for (int i = 0; i < 100; ++i) {
    const Shot damaged{.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR};
    if (i % 4 == 0) kernel.shoot(damaged);
    kernel.shoot();
    kernel.shoot();
    by_the_kernel = 0;
    const long before = test::allocations();
    const bool frame = dut.next_frame().has_value();
    const bool again = dut.next_frame().has_value();
    const std::string fault = dut.health().words, warning = dut.warning();
    const long after = test::allocations();
    EXPECT_TRUE(frame && !again && fault.empty() && warning.empty());
    // The first damaged one is put into words.
    const bool first = i == 0;
    EXPECT_TRUE(first || after - before == by_the_kernel) << i;
  }
}

}  // namespace
}  // namespace gazed::v4l2::allocation_test
