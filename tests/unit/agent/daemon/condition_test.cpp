#include "agent/daemon/condition.hpp"

#include <gtest/gtest.h>

namespace gazed::daemon::condition_test {
namespace {

using drivers::HealthKind;

Condition well() {
  return {.camera = {"v4l2:/dev/video-top", false, {}},
          .head = {"lcm", false, {}},
          .lcm_url = "udpm://239.255.76.67:7667?ttl=1",
          .lcm_fault = "",
          .recorder_fault = "",
          .fixations = 12,
          .located = 9};
}

TEST(Condition, AllIsWell) {
  EXPECT_EQ(faults(well()), "");
  EXPECT_EQ(status_line(well()), "looking; 12 points, 9 located");
}

TEST(Condition, NothingHasComeYet) {
  Condition condition = well();
  condition.camera.silent = condition.head.silent = true;
  condition.fixations = 1;
  condition.located = 0;
  EXPECT_EQ(status_line(condition),
            "no camera: no frame comes from v4l2:/dev/video-top; no head: no state comes from lcm; "
            "1 point, 0 located");
}

TEST(Condition, ADriverKnowsWhy) {
  Condition condition = well();
  condition.camera = {
      "v4l2:/dev/video-top", true, {HealthKind::lost, "/dev/video-top: Permission denied"}};
  EXPECT_EQ(faults(condition), "/dev/video-top: Permission denied");
  EXPECT_EQ(status_line(condition),
            "no camera: /dev/video-top: Permission denied; 12 points, 9 located");
}

TEST(Condition, AFaultOfACameraThatGoesOnIsNotThatThereIsNone) {
  Condition condition = well();
  condition.camera.health = {HealthKind::refused, "1 frame refused"};
  EXPECT_EQ(faults(condition), "1 frame refused");
  EXPECT_EQ(status_line(condition), "looking; 12 points, 9 located");
}

TEST(Condition, WithoutARouteTheCountOfWhatIsLostIsNotInTheLine) {
  Condition condition = well();
  condition.lcm_fault = "no LCM connection to udpm://239.255.76.67:7667?ttl=1; 17 messages lost";
  condition.head = {
      "lcm",
      true,
      {HealthKind::no_link, "the last head command could not be sent: " + condition.lcm_fault}};
  EXPECT_EQ(status_line(condition),
            "no head: no state comes from lcm; no route: LCM cannot send to "
            "udpm://239.255.76.67:7667?ttl=1 (no network, or no multicast route); 12 points, "
            "9 located");
  EXPECT_EQ(faults(condition), condition.head.health.words + "; " + condition.lcm_fault);
}

TEST(Condition, TheLinksFaultIsKnownByItsKindWhateverItsWords) {
  Condition condition = well();
  condition.lcm_fault = "no LCM connection";
  condition.camera = {"lcm", true, {HealthKind::no_link, "no way out"}};
  condition.head = {"lcm", true, {HealthKind::refused, "refused: no LCM connection"}};
  EXPECT_EQ(status_line(condition),
            "no camera: no frame comes from lcm; no head: refused: no LCM connection; no route: "
            "LCM cannot send to udpm://239.255.76.67:7667?ttl=1 (no network, or no multicast "
            "route); 12 points, 9 located");
}

TEST(Condition, ARecordingThatHasStopped) {
  Condition condition = well();
  condition.recorder_fault = "the recording a.lcm has stopped";
  EXPECT_EQ(status_line(condition),
            "looking; 12 points, 9 located; the recording a.lcm has stopped");
}

}  // namespace
}  // namespace gazed::daemon::condition_test
