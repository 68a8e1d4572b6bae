// The search for many patches of view 1 in view 2 at the coarse level: first the one shift that
// all of them have in common because the measured angles are wrong, then each patch along its
// epipolar line.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "agent/tracking/coarse.hpp"

namespace gazed::tracking {

/// A patch and the places where it may be, samples of the coarse level: `far` for a point at
/// infinity, `far + span` for the nearest.
struct CoarseQuery {
  CoarsePatch patch;
  Eigen::Vector2f far = Eigen::Vector2f::Zero();
  Eigen::Vector2f span = Eigen::Vector2f::Zero();
};

struct CoarsePeak {
  Eigen::Vector2f place = Eigen::Vector2f::Zero();
  float score = 0.0F;  // normalised correlation, squared
};

class CoarseSearch {
 public:
  /// Shifts up to this can be found, samples.
  static constexpr int reach_max = 28;
  static constexpr std::size_t peaks_max = 3;

  CoarseSearch(int width, int height);

  [[nodiscard]] CoarseView& view() { return view_; }

  /// The shift on both axes, up to `reach`, with which most queries find their patch somewhere on
  /// their line: each casts a vote for every shift. Among equals the smallest.
  [[nodiscard]] Eigen::Vector2f common_shift(std::span<const CoarseQuery> queries, int reach);

  /// The best places, at most `half_width` beside the line moved by `shift` or beyond its ends, in
  /// falling order.
  [[nodiscard]] std::span<const CoarsePeak> peaks(const CoarseQuery& query,
                                                  const Eigen::Vector2f& shift, float half_width);

 private:
  struct Box {
    int x_begin = 0, y_begin = 0, width = 0, height = 0;
  };

  void vote(const CoarseQuery& query, int reach);
  void correlate_strip(const CoarseQuery& query, const Eigen::Vector2f& from, float half_width,
                       const Box& box);
  void collect_peaks(const Box& box);
  void enter(const CoarsePeak& peak);

  CoarseView view_;
  std::vector<float> scores_;  // of a box of places
  std::vector<float> best_;    // of one query, by shift
  std::vector<float> votes_;   // by shift
  std::array<CoarsePeak, peaks_max> peaks_;
  std::size_t peak_count_ = 0;
};

}  // namespace gazed::tracking
