#include "drivers/v4l2/controls.hpp"

#include <cerrno>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::controls_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

class V4l2Controls : public testing::Test {
 protected:
  void has(std::uint32_t id, int minimum, int maximum, int step = 1,
           std::uint32_t type = V4L2_CTRL_TYPE_INTEGER) {
    FakeControl& control = kernel.controls[id];
    control.query.id = id;
    control.query.type = type;
    control.query.minimum = minimum;
    control.query.maximum = maximum;
    control.query.step = step;
  }
  void has_exposure_menu(const std::set<std::uint32_t>& items) {
    has(V4L2_CID_EXPOSURE_AUTO, 0, 3, 0, V4L2_CTRL_TYPE_MENU);
    kernel.controls[V4L2_CID_EXPOSURE_AUTO].menu = items;
  }

  std::vector<std::string> set(const CameraControls& controls, bool by_extension_unit = false) {
    const VideoSystem system = kernel.system();
    VideoDevice device(system);
    EXPECT_EQ(device.open("/dev/video0"), "");
    kernel.controls_set.clear();
    ControlsSet result = set_controls(device, controls, by_extension_unit);
    if (!result.fault.empty()) result.problems.push_back("FAULT " + result.fault);
    return result.problems;
  }

  FakeCamera kernel;
};

TEST_F(V4l2Controls, NothingIsTouchedThatIsNotSet) {
  has(V4L2_CID_GAIN, 0, 255);
  has_exposure_menu({V4L2_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL});
  EXPECT_THAT(set({}), IsEmpty());
  EXPECT_THAT(kernel.controls_set, IsEmpty());
}

TEST_F(V4l2Controls, AutomaticFunctionsComeBeforeTheirValues) {
  has_exposure_menu({V4L2_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL});
  has(V4L2_CID_EXPOSURE_ABSOLUTE, 0, 1048575);
  has(V4L2_CID_AUTOGAIN, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  has(V4L2_CID_GAIN, 0, 1023);
  has(V4L2_CID_AUTO_WHITE_BALANCE, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  has(V4L2_CID_WHITE_BALANCE_TEMPERATURE, 2000, 8000);
  has(V4L2_CID_FOCUS_AUTO, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  has(V4L2_CID_FOCUS_ABSOLUTE, 0, 250);
  has(V4L2_CID_HFLIP, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  has(V4L2_CID_VFLIP, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  EXPECT_THAT(set({.auto_exposure = false,
                   .exposure = 300,
                   .gain = 16,
                   .auto_white_balance = false,
                   .white_balance = 4500,
                   .auto_focus = false,
                   .focus = 0,
                   .flip_horizontal = true,
                   .flip_vertical = false}),
              IsEmpty());
  EXPECT_THAT(kernel.controls_set,
              ElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL),
                          Pair(V4L2_CID_EXPOSURE_ABSOLUTE, 300), Pair(V4L2_CID_AUTOGAIN, 0),
                          Pair(V4L2_CID_GAIN, 16), Pair(V4L2_CID_AUTO_WHITE_BALANCE, 0),
                          Pair(V4L2_CID_WHITE_BALANCE_TEMPERATURE, 4500),
                          Pair(V4L2_CID_FOCUS_AUTO, 0), Pair(V4L2_CID_FOCUS_ABSOLUTE, 0),
                          Pair(V4L2_CID_HFLIP, 1), Pair(V4L2_CID_VFLIP, 0)));
}

TEST_F(V4l2Controls, AValueSwitchesItsAutomaticFunctionOff) {
  has(V4L2_CID_FOCUS_AUTO, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  has(V4L2_CID_FOCUS_ABSOLUTE, 0, 250);
  EXPECT_THAT(set({.focus = 7}), IsEmpty());
  EXPECT_THAT(kernel.controls_set,
              ElementsAre(Pair(V4L2_CID_FOCUS_AUTO, 0), Pair(V4L2_CID_FOCUS_ABSOLUTE, 7)));
  // A camera without one is as good.
  kernel.controls.erase(V4L2_CID_FOCUS_AUTO);
  EXPECT_THAT(set({.focus = 7}), IsEmpty());
  EXPECT_THAT(kernel.controls_set, ElementsAre(Pair(V4L2_CID_FOCUS_ABSOLUTE, 7)));
}

TEST_F(V4l2Controls, AValueBesideItsAutomaticFunctionIsTold) {
  has_exposure_menu({V4L2_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL});
  has(V4L2_CID_EXPOSURE_ABSOLUTE, 0, 1048575);
  EXPECT_THAT(set({.auto_exposure = true, .exposure = 300}),
              ElementsAre("camera.controls.exposure: 300 found; it has no effect while "
                          "auto_exposure is true"));
  EXPECT_THAT(kernel.controls_set, ElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_AUTO)));
}

TEST_F(V4l2Controls, AutomaticExposureIsWhatTheCameraCallsSo) {
  has_exposure_menu({V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_APERTURE_PRIORITY});
  EXPECT_THAT(set({.auto_exposure = true}), IsEmpty());
  EXPECT_THAT(kernel.controls_set,
              ElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY)));
  // A switch, of an older driver.
  has(V4L2_CID_EXPOSURE_AUTO, 0, 1, 1, V4L2_CTRL_TYPE_BOOLEAN);
  EXPECT_THAT(set({.auto_exposure = true}), IsEmpty());
  EXPECT_THAT(kernel.controls_set, ElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, 1)));
  EXPECT_THAT(set({.auto_exposure = false}), IsEmpty());
  EXPECT_THAT(kernel.controls_set, ElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, 0)));
}

