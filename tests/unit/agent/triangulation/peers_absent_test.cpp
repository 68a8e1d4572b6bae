// Stands in for the tests that need OpenCV's calib3d, features2d and imgcodecs.
#include <gtest/gtest.h>

TEST(Peer, CorrectMatchesChessboardAndTemple) {
  GTEST_SKIP() << "built without OpenCV calib3d (Debian: libopencv-calib3d-dev, "
                  "libopencv-imgcodecs-dev)";
}
