#include "agent/tracking/search.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace gazed::tracking {

namespace {

// The segment is searched in pieces, each with a template made for its middle, because size and
// shape change along the segment.
constexpr int pieces = 4;
// The rotated camera may see the patch larger than view 1 does: by 1 / cos^2 of the angle off the
// axis, and by the approach.
constexpr double reach_growth = 1.3;
// A place is a candidate from this correlation on; noise and the coarse grid cost some.
constexpr float candidate_correlation = 0.4F;
// A flat place has no correlation: a variance, summed over the patch, below this share of the mean
// square is rounding and noise.
constexpr float flat_share = 1e-3F;

bool covers(const Patch& patch, const ObjectMask& object, const geometry::Pixel& pixel) {
  return object.distance_px(static_cast<int>(std::lround(pixel.x())),
                            static_cast<int>(std::lround(pixel.y()))) <= patch.margin_px;
}

}  // namespace

void PatchSearch::reserve(int width_px, int height_px) {
  const auto area = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) / 4;
  scores_.reserve(area);
  for (auto* row : {&products_, &sums_, &squares_})
    row->reserve(static_cast<std::size_t>(width_px));
  template_.reserve(4096);
}

int PatchSearch::run(const Patch& patch, int level, const ObjectMask& object,
                     const PatchMotion& motion, const geometry::CameraModel& camera,
                     const EpipolarSegment& segment, double margin_px, double separation_px,
                     const PlaneLevel& plane_2) {
  found_ = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    constexpr double knots_per_piece = (EpipolarSegment::knots - 1) / double{pieces};
    const double first = piece * knots_per_piece;
    if (!make_template(patch, level, object, motion, camera,
                       segment.inverse_depth_at(first + 0.5 * knots_per_piece))) {
      continue;
    }
    const geometry::Pixel& from = segment.knot(static_cast<int>(first));
    const geometry::Pixel& to = segment.knot(static_cast<int>(first + knots_per_piece));
    const geometry::Pixel margin(margin_px, margin_px),
        frame(camera.width_px - 1, camera.height_px - 1);
    const geometry::Pixel low = (from.cwiseMin(to) - margin).cwiseMax(0.0);
    const geometry::Pixel high = (from.cwiseMax(to) + margin).cwiseMin(frame);
    const Eigen::Vector2d low_at = plane_2.to_samples(low), high_at = plane_2.to_samples(high);
    const int x_begin = static_cast<int>(std::ceil(low_at.x()));
    const int y_begin = static_cast<int>(std::ceil(low_at.y()));
    const int width = static_cast<int>(std::floor(high_at.x())) - x_begin + 1;
    const int height = static_cast<int>(std::floor(high_at.y())) - y_begin + 1;
    if (width < 1 || height < 1) continue;
    correlate(plane_2, x_begin, y_begin, width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!is_peak(x, y, width, height)) continue;
        const float score = scores_[static_cast<std::size_t>(y * width + x)];
        const geometry::Pixel pixel = plane_2.to_pixel({x_begin + x, y_begin + y});
        if (segment.nearest(pixel).distance_px > margin_px) continue;
        add_candidate({pixel, score}, separation_px);
      }
    }
  }
  return found_;
}

bool PatchSearch::is_peak(int x, int y, int width, int height) const {
  const float score = scores_[static_cast<std::size_t>(y * width + x)];
  if (score < candidate_correlation) return false;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
      if (scores_[static_cast<std::size_t>(v * width + u)] > score) return false;
    }
  }
  return true;
}

