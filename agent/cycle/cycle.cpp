#include "agent/cycle/cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "agent/gaze/step_rule.hpp"
#include "agent/text.hpp"

namespace gazed {

namespace {

// A recorded head's move of so much counts as the turn (DESIGN 4.3).
constexpr double recorded_turn_rad = 0.02;
// Without a salient object for so long, the fixation ends (DESIGN 4.2).
constexpr double looking_s = 1.0;
// A fault that lasts is published again after this long (DESIGN 4.1).
constexpr double fault_repeat_s = 10.0;
// Angles that leave the limits by more than encoder noise and margin can explain are not believed.
constexpr double limits_slack_rad = 0.1;
// The second view must call the target's place salient too: at least this share of its own peak
// within two cells. Two cells, since the target's reference point need not be where its saliency is
// greatest.
constexpr double confirmed_share = 0.2;
constexpr int confirmed_cells = 2;

double seconds(std::int64_t from_us, std::int64_t to_us) {
  return 1e-6 * (static_cast<double>(to_us) - static_cast<double>(from_us));
}

double largest(HeadAngles difference) {
  return std::max(std::abs(difference.yaw_rad), std::abs(difference.pitch_rad));
}

/// The map's greatest value near a pixel, as a share of its greatest value.
double share_of_peak(const SaliencyMap& map, const Pixel& pixel) {
  const int column = static_cast<int>(std::lround(pixel.x() / saliency_cell_px));
  const int row = static_cast<int>(std::lround(pixel.y() / saliency_cell_px));
  int near = 0;
  for (int y = std::max(0, row - confirmed_cells);
       y <= std::min(map.height - 1, row + confirmed_cells); ++y) {
    for (int x = std::max(0, column - confirmed_cells);
         x <= std::min(map.width - 1, column + confirmed_cells); ++x) {
      near = std::max<int>(near, map.samples[static_cast<std::size_t>(y * map.width + x)]);
    }
  }
  const int peak = *std::max_element(map.samples.begin(), map.samples.end());
  return peak > 0 ? static_cast<double>(near) / peak : 0.0;
}

}  // namespace

std::string_view name(CycleState state) {
  constexpr std::array<std::string_view, 8> names{"waiting",   "looking",  "turning", "settling",
                                                  "relooking", "locating", "fault",   "stopping"};
  return names[static_cast<std::size_t>(state)];
}

Cycle::Cycle(const CycleSettings& settings)
    : settings_(settings),
      saliency_(settings.saliency, settings.camera.width_px, settings.camera.height_px),
      registration_(settings.registration, settings.camera, settings.head, settings.uncertainty),
      history_(settings.settle_velocity_rad_s),
      pending_(settings.camera.width_px, settings.camera.height_px, PixelFormat::rgb24) {
  first_.image = pending_;
}

CycleOutput Cycle::on_head_state(const HeadState& state) {
  CycleOutput output;
  if (!history_.add(state)) return output;
  output.consumed = true;
  if (state_ == CycleState::fault && fault_ == Status::head_fault) start_looking(state.utime_us);
  if (pending_utime_us_) {
    if (const auto head = history_.at(*pending_utime_us_)) {
      const View view{pending_.view(), head->measured, *pending_utime_us_};
      pending_utime_us_.reset();
      use_view(view, head->still, output);
    }
  }
  watch_turn(output);
  return output;
}

CycleOutput Cycle::on_frame(const Frame& frame) {
  CycleOutput output;
  const ImageView& image = frame.image;
  if (image.width_px != settings_.camera.width_px ||
      image.height_px != settings_.camera.height_px) {
    refused_frame_ = text("a frame of %dx%d pixels came; configured: %dx%d", image.width_px,
                          image.height_px, settings_.camera.width_px, settings_.camera.height_px);
    return output;
  }
  if (!plausible_utime(frame.utime_us)) {
    refused_frame_ = "a frame came whose time is no time";
    return output;
  }
  if (frame.utime_us <= last_frame_utime_us_) {
    refused_frame_ = text("a frame came whose time lies %.3f s before the last one's",
                          seconds(frame.utime_us, last_frame_utime_us_));
    return output;
  }
  refused_frame_.clear();
  // While a frame waits for its head angles, later ones are let go: waiting for the newest could
  // last for ever.
  if (pending_utime_us_) return output;
  output.consumed = true;
  last_frame_utime_us_ = frame.utime_us;
  if (state_ == CycleState::fault && fault_ == Status::camera_fault) start_looking(frame.utime_us);
  if (!wants_frame(frame.utime_us)) return output;
  if (const auto head = history_.at(frame.utime_us)) {
    use_view({image, head->measured, frame.utime_us}, head->still, output);
  } else if (history_.empty() || history_.newest().utime_us < frame.utime_us) {
    pending_.assign(image);
    pending_utime_us_ = frame.utime_us;
  }
  return output;
}

bool Cycle::wants_frame(std::int64_t utime_us) const {
  switch (state_) {
    case CycleState::waiting:
    case CycleState::looking:
      return true;
    case CycleState::turning:
    case CycleState::settling:
    case CycleState::relooking:
      return utime_us > command_utime_us_;
    default:
      return false;
  }
}

void Cycle::use_view(const View& view, bool still, CycleOutput& output) {
  if (state_ == CycleState::waiting) state_ = CycleState::looking;
  if (!still) return;
  if (state_ == CycleState::looking) {
    look(view, output);
  } else if (turned(view.head)) {
    relook(view, output);
  }
}

void Cycle::look(const View& view, CycleOutput& output) {
  if (!looking_since_us_) looking_since_us_ = view.utime_us;
  const SaliencyResult seen = saliency_.look(view.image);
  std::string reason =
      text("distinctness %.2f, at least %.2f is needed", static_cast<double>(seen.distinctness),
           settings_.saliency.distinctness_min);
  if (static_cast<double>(seen.distinctness) >= settings_.saliency.distinctness_min &&
      seen.saliency > 0.0F) {
    if (const auto target = registration_.choose_target(view, seen.peak_px)) {
      output.saliency = UsedSaliency{view.utime_us, seen};
      aim(view, *target, seen, output);
      return;
    }
    reason =
        text("nothing at the most salient place (%.0f, %.0f) px can be told from its surroundings",
             seen.peak_px.x(), seen.peak_px.y());
  }
  if (seconds(*looking_since_us_, view.utime_us) < looking_s) return;
  output.saliency = UsedSaliency{view.utime_us, seen};
  Fixation fixation = new_fixation(view.utime_us, Status::no_salient_object, std::move(reason));
  fixation.views = 1;
  fixation.head_1 = view.head;
  fixation.saliency = seen.saliency;
  fixation.distinctness = seen.distinctness;
  finish(std::move(fixation), output);
}

void Cycle::aim(const View& view, const Pixel& target, const SaliencyResult& seen,
                CycleOutput& output) {
  const HeadAngles inside = settings_.limits.clamp(view.head);
  if (largest(inside - view.head) > limits_slack_rad) {
    end_by_head_fault(
        text("measured head angles (%.3f, %.3f) rad lie outside the limits; nearest allowed: "
             "(%.3f, %.3f)",
             view.head.yaw_rad, view.head.pitch_rad, inside.yaw_rad, inside.pitch_rad),
        view.utime_us, output);
    return;
  }
  first_.image.assign(view.image);
  first_.head = view.head;
  first_.utime_us = view.utime_us;
  first_.pixel = target;
  first_.saliency = seen.saliency;
  first_.distinctness = seen.distinctness;
  commanded_ = next_look(settings_.camera, settings_.limits, inside, target);
  command_utime_us_ = std::max(view.utime_us, history_.newest().utime_us);
  output.command = HeadCommand{command_utime_us_, commanded_, settings_.speed_fraction};
  state_ = CycleState::turning;
}

bool Cycle::turned(HeadAngles measured) const {
  if (settings_.head_obeys) return largest(measured - commanded_) <= settings_.settle_tolerance_rad;
  const HeadAngles move = measured - first_.head;
  return std::hypot(move.yaw_rad, move.pitch_rad) >= recorded_turn_rad;
}

void Cycle::watch_turn(CycleOutput& output) {
  const bool on_the_way = state_ == CycleState::turning || state_ == CycleState::settling;
  if (!on_the_way || history_.newest().utime_us <= command_utime_us_) return;
  const HeadState& now = history_.newest();
  const bool there = turned(now.measured);
  state_ = !there ? CycleState::turning
                  : (history_.still_now() ? CycleState::relooking : CycleState::settling);
  if (state_ == CycleState::relooking || !settings_.head_obeys) return;
  const double waited_s = seconds(command_utime_us_, now.utime_us);
  if (waited_s < settings_.settle_timeout_s) return;
  end_by_head_fault(text("the head has not settled %.1f s after the command (%.3f, %.3f) rad: it "
                         "is at (%.3f, %.3f)",
                         waited_s, commanded_.yaw_rad, commanded_.pitch_rad, now.measured.yaw_rad,
                         now.measured.pitch_rad),
                    now.utime_us, output);
}

void Cycle::relook(const View& view, CycleOutput& output) {
  state_ = CycleState::locating;
  const SaliencyResult seen = saliency_.look(view.image);
  output.saliency = UsedSaliency{view.utime_us, seen};
  Fixation fixation = new_fixation(view.utime_us, Status::target_lost, {});
  fixation.views = 2;
  fixation.pixel_1 = first_.pixel;
  fixation.head_1 = first_.head;
  fixation.head_2 = view.head;
  fixation.saliency = first_.saliency;
  fixation.distinctness = first_.distinctness;
  fixation.estimate = locate(view, seen.map, fixation.pixel_2);
  finish(std::move(fixation), output);
}

PointEstimate Cycle::locate(const View& view, const SaliencyMap& map, Pixel& pixel_2) {
  PointEstimate lost;
  lost.status = Status::target_lost;
  const RegistrationResult found = registration_.find(view);
  if (!found.match) {
    lost.reason = found.reason;
    return lost;
  }
  pixel_2 = found.match->pixel_2;
  if (const double share = share_of_peak(map, pixel_2); share < confirmed_share) {
    lost.reason = text(
        "at (%.1f, %.1f) px the second view's saliency is %.0f %% of its peak; at least %.0f %% is "
        "needed",
        pixel_2.x(), pixel_2.y(), 100 * share, 100 * confirmed_share);
    return lost;
  }
  const TwoLooks looks{first_.head, view.head, first_.pixel, pixel_2, found.match->covariance_px2};
  return estimate_point(settings_.head, settings_.camera, settings_.uncertainty, looks,
                        settings_.gate);
}

Fixation Cycle::new_fixation(std::int64_t utime_us, Status status, std::string reason) const {
  Fixation fixation;
  fixation.utime_us = utime_us;
  fixation.number = fixations_ + 1;
  fixation.estimate.status = status;
  fixation.estimate.reason = std::move(reason);
  if (looking_since_us_) fixation.duration_s = seconds(*looking_since_us_, utime_us);
  return fixation;
}

void Cycle::finish(Fixation fixation, CycleOutput& output) {
  if (fixation.counts) ++fixations_;
  start_looking(fixation.utime_us);
  output.fixation = std::move(fixation);
}

void Cycle::start_looking(std::int64_t after_utime_us) {
  state_ = CycleState::looking;
  looking_since_us_.reset();
  pending_utime_us_.reset();
  next_silence_report_s_ = 0.0;
  history_.restart(after_utime_us);
}

void Cycle::end_by_head_fault(std::string reason, std::int64_t utime_us, CycleOutput& output) {
  // A head that fails every try is tried again at once, but only spoken of every 10 s.
  const bool spoken_of =
      last_head_fault_us_ && seconds(*last_head_fault_us_, utime_us) < fault_repeat_s;
  if (spoken_of) {
    start_looking(utime_us);
    return;
  }
  last_head_fault_us_ = utime_us;
  Fixation fixation = new_fixation(utime_us, Status::head_fault, std::move(reason));
  fixation.views = 1;
  fixation.pixel_1 = first_.pixel;
  fixation.head_1 = first_.head;
  finish(std::move(fixation), output);
}

CycleOutput Cycle::on_silence(const Silence& silence) {
  CycleOutput output;
  if (silence.camera_s >= settings_.camera_timeout_s) {
    const std::string_view why =
        refused_frame_.empty() ? silence.camera_fault : std::string_view(refused_frame_);
    report_silence(Status::camera_fault, text("no usable frame for %.1f s", silence.camera_s), why,
                   silence.camera_s, output);
  } else if (silence.head_s >= settings_.head_timeout_s) {
    report_silence(Status::head_fault, text("no head state for %.1f s", silence.head_s),
                   silence.head_fault, silence.head_s, output);
  }
  return output;
}

void Cycle::report_silence(Status status, std::string reason, std::string_view why, double silent_s,
                           CycleOutput& output) {
  const bool look_under_way = state_ == CycleState::turning || state_ == CycleState::settling ||
                              state_ == CycleState::relooking;
  if (state_ == CycleState::fault && fault_ == status && silent_s < next_silence_report_s_) return;
  if (!why.empty()) reason.append(": ").append(why);
  Fixation fixation = new_fixation(
      std::max(last_frame_utime_us_, history_.empty() ? 0 : history_.newest().utime_us), status,
      std::move(reason));
  fixation.counts = look_under_way;
  if (look_under_way) {
    fixation.views = 1;
    fixation.pixel_1 = first_.pixel;
    fixation.head_1 = first_.head;
  }
  finish(std::move(fixation), output);
  // Whatever comes back may count its time anew.
  if (status == Status::camera_fault) last_frame_utime_us_ = INT64_MIN;
  if (status == Status::head_fault) history_ = HeadHistory(settings_.settle_velocity_rad_s);
  state_ = CycleState::fault;
  fault_ = status;
  next_silence_report_s_ = silent_s + fault_repeat_s;
}

}  // namespace gazed
