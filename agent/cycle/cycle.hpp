// The report's six steps (Russcher 2011, section 4.4) as a state machine that does no I/O and reads
// no clock:
//
//   still head -> view 1 -> saliency -> step rule -> command -> settled -> view 2 -> saliency ->
//   relative pose -> triangulate
//
// Where more than two looks are asked for, the steps from the command on are repeated, and all
// looks are triangulated together.
//
// Frames and head states go in, each with its own time; commands, saliency maps and fixations come
// out. Angles are those measured, interpolated to the image's capture, never the commanded ones.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "agent/cycle/attention.hpp"
#include "agent/cycle/earlier_fixation.hpp"
#include "agent/cycle/fixation.hpp"
#include "agent/cycle/frame_counts.hpp"
#include "agent/cycle/head_history.hpp"
#include "agent/cycle/settings.hpp"
#include "agent/cycle/track.hpp"
#include "agent/geometry/limits.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/geometry/view.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::cycle {

/// Whoever moves the head.
struct HeadLink {
  bool obeys = true;  // false for a recorded head: a measured move is the turn
  /// Called between the steps of a view's work (its saliency, finding the target, following the
  /// background), so that a head that waits for an answer need not wait for the whole; must not
  /// call the cycle.
  std::function<void()> serve = [] {};
};

/// The names are those of status_t.state.
enum class CycleState { waiting, looking, turning, settling, relooking, locating, fault, stopping };

[[nodiscard]] std::string_view name(CycleState state);

/// A saliency map that was used. The map is borrowed until the next call of the cycle.
struct UsedSaliency {
  std::int64_t utime_us = 0;  // of the frame
  saliency::SaliencyResult result;
  bool first_view = true;  // nothing but the saliency was worked out of it
};

/// What one input led to.
struct CycleOutput {
  bool consumed = false;  // a frame was looked at, or a head state kept
  std::optional<geometry::HeadCommand> command;
  std::optional<UsedSaliency> saliency;
  std::optional<Fixation> fixation;
};

/// Seconds without an accepted frame or head state, what the drivers say about it, and the clock
/// that measures them.
struct Silence {
  double camera_s = 0.0;
  double head_s = 0.0;
  std::string_view camera_fault;
  std::string_view head_fault;
  double now_s = 0.0;
};

class Cycle {
 public:
  Cycle(const geometry::Rig& rig, const CycleSettings& settings, HeadLink head = {});

  [[nodiscard]] CycleOutput on_head_state(const geometry::HeadState& state);
  /// A frame of another size than the camera model's is not consumed; refused_frame() says why.
  [[nodiscard]] CycleOutput on_frame(const geometry::Frame& frame);
  /// False where the head states, which have come up to that time, tell that nothing would be
  /// looked at in a frame of it: only its time and size matter then.
  [[nodiscard]] bool may_look_at_frame(std::int64_t utime_us) const;
  /// To be called now and then; publishes a fault once when nothing arrives for too long, then
  /// every 10 s.
  [[nodiscard]] CycleOutput on_silence(const Silence& silence);

  [[nodiscard]] CycleState state() const { return state_; }
  /// Why the last frame could not be used; empty when it could.
  [[nodiscard]] const std::string& refused_frame() const { return refused_frame_; }
  /// What became of the frames so far.
  [[nodiscard]] FrameCounts frame_counts() const;
  /// How long the head's angles are kept; a frame that comes later than that gets none.
  [[nodiscard]] double head_angles_kept_s() const { return history_.kept_s(); }
  /// Something about the head that its owner should know, reported once; empty otherwise.
  [[nodiscard]] std::string head_warning() { return history_.warning(); }

 private:
  struct FirstView {
    float saliency = 0.0F;
    float distinctness = 0.0F;
  };

