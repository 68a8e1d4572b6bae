// One target while it is looked at: its patch, by which it is found again, the looks so far, what
// they tell together, and where to look next.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "agent/cycle/fixation.hpp"
#include "agent/cycle/settings.hpp"
#include "agent/gaze/planner.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/limits.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/geometry/view.hpp"
#include "agent/saliency/appearance.hpp"
#include "agent/saliency/saliency.hpp"
#include "agent/tracking/background.hpp"
#include "agent/tracking/registration.hpp"
#include "agent/triangulation/all_looks/locate.hpp"

namespace gazed::cycle {

class Track {
 public:
  /// Throws std::invalid_argument for looks out of range and what Registration refuses. Moves are
  /// longer by `move_margin_rad` than they must be. `meanwhile` is called between the steps of
  /// start() and add().
  Track(const geometry::Rig& rig, const geometry::HeadLimits& limits,
        const LocateSettings& settings, double move_margin_rad, std::function<void()> meanwhile);

  /// Chooses a target near the most salient place of look 1; none as Registration::choose_target.
  /// Everything before is forgotten.
  [[nodiscard]] std::optional<geometry::Pixel> start(const geometry::View& view_1,
                                                     const saliency::SaliencyResult& seen);

  /// Why start() chose none; empty when it chose one.
  [[nodiscard]] const char* refusal() const { return registration_.refusal(); }

  /// A later look. The target counts as seen where its patch is found, the look's own saliency map
  /// calls that place salient too, and it looks there as in look 1; then the background is followed
  /// into the look as well.
  void add(const geometry::View& view, const saliency::SaliencyResult& seen);

  /// No more looks: the point is known well enough, or another look is not expected to tell a tenth
  /// more, or there are as many as there may be, or the target was missed twice in a row.
  [[nodiscard]] bool complete() const;

  /// Where the next look goes, with the head at `current`. The first is the step rule's; later ones
  /// are too, or the planner's where it finds one. All are longer by the margin, inside the limits.
  [[nodiscard]] geometry::HeadAngles next_look(geometry::HeadAngles current) const;
  /// The point to pass on the way there, so that the gears rest on the side they came from with the
  /// first move, `overshoot_rad` beyond the look; none where they do anyway, and by the rule.
  [[nodiscard]] std::optional<geometry::HeadAngles> on_the_way_to(geometry::HeadAngles look,
                                                                  geometry::HeadAngles current,
                                                                  double overshoot_rad) const;

  /// What the looks so far tell; TARGET_LOST while no later look has seen the target.
  [[nodiscard]] const triangulation::PointEstimate& estimate() const { return estimate_; }
  /// The object may move: only two looks saw it and more were wanted, or too few agree for those
  /// that contradict them, or they differ by more than they mostly do by chance and are too few to
  /// tell why.
  [[nodiscard]] bool may_show_motion() const;
  [[nodiscard]] double chi2() const { return found_.chi2; }
  /// Looks that see the target and contradict those that the estimate is made of.
  [[nodiscard]] int looks_against() const { return static_cast<int>(looks_count_) - looks_used_; }
  /// Looks taken, whether they saw the target or not.
  [[nodiscard]] int views_taken() const { return views_taken_; }
  [[nodiscard]] bool missed_last_look() const { return missed_in_a_row_ > 0; }
  /// Looks that the estimate is made of, with the first; 0 when there is none.
  [[nodiscard]] int looks_used() const { return looks_used_; }
  [[nodiscard]] const triangulation::all_looks::Look& first() const { return looks_.front(); }
  /// The measured angles of the last look, whether it saw the target or not.
  [[nodiscard]] geometry::HeadAngles last_head() const { return last_.head; }
  /// The last later look that the estimate is made of; where there is none, the last one taken,
  /// whose pixel is NaN when not even the patch was found.
  [[nodiscard]] const triangulation::all_looks::Look& last() const {
    return last_used_ > 0 ? looks_[last_used_] : last_;
  }
  /// When its view was captured.
  [[nodiscard]] std::int64_t last_utime_us() const {
    return last_used_ > 0 ? utimes_us_[last_used_] : last_utime_us_;
  }

  /// How the estimate came about: the fields of a fixation from its looks on.
  void account_for(Fixation& fixation) const;
  /// What is believed of a robot that has not looked yet.
  [[nodiscard]] triangulation::all_looks::BelievedRobot believed_before() const {
    return triangulation::all_looks::believed_before(rig_);
  }

 private:
  /// A view, whether it saw the target or not.
  struct Taken {
    std::int64_t utime_us = 0;
    triangulation::all_looks::Look look;
    std::string missed;  // why the target was not seen; empty where it was
    geometry::Pixel winner = geometry::Pixel::Zero();  // of its saliency map
  };

  /// A move that was worked out before it was wanted.
  struct Planned {
    geometry::HeadAngles from, to;
  };

  /// Registers target and background by what is believed of the head; false where it is believed
  /// already.
  bool believe(const geometry::HeadGeometry& head);
  void take_look(const geometry::View& view);
  void look_again(const geometry::View& view, const saliency::SaliencyResult& seen);
  [[nodiscard]] triangulation::all_looks::Look first_look(const geometry::Pixel& target) const;
  [[nodiscard]] std::string find(const geometry::View& view, const saliency::SaliencyResult& seen);
  [[nodiscard]] std::string confirm(const saliency::SaliencyResult& seen) const;
  /// The border of the frame cuts nothing of the target there.
  [[nodiscard]] bool is_whole(const geometry::Pixel& pixel) const;
  void account_for_look(const Taken& taken, std::size_t place, FixationLook& out) const;
  void estimate_anew(const std::string& missed, geometry::HeadAngles current);
  [[nodiscard]] std::optional<geometry::HeadAngles> planned_look(
      const triangulation::all_looks::Estimate& found, geometry::HeadAngles current);
  [[nodiscard]] static bool agree(const triangulation::all_looks::Estimate& found);
  [[nodiscard]] bool outvote(int least) const;
  [[nodiscard]] int looks_most() const;
  [[nodiscard]] bool is_good_enough() const;
  [[nodiscard]] std::optional<geometry::HeadAngles> most_informative_look(
      geometry::HeadAngles current) const;
  [[nodiscard]] std::optional<gaze::PlannedTarget> planned_target() const;
  [[nodiscard]] geometry::Pixel expected_pixel(geometry::HeadAngles current) const;

  geometry::Rig rig_;
  geometry::HeadLimits limits_;
  LocateSettings settings_;
  double move_margin_rad_;
  std::function<void()> meanwhile_;
  tracking::Registration registration_;
  geometry::View view_1_;                 // without its image
  geometry::HeadAngles first_move_;       // by the step rule
  saliency::Appearance appearance_;       // of the target in look 1
  saliency::Appearance mark_appearance_;  // of what may turn out to be the target
  tracking::Background background_;
  geometry::HeadGeometry believed_head_;  // by both
  std::array<triangulation::all_looks::Look, triangulation::looks_max>
      looks_;  // that saw the target
  std::array<std::int64_t, triangulation::looks_max> utimes_us_{};
  std::size_t looks_count_ = 0;
  std::size_t last_used_ = 0;
  triangulation::all_looks::Look last_;
  std::int64_t last_utime_us_ = 0;
  std::array<Taken, triangulation::looks_max> taken_;
  int views_taken_ = 0;
  int missed_in_a_row_ = 0;
  std::optional<Planned> planned_;
  int looks_used_ = 0;
  triangulation::PointEstimate estimate_;
  triangulation::all_looks::Estimate found_;  // of looks_, once there are two
};

}  // namespace gazed::cycle
