// The only loop: one poll() over camera, head, LCM, timers and signals.
//
// Time. A scheduled driver (simulated or recorded) knows when its next event is due. If both
// drivers are scheduled, time is that of their events, played as fast as possible or, when paced,
// in step with the wall clock. A live driver signals its events through its descriptor.
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

/// What wiring.cpp makes from the configuration. The link outlives the drivers.
struct LoopParts {
  std::vector<drivers::ExclusiveUse> in_use;  // resources that a second gazed must not use
  std::unique_ptr<lcm::LcmLink> link;
  std::unique_ptr<drivers::CameraDriver> camera;
  std::unique_ptr<drivers::HeadDriver> head;
  std::unique_ptr<log::Recorder> recorder;  // null unless recording was requested
  std::function<void()> scene_goes_on;      // called after each fixation; may be empty
  std::function<void(const geometry::HeadState&)>
      camera_follows;  // a simulated camera in another driver's head; may be empty
};

class Loop {
 public:
  Loop(const settings::Settings& settings, LoopParts parts, EndSignals& signals, Report& report,
       ServiceManager& service);

  /// Runs until the requested fixations are made, a signal comes, or a recording or scene ends.
  /// Returns the exit code: 0, or 1 if a recording or scene ended before all fixations were made.
  int run();

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool done() const;
  void serve_scheduled();
  void serve_live();
  [[nodiscard]] bool serve_earliest_scheduled();
  [[nodiscard]] std::optional<std::int64_t> next_scheduled_us() const;
  [[nodiscard]] std::int64_t paced_now_us() const;
  /// Seconds of event time if both drivers are scheduled, otherwise of a clock that never goes
  /// back.
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
  bool fast_;               // do not wait for scheduled events
  bool scheduled_ = false;  // both drivers are: time is that of their events
  int counted_ = 0;
  Effort effort_;
  std::int64_t newest_utime_us_ = 0;  // of the inputs, as seen by saw()
  Clock::time_point started_;
  std::optional<std::int64_t> first_scheduled_us_;
  std::int64_t scheduled_now_us_ = 0;  // due time of the last scheduled event
  std::int64_t paced_from_us_ = 0;     // a scheduled driver's time when the loop was created

  double last_frame_s_ = 0.0;
  double last_head_state_s_ = 0.0;

  Clock::time_point status_due_;
  cycle::CycleState published_state_ = cycle::CycleState::waiting;
};

}  // namespace gazed::daemon
