#include "agent/cycle/track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/gaze/step_rule.hpp"

namespace gazed::cycle {

namespace {

// A target that two looks in a row do not find is not there.
constexpr int misses_max = 2;

// Saliency cannot confirm what the border of the frame may cut: that is not surrounded. A sample of
// the map has its share of pixels within this distance.
constexpr double reach_of_map_px = 2.0 * saliency::saliency_cell_px;
// A look that is not expected to make the sigma smaller by this share is not taken.
constexpr double least_gain = 0.1;
// Looks whose chi-square is over this many times its degrees of freedom may show an object that
// moves, though each may differ so by chance: one in ten does.
constexpr double agreement_max = 2.0;
// Motion along the line of sight looks like another range in two looks. Of looks that differ nobody
// can tell chance from motion where they have fewer degrees of freedom, those of three later looks.
constexpr int looks_that_show_motion = 3;
constexpr int motion_degrees_min = 5;
// Of the report's six steps (Russcher 2011, 4.4).
constexpr int report_looks = 2;

// A camera that is turned in its head otherwise than was believed turns its image as the head
// turns. Half a radian makes that a hundredth of a pixel per milliradian at a target's outline:
// what is less than this is within the registration's own error.
constexpr double mount_error_rad = 0.01;

triangulation::PointEstimate lost(std::string reason) {
  triangulation::PointEstimate out;
  out.status = triangulation::Status::target_lost;
  out.reason = std::move(reason);
  return out;
}

}  // namespace

Track::Track(const geometry::Rig& rig, const geometry::HeadLimits& limits,
             const LocateSettings& settings, double move_margin_rad,
             std::function<void()> meanwhile)
    : rig_(rig),
      limits_(limits),
      settings_(settings),
      move_margin_rad_(move_margin_rad),
      meanwhile_(std::move(meanwhile)),
      registration_(rig, settings.registration),
      background_(rig) {
  constexpr int looks_min = triangulation::looks_min, looks_max = triangulation::looks_max;
  const auto check = [](const char* name, int looks) {
    if (looks >= looks_min && looks <= looks_max) return;
    throw std::invalid_argument(
        base::text("%s is %d, must be %d to %d", name, looks, looks_min, looks_max));
  };
  check("looks", settings.looks);
  check("looks_min", settings.looks_min);
}

// Rolling shutter. A look's pose is the head's when the row with the target was exposed, and its
// sweep tells how the head stood at the background's corners in other rows. The patch's own rows
// are taken to be seen from the target's: what the sweep does to so few is in the warp's scale and
// slopes.
std::optional<geometry::Pixel> Track::start(const geometry::View& view_1,
                                            const saliency::SaliencyResult& seen) {
  registration_.believe(rig_.head);
  background_.believe(rig_.head);
  believed_head_ = rig_.head;
  std::optional<geometry::Pixel> target = registration_.choose_target(view_1, seen.peak_px);
  meanwhile_();
  if (!target) return std::nullopt;
  appearance_ = saliency::appearance_at(seen.planes, *target);
  if (const auto mark = registration_.mark()) {
    mark_appearance_ = saliency::appearance_at(seen.planes, *mark);
  }
  view_1_ = view_1;
  view_1_.image.data = nullptr;  // it is the camera's
  background_.choose(view_1, *target, std::numbers::sqrt2 * registration_.half_size_px());
  looks_.front() = first_look(*target);
  const geometry::HeadAngles from = limits_.clamp(looks_.front().head);
  first_move_ = gaze::next_look(rig_.camera, limits_, from, *target) - from;
  looks_count_ = 1;
  last_used_ = 0;
  last_ = {.head = looks_.front().head,
           .pixel = geometry::Pixel::Constant(triangulation::not_a_number)};
  last_utime_us_ = view_1.utime_us;
  taken_.front() = {view_1.utime_us, looks_.front(), {}, seen.peak_px};
  views_taken_ = 1;
  missed_in_a_row_ = looks_used_ = 0;
  planned_.reset();
  estimate_ = lost("no second look yet");
  found_ = {};
  return target;
}

triangulation::all_looks::Look Track::first_look(const geometry::Pixel& target) const {
  return {.head = view_1_.head_at_row(target.y()),
          .pixel = target,
          .sweep = view_1_.sweep,
          .sweep_sigma_rad = view_1_.sweep_sigma_rad};
}

void Track::add(const geometry::View& view, const saliency::SaliencyResult& seen) {
  ++views_taken_;
  planned_.reset();
  const std::string missed = find(view, seen);
  taken_[static_cast<std::size_t>(views_taken_) - 1] = {view.utime_us, last_, missed, seen.peak_px};
  meanwhile_();
  missed_in_a_row_ = missed.empty() ? 0 : missed_in_a_row_ + 1;
  if (missed.empty()) {
    ++looks_count_;
    take_look(view);
  }
  estimate_anew(missed, limits_.clamp(view.head));
  if (missed.empty() && believe(found_.robot.head)) look_again(view, seen);
}

void Track::take_look(const geometry::View& view) {
  const std::size_t place = looks_count_ - 1;
  background_.follow(view, place);
  meanwhile_();
  utimes_us_[place] = view.utime_us;
  looks_[place] = last_;
}

/// Once more, now that the looks have told how the camera is turned in the head. Where that finds
/// nothing, what was found before stands.
void Track::look_again(const geometry::View& view, const saliency::SaliencyResult& seen) {
  const triangulation::all_looks::Look before = last_;
  if (!find(view, seen).empty()) {
    last_ = before;
    return;
  }
  meanwhile_();
  taken_[static_cast<std::size_t>(views_taken_) - 1].look = last_;
  take_look(view);
  planned_.reset();
  estimate_anew({}, limits_.clamp(view.head));
}

bool Track::believe(const geometry::HeadGeometry& head) {
  if (found_.refinement != triangulation::all_looks::Refinement::used ||
      !((head.mount_rotation_rad - believed_head_.mount_rotation_rad).norm() > mount_error_rad)) {
    return false;
  }
  believed_head_ = head;
  registration_.believe(head);
  background_.believe(head);
  return true;
}

std::string Track::find(const geometry::View& view, const saliency::SaliencyResult& seen) {
  const tracking::RegistrationResult found = registration_.find(view);
  last_ = {.head = view.head,
           .pixel = geometry::Pixel::Constant(triangulation::not_a_number),
           .sweep = view.sweep,
           .sweep_sigma_rad = view.sweep_sigma_rad};
  last_utime_us_ = view.utime_us;
  if (!found.match) return found.reason;
  if (found.match->pixel_1 != looks_.front().pixel) {
    looks_.front() = taken_.front().look = first_look(found.match->pixel_1);
    appearance_ = mark_appearance_;
  }
  last_.pixel = found.match->pixel_2;
  last_.head = view.head_at_row(last_.pixel.y());
  last_.covariance_px2 = found.match->covariance_px2;
  if (!is_whole(last_.pixel)) return {};
  return confirm(seen);
}

std::string Track::confirm(const saliency::SaliencyResult& seen) const {
  const saliency::Confirmation confirmation = saliency::confirm(seen, last_.pixel, appearance_);
  if (confirmation.salient() && confirmation.alike()) return {};
  const std::string place = base::text("at (%.1f, %.1f) px ", last_.pixel.x(), last_.pixel.y());
  if (!confirmation.salient())
    return place + base::text(
                       "the saliency of view %d is %.0f %% of its peak; at least %.0f %% is "
                       "needed",
                       views_taken_, 100 * confirmation.share,
                       100 * saliency::Confirmation::least_share);
  return place + base::text(
                     "view %d has another colour, contrast or size than view 1: they are "
                     "alike by %.2f; at least %.2f is needed",
                     views_taken_, confirmation.likeness, saliency::Confirmation::least_likeness);
}

bool Track::is_whole(const geometry::Pixel& pixel) const {
  return rig_.camera.contains(pixel, registration_.half_size_px() + reach_of_map_px);
}

void Track::estimate_anew(const std::string& missed, geometry::HeadAngles current) {
  if (looks_count_ < 2) {
    estimate_ = lost(missed);
    return;
  }
  if (!missed.empty()) return;
  found_ = triangulation::all_looks::locate(
      rig_, std::span(looks_).first(looks_count_), background_.features(), settings_.gate,
      [this, current](const auto& found) { return planned_look(found, current); });
  last_used_ = 0;
  for (std::size_t k = 1; k < looks_count_; ++k) {
    if (found_.looks[k].used) last_used_ = k;
  }
}

/// Where the next look would go that may be the last one too many; none where it is wanted anyway,
/// or not at all.
std::optional<geometry::HeadAngles> Track::planned_look(
    const triangulation::all_looks::Estimate& found, geometry::HeadAngles current) {
  estimate_ = found.point;
  looks_used_ = static_cast<int>(found.looks_used);
  const bool may_be_the_last = views_taken_ < looks_most() && outvote(settings_.looks_min);
  if (!may_be_the_last || is_good_enough() || !agree(found)) return std::nullopt;
  planned_ = {current, next_look(current)};
  return planned_->to;
}

bool Track::may_show_motion() const {
  if (looks_used_ == 0) return false;
  const int least = std::min({looks_that_show_motion, settings_.looks_min, looks_most()});
  const bool tell_why = looks_most() == 2 || found_.degrees_of_freedom >= motion_degrees_min;
  return !outvote(least) || (!agree(found_) && !tell_why);
}

/// As many looks agree as there must be, and one more for each that sees the target and contradicts
/// them: where an object moves along the line of sight, a few looks agree by chance.
bool Track::outvote(int least) const {
  return looks_used_ >= least + looks_against();
}

/// Looks may differ by chance, but what an object's motion does shows in nothing else.
bool Track::agree(const triangulation::all_looks::Estimate& found) {
  return found.chi2 <= agreement_max * found.degrees_of_freedom;
}

int Track::looks_most() const {
  return settings_.method == LocateMethod::report ? report_looks : settings_.looks;
}

bool Track::is_good_enough() const {
  return estimate_.inverse_range_sigma_per_m <=
         settings_.relative_sigma_goal * estimate_.inverse_range_per_m;
}

bool Track::complete() const {
  if (views_taken_ >= looks_most() || missed_in_a_row_ >= misses_max) return true;
  if (!outvote(settings_.looks_min) || !agree(found_)) return false;
  // Where nothing is expected, nobody knows what another look would tell.
  return is_good_enough() ||
         found_.expected_sigma_per_m > (1.0 - least_gain) * estimate_.inverse_range_sigma_per_m;
}

}  // namespace gazed::cycle
