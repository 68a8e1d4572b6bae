#include "agent/saliency/inhibition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "agent/base/utime.hpp"
#include "agent/saliency/map_rays.hpp"

namespace gazed::saliency {

namespace {

// Smaller strengths and Gaussians count as 0; exp(-x^2 / 2) at x = 4 is 3e-4.
constexpr double least_strength = 1.0 / 256.0;
constexpr double gaussian_reach = 4.0;

std::vector<Eigen::Vector3f> as_floats(const std::vector<Eigen::Vector3d>& rays) {
  std::vector<Eigen::Vector3f> floats;
  floats.reserve(rays.size());
  for (const Eigen::Vector3d& ray : rays) floats.emplace_back(ray.cast<float>());
  return floats;
}

}  // namespace

void inhibit(const PlaneView<std::int32_t>& saliency, std::span<const std::uint16_t> kept) {
  if (kept.empty()) return;
  auto share = kept.begin();
  for (int y = 0; y < saliency.height; ++y) {
    std::int32_t* row = saliency.row(y);
    for (int x = 0; x < saliency.width; ++x, ++share)
      row[x] = static_cast<std::int32_t>((std::int64_t{row[x]} * *share) >> kept_fraction_bits);
  }
}

Inhibition::Inhibition(const geometry::CameraModel& camera, double radius_rad, double decay_s)
    : radius_rad_(radius_rad),
      decay_s_(decay_s),
      rays_(as_floats(rays_of_map(camera))),
      kept_(rays_.size()) {}

Inhibition::Place& Inhibition::place_for(const Eigen::Vector3d& direction) {
  const auto end = places_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto near = std::find_if(places_.begin(), end, [&](const Place& place) {
    return (place.direction - direction).norm() < radius_rad_;
  });
  if (near != end) return *near;
  if (count_ < most_places) return places_[count_++];
  return *std::min_element(places_.begin(), end,
                           [](const Place& a, const Place& b) { return a.utime_us < b.utime_us; });
}

void Inhibition::add(const Eigen::Vector3d& direction_in_torso, std::int64_t utime_us) {
  const Eigen::Vector3d direction = direction_in_torso.normalized();
  place_for(direction) = {direction, utime_us};
}

// Angles are approximated by chords, which are 4 % shorter at 1 rad.
bool Inhibition::multiply(const Eigen::Vector3f& direction_in_cam, double strength) {
  const double twice_variance = 2.0 * radius_rad_ * radius_rad_;
  const double reach2 = gaussian_reach * gaussian_reach * radius_rad_ * radius_rad_;
  bool in_view = false;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const double angle2 = double{(rays_[i] - direction_in_cam).squaredNorm()};
    if (!(angle2 <= reach2)) continue;
    const double left = 1.0 - strength * std::exp(-angle2 / twice_variance);
    kept_[i] = static_cast<std::uint16_t>(std::lround(kept_[i] * left));
    in_view = true;
  }
  return in_view;
}

std::span<const std::uint16_t> Inhibition::kept(const geometry::Pose& cam_from_torso,
                                                std::int64_t utime_us) {
  std::fill(kept_.begin(), kept_.end(), static_cast<std::uint16_t>(all_kept));
  bool in_view = false;
  for (std::size_t i = 0; i < count_;) {
    const double age_s = base::seconds_between(places_[i].utime_us, utime_us);
    const double strength = std::exp(-age_s / decay_s_);
    if (age_s < 0.0 || strength < least_strength) {
      places_[i] = places_[--count_];
      continue;
    }
    const Eigen::Vector3d in_cam = cam_from_torso.rotation * places_[i].direction;
    in_view |= multiply(in_cam.cast<float>(), strength);
    ++i;
  }
  if (!in_view) return {};
  return kept_;
}

}  // namespace gazed::saliency
