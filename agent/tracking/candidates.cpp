#include "agent/tracking/candidates.hpp"

#include <algorithm>
#include <utility>

namespace gazed::tracking {

namespace {

// Areas that differ in size by less than this are the same one, found in two windows or from two
// seeds.
constexpr float same_growth = 1.35F;
// A mark has at least this share of the area of the object that it is on, lies near its middle (as
// a share of half the object's size), and is convex; and the object stands out from its
// surroundings almost as clearly as the mark does from the object.
constexpr float mark_share_min = 1.0F / 12.0F;
constexpr float mark_off_centre = 0.25F;
constexpr float mark_filled_share = 0.85F;
constexpr float mark_clearness = 0.4F;
// Or the enclosing object stands out this much more. Without this, a table would enclose the things
// on it: it differs from the wall about as much as they differ from it.
constexpr float encloses_contrast = 2.5F;
constexpr float encloses_area = 2.0F;
constexpr float encloses_off_centre = 0.8F;
// An area that merely differs from the window's rim may be only the most conspicuous part of an
// object, such as a blotch of its pattern. The whole object then has an outline this much clearer.
constexpr float encloses_clearness = 2.0F;
// On a reduced window, one pixel of blur may move the outline outwards by this much.
constexpr float box_tolerance_px = 4.0F;
// The middle of an object lies within this distance, plus a share of its size, of the salient
// place.
constexpr float place_sigma_px = 8.0F;
constexpr float place_sigma_size = 0.25F;
// What draws the eye is not tiny: smaller areas are usually slivers along an outline.
constexpr float small_area_px = 100.0F;
// The outline is only known to about a cell, so finer windows suit small objects better.
constexpr float blurred_cells = 2.0F;
// An area inside another, unless it is a mark, is the object if its score is at least this share of
// the larger one's.
constexpr float inner_worth = 0.33F;

float worth(const Candidate& candidate) {
  const float off = (candidate.box_px.center() - candidate.salient_px).norm() /
                    (place_sigma_px + place_sigma_size * candidate.box_px.sizes().mean());
  const float cells =
      candidate.box_px.sizes().mean() / static_cast<float>(1 << candidate.cell_shift);
  const float outside_px = candidate.box_px.exteriorDistance(candidate.salient_px);
  const float beside = outside_px / place_sigma_px;
  const float size = candidate.area_px / (candidate.area_px + small_area_px);
  return candidate.clearness * candidate.solid_share * size * cells / (cells + blurred_cells) /
         ((1.0F + off * off) * (1.0F + beside * beside));
}

bool inside(const Candidate& inner, const Candidate& outer) {
  const float tolerance = box_tolerance_px + static_cast<float>(1 << outer.cell_shift);
  return (inner.box_px.min() - outer.box_px.min()).minCoeff() > -tolerance &&
         (outer.box_px.max() - inner.box_px.max()).minCoeff() > -tolerance;
}

bool is_mark_on(const Candidate& inner, const Candidate& outer) {
  const Eigen::Vector2f off = inner.box_px.center() - outer.box_px.center();
  const auto centred = [&](float share) {
    return (2.0F * off.cwiseAbs() - share * outer.box_px.sizes()).maxCoeff() < 0.0F;
  };
  if (outer.contrast > encloses_contrast * inner.contrast &&
      outer.area_px > encloses_area * inner.area_px && centred(encloses_off_centre)) {
    return true;
  }
  if (outer.of_one_colour && !inner.of_one_colour &&
      outer.clearness > encloses_clearness * inner.clearness && centred(encloses_off_centre)) {
    return true;
  }
  const float filled_px = outer.solid_share * outer.area_px + inner.area_px;
  return inner.area_px > mark_share_min * outer.area_px && centred(mark_off_centre) &&
         filled_px > mark_filled_share * outer.area_px &&
         worth(outer) > mark_clearness * worth(inner);
}

}  // namespace

void Candidates::add(const Candidate& candidate) {
  for (std::size_t i = 0; i < count_; ++i) {
    Candidate& other = all_[i];
    if (other.cell_shift != candidate.cell_shift ||
        other.of_one_colour != candidate.of_one_colour ||
        other.area_px > same_growth * candidate.area_px ||
        candidate.area_px > same_growth * other.area_px || !inside(other, candidate) ||
        !inside(candidate, other)) {
      continue;
    }
    if (worth(candidate) > worth(other)) other = candidate;
    return;
  }
  if (count_ == all_.size()) return;
  all_[count_] = candidate;
  all_[count_].number = count_;
  ++count_;
}

std::optional<Candidate> Candidates::best() {
  mark_.reset();
  if (count_ == 0) return std::nullopt;
  const auto end = all_.begin() + static_cast<std::ptrdiff_t>(count_);
  std::sort(all_.begin(), end, [](const Candidate& a, const Candidate& b) {
    return std::pair(a.area_px, a.number) < std::pair(b.area_px, b.number);
  });
  const Candidate* best = all_.data();
  for (const Candidate* next = best + 1; next != all_.data() + count_; ++next) {
    const bool same = next->area_px < same_growth * best->area_px;
    const bool encloses = inside(*best, *next);
    const bool mark = encloses && !same && is_mark_on(*best, *next);
    float least = 1.0F;
    if (encloses && !same) least = mark ? 0.0F : 1.0F / inner_worth;
    if (!(worth(*next) > least * worth(*best))) continue;
    // The same area, found again, keeps its mark.
    if (mark) {
      mark_ = *best;
    } else if (!encloses || !same) {
      mark_.reset();
    }
    best = next;
  }
  return *best;
}

void Candidates::keep_around(const Candidate& mark) {
  const auto end = all_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto last = std::remove_if(all_.begin(), end, [&](const Candidate& other) {
    return !inside(mark, other) || other.area_px < same_growth * mark.area_px;
  });
  count_ = static_cast<std::size_t>(last - all_.begin());
}

}  // namespace gazed::tracking