TEST_F(V4l2Controls, TheOlderExposureDoesWhereThereIsNoOther) {
  has(V4L2_CID_EXPOSURE, 0, 333);  // V4 and V5 (drivers/README.md)
  EXPECT_THAT(set({.exposure = 100}), IsEmpty());
  EXPECT_THAT(kernel.controls_set, ElementsAre(Pair(V4L2_CID_EXPOSURE, 100)));
  EXPECT_THAT(set({.exposure = 334}),
              ElementsAre("camera.controls.exposure: 334 found; the camera allows 0 to 333 in "
                          "steps of 1"));
  EXPECT_THAT(kernel.controls_set, IsEmpty());  // nothing is clamped
}

TEST_F(V4l2Controls, WhatTheCameraHasNotIsTold) {
  EXPECT_THAT(set({.auto_focus = false, .focus = 0, .flip_vertical = true}),
              ElementsAre("camera.controls.auto_focus: the camera has no such control",
                          "camera.controls.focus: the camera has no such control",
                          "FAULT camera.controls.flip_vertical: the camera has no such control; "
                          "the picture would be the wrong way round (false: it is not)"));
  EXPECT_THAT(set({.flip_horizontal = false}), IsEmpty());
}

TEST_F(V4l2Controls, ADisabledControlIsNone) {
  has(V4L2_CID_GAIN, 0, 255);
  kernel.controls[V4L2_CID_GAIN].query.flags = V4L2_CTRL_FLAG_DISABLED;
  EXPECT_THAT(set({.gain = 1}),
              ElementsAre("camera.controls.gain: the camera has no such control"));
}

TEST_F(V4l2Controls, AValueBetweenTheStepsIsTold) {
  has(V4L2_CID_GAIN, -16, 240, 16);
  EXPECT_THAT(set({.gain = 32}), IsEmpty());
  EXPECT_THAT(set({.gain = 40}),
              ElementsAre("camera.controls.gain: 40 found; the camera allows -16 to 240 in steps "
                          "of 16"));
  EXPECT_THAT(set({.gain = -32}),
              ElementsAre("camera.controls.gain: -32 found; the camera allows -16 to 240 in steps "
                          "of 16"));
}

