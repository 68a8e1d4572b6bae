// Cameras that are not there, go away, or do not deliver: told, and tried again for ever.
#include <cstdint>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::recovery_test {
namespace {

using ::testing::HasSubstr;

class V4l2Recovery : public testing::Test {
 protected:
  ~V4l2Recovery() override { EXPECT_THAT(kernel.misuse, testing::IsEmpty()); }

  void expect_closed() const {
    EXPECT_EQ(dut.descriptor(), -1);
    EXPECT_TRUE(kernel.descriptors.empty());
    EXPECT_TRUE(kernel.mappings.empty());
  }

  /// Calls as the loop does, and counts how often the device was opened meanwhile.
  int openings_in(double seconds) {
    const int before = kernel.opened;
    for (double t = 0.0; t < seconds; t += loop_s) {
      static_cast<void>(dut.next_frame());
      kernel.pass(loop_s);
    }
    return kernel.opened - before;
  }

  bool opens_within(double seconds) {
    for (double t = 0.0; t < seconds; t += loop_s) {
      if (openings_in(loop_s) > 0) return true;
    }
    return false;
  }

  bool frame_comes() {
    kernel.shoot();
    return dut.next_frame().has_value();
  }

  static constexpr double loop_s = 0.01;
  FakeCamera kernel;
  V4l2Camera dut{{.device = "/dev/video0"}, kernel.system()};
};

TEST_F(V4l2Recovery, ASlowCameraIsOpenedInStepsBetweenWhichTheLoopGoesOn) {
  kernel.lie = [this](unsigned long, void*) { kernel.pass(0.4); };
  constexpr double longest_step_s = 4.0;  // of any: ten requests
  int calls = 0;
  while (!kernel.streaming && calls < 100) {
    const std::int64_t before_us = kernel.monotonic_us;
    EXPECT_FALSE(dut.next_frame());
    EXPECT_LE(kernel.monotonic_us - before_us, 1e6 * longest_step_s);
    ++calls;
  }
  EXPECT_GE(calls, 3);
  EXPECT_EQ(kernel.opened, 1);
  kernel.lie = {};
  EXPECT_TRUE(frame_comes());
}

TEST_F(V4l2Recovery, NoCameraAtTheStartIsWaitedFor) {
  kernel.present = false;
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(dut.health().words,
            "/dev/video0: no such device; is the camera connected, and its kernel "
            "module loaded?");
  expect_closed();
  static_cast<void>(openings_in(60.0));
  kernel.present = true;
  EXPECT_TRUE(opens_within(2.1));
  EXPECT_TRUE(frame_comes());
  EXPECT_EQ(dut.health().words, "");
  EXPECT_EQ(dut.notes(), "");  // it was never lost
}

TEST_F(V4l2Recovery, TriesAreATenthOfASecondApartAndThenTwoSeconds) {
  kernel.open_error = EIO;
  std::vector<double> tries_s;
  // Tries that do not get as far as a descriptor are seen by the path.
  for (int i = 0; i < 1000; ++i) {
    kernel.path.clear();
    static_cast<void>(dut.next_frame());
    if (!kernel.path.empty()) tries_s.push_back(loop_s * i);
    kernel.pass(loop_s);
  }
  ASSERT_GE(tries_s.size(), 7U);
  const std::vector<double> expected_s{0.0, 0.1, 0.3, 0.7, 1.5, 3.1, 5.1, 7.1, 9.1};
  ASSERT_EQ(tries_s.size(), expected_s.size());
  for (std::size_t i = 0; i < tries_s.size(); ++i)
    EXPECT_NEAR(tries_s[i], expected_s[i], 1.5 * loop_s * static_cast<double>(i + 1));
}

TEST_F(V4l2Recovery, UnpluggedInMidStreamAndBack) {
  EXPECT_FALSE(dut.next_frame());
  EXPECT_TRUE(frame_comes());
  kernel.present = false;
  EXPECT_FALSE(dut.next_frame());
  EXPECT_THAT(dut.health().words, HasSubstr("the camera is gone"));
  EXPECT_EQ(dut.health().kind, drivers::HealthKind::lost);
  expect_closed();
  EXPECT_EQ(openings_in(5.0), 0);
  EXPECT_EQ(dut.notes(), "");
  kernel.present = true;
  EXPECT_TRUE(opens_within(2.1));
  EXPECT_THAT(dut.health().words, HasSubstr("no such device"));  // until a frame comes
  EXPECT_TRUE(frame_comes());
  EXPECT_EQ(dut.health().words, "");
  EXPECT_THAT(dut.notes(), HasSubstr("opened again 1 time"));
}

TEST_F(V4l2Recovery, TheGapOfAnAbsenceIsNotCountedAsFrames) {
  EXPECT_FALSE(dut.next_frame());
  EXPECT_TRUE(frame_comes());
  kernel.present = false;
  EXPECT_FALSE(dut.next_frame());
  kernel.present = true;
  kernel.sequence = 1000;
  EXPECT_EQ(openings_in(1.0), 1);
  EXPECT_TRUE(frame_comes());
  EXPECT_EQ(dut.health().dropped, 0);
}

TEST_F(V4l2Recovery, AStreamThatDoesNotStartIsTriedAgain) {
  kernel.errors[VIDIOC_STREAMON] = {EIO, ENOSPC};
  EXPECT_FALSE(dut.next_frame());
  EXPECT_THAT(dut.health().words, HasSubstr("VIDIOC_STREAMON: Input/output error"));
  expect_closed();
  EXPECT_EQ(openings_in(0.11), 1);
  EXPECT_THAT(dut.health().words, HasSubstr("not enough bandwidth on the USB bus"));
  EXPECT_EQ(openings_in(0.3), 1);
  EXPECT_TRUE(frame_comes());
}

TEST_F(V4l2Recovery, AnErrorOfAnyCallIsNamedAndTriedAgain) {
  for (const auto& [request, name] :
       std::map<unsigned long, std::string>{{VIDIOC_QUERYCAP, "VIDIOC_QUERYCAP"},
                                            {VIDIOC_S_FMT, "was asked for"},
                                            {VIDIOC_REQBUFS, "VIDIOC_REQBUFS"},
                                            {VIDIOC_QUERYBUF, "VIDIOC_QUERYBUF"},
                                            {VIDIOC_QBUF, "VIDIOC_QBUF"},
                                            {VIDIOC_STREAMON, "VIDIOC_STREAMON"},
                                            {VIDIOC_DQBUF, "VIDIOC_DQBUF"}}) {
    V4l2Camera camera{{.device = "/dev/video1"}, kernel.system()};
    kernel.errors[request] = {EIO};
    EXPECT_FALSE(camera.next_frame());
    EXPECT_THAT(camera.health().words, HasSubstr(name));
    EXPECT_THAT(camera.health().words, HasSubstr("Input/output error"));
    EXPECT_TRUE(kernel.descriptors.empty() && kernel.mappings.empty()) << name;
    kernel.pass(0.2);
    EXPECT_FALSE(camera.next_frame());
    kernel.shoot();
    EXPECT_TRUE(camera.next_frame()) << name;
  }
}

TEST_F(V4l2Recovery, ABufferThatCannotBeMappedIsTold) {
  VideoSystem system = kernel.system();
  system.map = [](std::size_t, int, std::int64_t) -> void* {
    errno = ENOMEM;
    return nullptr;
  };
  V4l2Camera camera{{.device = "/dev/video1"}, system};
  EXPECT_FALSE(camera.next_frame());
  EXPECT_THAT(camera.health().words, HasSubstr("mmap: Cannot allocate memory"));
  EXPECT_TRUE(kernel.descriptors.empty());
}

TEST_F(V4l2Recovery, SilenceIsALostCamera) {
  EXPECT_FALSE(dut.next_frame());
  EXPECT_TRUE(frame_comes());
  EXPECT_EQ(openings_in(1.95), 0);
  EXPECT_EQ(dut.health().words, "");
  EXPECT_EQ(openings_in(0.3), 1);
  EXPECT_EQ(dut.health().words, "/dev/video0: no frame for 2.0 s");
  EXPECT_EQ(dut.health().kind, drivers::HealthKind::no_data);
  EXPECT_TRUE(frame_comes());
  EXPECT_EQ(dut.health().words, "");
}

TEST_F(V4l2Recovery, NothingButDamagedFramesIsSilence) {
  EXPECT_FALSE(dut.next_frame());
  for (int i = 0; i < 60; ++i) {
    kernel.pass(1.0 / 30.0);
    kernel.shoot({.missing_bytes = 600'000});
    EXPECT_FALSE(dut.next_frame());
  }
  kernel.pass(0.1);
  EXPECT_FALSE(dut.next_frame());
  EXPECT_THAT(dut.health().words,
              HasSubstr("no frame for 2.0 s; the last one had 14400 of 614400 bytes"));
  EXPECT_EQ(dut.health().dropped, 60);
}

TEST_F(V4l2Recovery, AFrameMakesTheNextTryAnEarlyOneAgain) {
  kernel.present = false;
  EXPECT_EQ(openings_in(30.0), 0);
  kernel.present = true;
  EXPECT_TRUE(opens_within(2.1));
  EXPECT_TRUE(frame_comes());
  kernel.errors[VIDIOC_DQBUF] = {EIO};
  EXPECT_FALSE(dut.next_frame());
  EXPECT_TRUE(opens_within(0.15));
}

TEST_F(V4l2Recovery, DamageOfLongAgoIsNotTheReasonOfASilence) {
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot({.missing_bytes = 1});
  EXPECT_FALSE(dut.next_frame());
  EXPECT_TRUE(frame_comes());
  kernel.pass(2.1);
  EXPECT_FALSE(dut.next_frame());
  EXPECT_EQ(dut.health().words, "/dev/video0: no frame for 2.0 s");
}

TEST_F(V4l2Recovery, ALoopThatWasHeldUpDoesNotLoseTheCamera) {
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot();
  kernel.pass(10.0);  // the process was stopped
  EXPECT_TRUE(dut.next_frame());
  EXPECT_EQ(kernel.opened, 1);
}

TEST_F(V4l2Recovery, ACameraThatDiesAtOnceIsTriedLessAndLess) {
  // It opens and streams, and its first buffer is an error.
  kernel.errors[VIDIOC_DQBUF] = std::deque<int>(1000, EIO);
  const int openings = openings_in(60.0);
  EXPECT_GE(openings, 60 / 2);
  EXPECT_LE(openings, 60 / 2 + 6);
}

TEST_F(V4l2Recovery, SignalsWithoutEndAreAnError) {
  kernel.errors[VIDIOC_STREAMON] = std::deque<int>(1000, EINTR);
  EXPECT_FALSE(dut.next_frame());
  EXPECT_THAT(dut.health().words, HasSubstr("VIDIOC_STREAMON: Interrupted system call"));
}

TEST_F(V4l2Recovery, ABufferThatIsNoneIsAnError) {
  EXPECT_FALSE(dut.next_frame());
  kernel.lie = [](unsigned long request, void* argument) {
    if (request == VIDIOC_DQBUF) static_cast<v4l2_buffer*>(argument)->index = 4;
  };
  EXPECT_FALSE(frame_comes());
  EXPECT_THAT(dut.health().words, HasSubstr("VIDIOC_DQBUF"));
  expect_closed();
}

TEST_F(V4l2Recovery, TheEndClosesEverything) {
  {
    V4l2Camera camera{{.device = "/dev/video1"}, kernel.system()};
    EXPECT_FALSE(camera.next_frame());
    kernel.shoot();
    EXPECT_TRUE(camera.next_frame());
  }
  EXPECT_TRUE(kernel.descriptors.empty());
  EXPECT_TRUE(kernel.mappings.empty());
}

}  // namespace
}  // namespace gazed::v4l2::recovery_test