  [[nodiscard]] double move_margin_rad() const;
  [[nodiscard]] std::int64_t readout_us() const;
  [[nodiscard]] bool wants_frame(std::int64_t utime_us) const;
  [[nodiscard]] std::string refusal_of(const geometry::Frame& frame) const;
  void drop_pending();
  void follow_a_clock_that_is_set(std::int64_t utime_us, CycleOutput& output);
  void use_view(const geometry::View& view, bool still, CycleOutput& output);
  void look(const geometry::View& view, CycleOutput& output);
  void aim(const geometry::View& view, const saliency::SaliencyResult& seen, CycleOutput& output);
  [[nodiscard]] double arrival_tolerance_rad() const;
  [[nodiscard]] bool is_as_commanded(geometry::HeadAngles measured) const;
  [[nodiscard]] bool turned(geometry::HeadAngles measured) const;
  [[nodiscard]] bool look_under_way() const;
  [[nodiscard]] bool planned_look_under_way() const;
  void watch_rest(CycleOutput& output);
  void watch_turn(CycleOutput& output);
  void leave_look();
  void turn_to(geometry::HeadAngles look, std::int64_t utime_us, CycleOutput& output);
  bool turns_on(const geometry::View& view, CycleOutput& output);
  void command(geometry::HeadAngles target, std::int64_t utime_us, CycleOutput& output);
  void relook(const geometry::View& view, CycleOutput& output);
  [[nodiscard]] bool belongs_to_another_fixation(const geometry::View& view) const;
  [[nodiscard]] bool is_outside_limits(geometry::HeadAngles measured) const;
  void look_back(std::int64_t utime_us, CycleOutput& output);
  void publish_track(std::int64_t utime_us, const std::string& ended, CycleOutput& output);

  [[nodiscard]] Fixation new_fixation(std::int64_t utime_us, Status status,
                                      std::string reason) const;
  [[nodiscard]] double looked_for_s(std::int64_t until_us) const;
  [[nodiscard]] std::int64_t believed_utime_us() const;
  void finish(Fixation fixation, CycleOutput& output);
  void start_looking(std::int64_t after_utime_us);
  void wake_up(std::int64_t utime_us, CycleOutput& output);
  void end_by_head_fault(std::string reason, std::int64_t utime_us, CycleOutput& output);
  void report_head_fault(std::string reason, std::int64_t utime_us, CycleOutput& output);
  void report_first_view(Fixation& fixation) const;
  void report_silence(Status status, std::string reason, double now_s, CycleOutput& output);

  geometry::CameraModel camera_;
  double encoder_sigma_rad_;
  geometry::HeadLimits limits_;
  CycleSettings settings_;
  HeadLink head_;
  saliency::Saliency saliency_;
  Attention attention_;
  Track track_;
  EarlierFixation earlier_;
  HeadHistory history_;
  CycleState state_ = CycleState::waiting;
  FirstView first_;
  base::Image pending_;  // a frame whose head angles have not come yet
  std::optional<std::int64_t> pending_utime_us_;
  std::optional<std::int64_t> looking_since_us_;
  std::int64_t last_frame_utime_us_ = INT64_MIN;
  geometry::HeadAngles commanded_;
  geometry::HeadAngles first_look_;           // the step rule's
  std::optional<geometry::HeadAngles> goal_;  // after the place on the way that was commanded
  geometry::HeadAngles turned_from_;          // where the last look was taken
  geometry::HeadAngles rested_at_;            // since then
  int turned_on_ = 0;                         // since then, because a move fell short
  std::int64_t command_utime_us_ = 0;
  std::int32_t fixations_ = 0;
  Status fault_ = Status::camera_fault;                        // which one, in state fault
  std::optional<double> camera_reported_s_, head_reported_s_;  // the last silence told
  bool must_look_back_ = false;  // a silence ended planned looks; nothing has been looked at since
  std::optional<std::int64_t> rest_utime_us_;  // when the head was last still, while looking
  std::optional<std::int64_t> last_head_fault_us_;
  std::string refused_frame_;
  FrameCounts counts_;
  std::int64_t behind_pending_ = 0;  // frames that came while one waited

  /// A fault that lasts is published again after this long.
  static constexpr double fault_repeat_s = 10.0;
  /// A command is obeyed within some cycles of a robot's joints, of 12 to 20 ms.
  static constexpr std::int64_t setting_off_us = 150'000;
};

}  // namespace gazed::cycle
