// What the cycle does with a view: look for the object, aim at it, look again, locate.
#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/cycle/cycle.hpp"
#include "agent/gaze/step_rule.hpp"
#include "agent/text.hpp"
#include "agent/utime.hpp"

namespace gazed {

namespace {

// Without a salient object for so long, the fixation ends (DESIGN 4.2).
constexpr double looking_s = 1.0;
// Angles that leave the limits by more than encoder noise and margin can explain are not believed.
constexpr double limits_slack_rad = 0.1;
// The second view must call the target's place salient too: at least this share of its own peak
// within two cells. Two cells, since the target's reference point need not be where its saliency is
// greatest.
constexpr double confirmed_share = 0.2;
constexpr int confirmed_cells = 2;

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

void Cycle::look(const View& view, CycleOutput& output) {
  if (!looking_since_us_) looking_since_us_ = view.utime_us;
  const SaliencyResult seen = saliency_.look(view.image, attention_.context_for(view));
  attention_.won(view, seen.peak_px);
  const double looked_s = seconds_between(*looking_since_us_, view.utime_us);
  if (attention_.flicker_needs_another_frame() && looked_s < looking_s) return;
  const bool distinct =
      static_cast<double>(seen.distinctness) >= settings_.saliency.distinctness_min &&
      seen.saliency > 0.0F;
  if (distinct) {
    if (const auto target = registration_.choose_target(view, seen.peak_px)) {
      output.saliency = UsedSaliency{view.utime_us, seen};
      aim(view, *target, seen, output);
      return;
    }
  }
  if (looked_s < looking_s) return;
  output.saliency = UsedSaliency{view.utime_us, seen};
  std::string reason =
      distinct ? text(
                     "nothing at the most salient place (%.0f, %.0f) px can be told from its "
                     "surroundings",
                     seen.peak_px.x(), seen.peak_px.y())
               : text("distinctness %.2f, at least %.2f is needed",
                      static_cast<double>(seen.distinctness), settings_.saliency.distinctness_min);
  Fixation fixation = new_fixation(view.utime_us, Status::no_salient_object, std::move(reason));
  fixation.views = 1;
  fixation.head_1 = view.head;
  fixation.saliency = seen.saliency;
  fixation.distinctness = seen.distinctness;
  finish(std::move(fixation), output);
}

void Cycle::aim(const View& view, const Pixel& target, const SaliencyResult& seen,
                CycleOutput& output) {
  first_.image.assign(view.image);
  first_.head = view.head;
  first_.utime_us = view.utime_us;
  first_.pixel = target;
  first_.saliency = seen.saliency;
  first_.distinctness = seen.distinctness;
  state_ = CycleState::turning;
  const HeadAngles inside = settings_.limits.clamp(view.head);
  if (greatest_difference(inside, view.head) > limits_slack_rad) {
    end_by_head_fault(
        text("measured head angles (%.3f, %.3f) rad lie outside the limits; nearest allowed: "
             "(%.3f, %.3f)",
             view.head.yaw_rad, view.head.pitch_rad, inside.yaw_rad, inside.pitch_rad),
        view.utime_us, output);
    return;
  }
  commanded_ = next_look(settings_.camera, settings_.limits, inside, target);
  command_utime_us_ = std::max(view.utime_us, history_.newest().utime_us);
  attention_.head_moved();
  output.command = HeadCommand{command_utime_us_, commanded_, settings_.speed_fraction};
}

void Cycle::relook(const View& view, CycleOutput& output) {
  state_ = CycleState::locating;
  const SaliencyResult seen = saliency_.look(view.image, attention_.context_for(view));
  output.saliency = UsedSaliency{view.utime_us, seen};
  Fixation fixation = new_fixation(view.utime_us, Status::target_lost, {});
  tell_first_view(fixation);
  fixation.views = 2;
  fixation.head_2 = view.head;
  fixation.estimate = locate(view, seen.map, fixation.pixel_2);
  last_head_fault_us_.reset();
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
  PointEstimate estimate = estimate_point(settings_.head, settings_.camera, settings_.uncertainty,
                                          looks, settings_.gate);
  // What the library calls invalid is, seen from outside, a pixel without a ray: no target there.
  if (estimate.status == Status::invalid_input) estimate.status = Status::target_lost;
  return estimate;
}

}  // namespace gazed
