// Searches for many patches of view 1 in view 2 at the coarse level: first the one shift that
// errors of the measured angles cause in all of them, then each patch along its own epipolar line.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "agent/tracking/coarse.hpp"

namespace gazed::tracking {

/// A patch and where it may be, in samples of the coarse level: at `far` for a point at infinity,
/// at `far + span` for the nearest depth.
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
  /// The largest shift that can be found, samples.
  static constexpr int reach_max = 28;
  static constexpr std::size_t peaks_max = 3;

  CoarseSearch(int width, int height);

  [[nodiscard]] CoarseView& view() { return view_; }

  /// The shift, up to `reach` on either axis, with which most queries find their patch somewhere on
  /// their line. Each query votes for every shift; among equals the smallest wins.
  [[nodiscard]] Eigen::Vector2f common_shift(std::span<const CoarseQuery> queries, int reach);

  /// The best places at most `half_width` from the line moved by `shift`, or beyond its ends. Best
  /// first.
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
  std::vector<float> scores_;  // for a box of places
  std::vector<float> best_;    // for one query, by shift
  std::vector<float> votes_;   // by shift
  std::array<CoarsePeak, peaks_max> peaks_;
  std::size_t peak_count_ = 0;
};

}  // namespace gazed::tracking