TEST_F(V4l2Controls, EndsOfAnyKindAreNoTrouble) {
  has(V4L2_CID_GAIN, std::numeric_limits<int>::min(), std::numeric_limits<int>::max(), 1);
  EXPECT_THAT(set({.gain = std::numeric_limits<int>::max()}), IsEmpty());
  has(V4L2_CID_GAIN, 0, 255, 0);
  EXPECT_THAT(set({.gain = 3}), IsEmpty());
  has(V4L2_CID_GAIN, 255, 0, -5);
  EXPECT_EQ(set({.gain = 3}).size(), 1U);
}

TEST_F(V4l2Controls, WhatTheCameraRefusesOrChangesIsTold) {
  has(V4L2_CID_GAIN, 0, 255);
  has(V4L2_CID_FOCUS_ABSOLUTE, 0, 255);
  kernel.errors[VIDIOC_S_CTRL] = {EIO};
  kernel.lie = [](unsigned long request, void* argument) {
    if (request == VIDIOC_S_CTRL) static_cast<v4l2_control*>(argument)->value = 8;
  };
  EXPECT_THAT(set({.gain = 10, .focus = 10}),
              ElementsAre("camera.controls.gain: 10 found; the camera refuses it: Input/output "
                          "error",
                          "camera.controls.focus: 10 found; the camera took 8"));
}

TEST_F(V4l2Controls, TheV6IsFlippedByItsExtensionUnit) {
  EXPECT_THAT(set({.flip_horizontal = true, .flip_vertical = false}, true), IsEmpty());
  EXPECT_THAT(kernel.extension_set, ElementsAre(Pair(0x0D, 1), Pair(0x0C, 0)));
  EXPECT_THAT(kernel.controls_set, IsEmpty());
}

TEST_F(V4l2Controls, AnExtensionUnitOfAnotherLengthIsAskedInIts) {
  kernel.extension_bytes = 1;
  EXPECT_THAT(set({.flip_vertical = true}, true), IsEmpty());
  EXPECT_THAT(kernel.extension_set, ElementsAre(Pair(0x0C, 1)));
  kernel.extension_bytes = 300;
  EXPECT_THAT(set({.flip_vertical = true}, true),
              ElementsAre(testing::HasSubstr("a value of 300 bytes found; allowed: 1 to 8")));
}

TEST_F(V4l2Controls, AFlipThatIsNotTakenIsAFault) {
  kernel.extension_takes_it = false;
  EXPECT_THAT(set({.flip_vertical = true}, true),
              ElementsAre(testing::StartsWith("FAULT camera.controls.flip_vertical: extension "
                                              "unit: it took 0")));
  V4l2Camera dut{{.device = "/dev/video0", .controls = {.flip_vertical = true}}, kernel.system()};
  EXPECT_FALSE(dut.next_frame());
  EXPECT_THAT(dut.health().words, testing::HasSubstr("the picture would be the wrong way round"));
  EXPECT_FALSE(kernel.streaming);
}

TEST_F(V4l2Controls, AreSetAtEveryOpeningAndTroubleToldOnce) {
  has(V4L2_CID_GAIN, 0, 255);
  V4l2Camera dut{{.device = "/dev/video0", .controls = {.gain = 7, .focus = 3}}, kernel.system()};
  for (std::size_t opening = 1; opening <= 3; ++opening) {
    kernel.present = true;
    kernel.pass(2.0);
    EXPECT_FALSE(dut.next_frame());
    EXPECT_EQ(kernel.controls_set.size(), opening);
    EXPECT_EQ(dut.warning(), opening == 1 ? "/dev/video0: camera.controls.focus: the camera has "
                                            "no such control"
                                          : "");
    kernel.present = false;
    EXPECT_FALSE(dut.next_frame());
  }
}

}  // namespace
}  // namespace gazed::v4l2::controls_test