// The patch as view 2 would see it at this inverse depth, on view 2's sample grid around the
// reference point; zero mean, unit norm.
bool PatchSearch::make_template(const Patch& patch, int level, const ObjectMask& object,
                                const PatchMotion& motion, const geometry::CameraModel& camera,
                                double inverse_depth) {
  template_.clear();
  PatchWarp warp;
  warp.inverse_depth_per_m = inverse_depth;
  const auto centre = motion.reference_in_view_2(camera, warp);
  if (!centre) return false;
  const Eigen::Matrix3d back = motion.homography(warp).inverse();
  const PlaneLevel& plane = patch.planes.level(level);
  const int reach = static_cast<int>(std::ceil(reach_growth * patch.half_size_px / plane.step_px));
  float sum = 0.0F;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto seen_2 =
          geometry::normalise(camera, *centre + plane.step_px * Eigen::Vector2d(dx, dy));
      if (!seen_2) continue;
      const auto pixel = geometry::project(camera, back * seen_2->homogeneous());
      if (!pixel || !camera.contains(*pixel, 1.0)) continue;
      const Eigen::Vector2d at = plane.to_samples(*pixel);
      if (!plane.readable(at) || !covers(patch, object, *pixel)) continue;
      template_.push_back({dx, dy, plane.read(at).value});
      sum += template_.back().value;
    }
  }
  constexpr std::size_t samples_min = 12;
  if (template_.size() < samples_min) return false;
  const float mean = sum / static_cast<float>(template_.size());
  float norm2 = 0.0F;
  for (TemplateSample& sample : template_) {
    sample.value -= mean;
    norm2 += sample.value * sample.value;
  }
  if (!(norm2 > 0.0F)) return false;
  const float inverse_norm = 1.0F / std::sqrt(norm2);
  for (TemplateSample& sample : template_) sample.value *= inverse_norm;
  return true;
}

// Goes through the template sample by sample, over a whole row of places at a time, so that every
// inner loop is element-wise. Places whose template would leave the plane get 0.
void PatchSearch::correlate(const PlaneLevel& plane, int x_begin, int y_begin, int width,
                            int height) {
  int reach = 0;
  for (const TemplateSample& s : template_) {
    reach = std::max({reach, std::abs(s.dx), std::abs(s.dy)});
  }
  scores_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  const int x_first = std::max(x_begin, reach);
  const int count = std::min(x_begin + width, plane.width - reach) - x_first;
  if (count <= 0) return;
  for (auto* row : {&products_, &sums_, &squares_}) row->resize(static_cast<std::size_t>(count));
  const float inverse_n = 1.0F / static_cast<float>(template_.size());
  float *products = products_.data(), *sums = sums_.data(), *squares = squares_.data();
  for (int y = std::max(y_begin, reach); y < std::min(y_begin + height, plane.height - reach);
       ++y) {
    for (auto* row : {&products_, &sums_, &squares_}) std::fill(row->begin(), row->end(), 0.0F);
    for (const TemplateSample& s : template_) {
      const float* values = plane.row(y + s.dy) + x_first + s.dx;
      for (int x = 0; x < count; ++x) {
        products[x] += s.value * values[x];
        sums[x] += values[x];
        squares[x] += values[x] * values[x];
      }
    }
    float* scores = scores_.data() + (y - y_begin) * width + (x_first - x_begin);
    for (int x = 0; x < count; ++x) {
      const float variance = squares[x] - sums[x] * sums[x] * inverse_n;
      scores[x] =
          variance > flat_share * squares[x] * inverse_n ? products[x] / std::sqrt(variance) : 0.0F;
    }
  }
}

// Keeps the best candidates, sorted; of two that are close to each other, the better one.
void PatchSearch::add_candidate(const SearchCandidate& candidate, double separation_px) {
  for (int i = 0; i < found_; ++i) {
    SearchCandidate& other = candidates_[static_cast<std::size_t>(i)];
    if ((other.pixel - candidate.pixel).norm() >= separation_px) continue;
    if (other.correlation >= candidate.correlation) return;
    std::move(candidates_.begin() + i + 1, candidates_.begin() + found_, candidates_.begin() + i);
    --found_;
    --i;
  }
  int place = 0;
  while (place < found_ && this->candidate(place).correlation >= candidate.correlation) ++place;
  if (place == max_candidates) return;
  found_ = std::min(found_ + 1, max_candidates);
  std::move_backward(candidates_.begin() + place, candidates_.begin() + found_ - 1,
                     candidates_.begin() + found_);
  candidates_[static_cast<std::size_t>(place)] = candidate;
}

}  // namespace gazed::tracking
