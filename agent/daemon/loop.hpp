// The one loop: a single poll() over camera, head, LCM, timers and signals.
//
// Time. A scheduled driver (simulated or recorded) knows when its next event is due; when both
// drivers are scheduled, time is that of their events, played as fast as the computer can or,
// paced, in step with the wall clock. A live driver's events come by its descriptor.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/cycle/cycle.hpp"
#include "agent/daemon/clock_comparison.hpp"
#include "agent/daemon/condition.hpp"
#include "agent/daemon/process.hpp"
#include "agent/daemon/publisher.hpp"
#include "agent/daemon/report.hpp"
#include "agent/daemon/service_manager.hpp"
#include "agent/settings/settings.hpp"
#include "drivers/camera.hpp"
#include "drivers/exclusive.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/publisher_watch.hpp"
#include "drivers/log/recorder.hpp"

namespace gazed::daemon {

/// What wiring made of the configuration. The link outlives the drivers.
struct LoopParts {
  std::vector<drivers::ExclusiveUse> in_use;  // what no second gazed may use
  std::unique_ptr<lcm::LcmLink> link;
  std::unique_ptr<drivers::CameraDriver> camera;
  std::unique_ptr<drivers::HeadDriver> head;
  std::unique_ptr<log::Recorder> recorder;  // none unless asked for
  std::function<void()> scene_goes_on;      // after each fixation; may be empty
  std::function<void(const geometry::HeadState&)>
      camera_follows;  // a simulated camera in another driver's head; may be empty
};

class Loop {
 public:
  Loop(const settings::Settings& settings, LoopParts parts, EndSignals& signals, Report& report,
       ServiceManager& service);

  /// Runs until the fixations asked for are made, a signal comes, or a recording or scene ends. The
  /// exit code: 0, or 1 when a recording or scene ended before all fixations were made.
  int run();

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool done() const;
  void serve_scheduled();
  void serve_live();
  [[nodiscard]] bool serve_earliest_scheduled();
  [[nodiscard]] std::optional<std::int64_t> next_scheduled_us() const;
  [[nodiscard]] std::int64_t paced_now_us() const;
  /// Seconds of event time when both drivers are scheduled, else of a clock that only goes forward.
  [[nodiscard]] double now_s() const;
  [[nodiscard]] bool recorder_is_full();
  void saw(std::int64_t utime_us);
  void take_head_state(const geometry::HeadState& state);
  void take_frame(const geometry::Frame& frame);
  void act(cycle::CycleOutput& output, double elapsed_ms);
  void take_fixation(cycle::Fixation& fixation, double elapsed_ms);
  void watch_silence();
  void publish_status_when_due();
  void publish_status();
  [[nodiscard]] Condition condition() const;
  void report_faults();
  void report_losses();
  void wait();

  settings::Settings settings_;
  LoopParts parts_;
  EndSignals& signals_;
  Report& report_;
  ServiceManager& service_;
  cycle::Cycle cycle_;
  Publisher publisher_;
  lcm::PublisherWatch watch_;
  ClockComparison clocks_;  // of live drivers
  ProcessMeter meter_;
  status_t status_{};
  bool head_state_came_ = false;

  bool stopping_ = false;
  bool fast_;               // scheduled events are not waited for
  bool scheduled_ = false;  // both drivers are: time is that of their events
  int counted_ = 0;
  Effort effort_;
  std::int64_t newest_utime_us_ = 0;  // of what was taken, as saw() has it
  Clock::time_point started_;
  std::optional<std::int64_t> first_scheduled_us_;
  std::int64_t scheduled_now_us_ = 0;  // when the last scheduled event was due
  std::int64_t paced_from_us_ = 0;     // time of a scheduled driver when the loop was made

  double last_frame_s_ = 0.0;
  double last_head_state_s_ = 0.0;

  Clock::time_point status_due_;
  cycle::CycleState published_state_ = cycle::CycleState::waiting;
};

}  // namespace gazed::daemon
