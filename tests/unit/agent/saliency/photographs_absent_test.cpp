// Stands in for the tests that decode photographs.
#include <gtest/gtest.h>

TEST(Photographs, AreNotDecoded) {
  GTEST_SKIP()
      << "built without OpenCV imgcodecs (Debian: libopencv-imgcodecs-dev), which a robot's "
         "sysroot does not hold";
}
