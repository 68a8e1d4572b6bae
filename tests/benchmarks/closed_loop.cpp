#include "tests/benchmarks/closed_loop.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace gazed::benchmarks {

namespace {

constexpr std::int64_t start_utime_us = 1'700'000'000'000'000;
constexpr std::int64_t longest_fixation_us = 120'000'000;

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

ClosedLoop::ClosedLoop(sim::Scene scene, const geometry::RobotProfile& profile,
                       const geometry::Rig& believed, const cycle::CycleSettings& settings,
                       std::uint64_t seed)
    : robot_(std::move(scene), profile, seed, start_utime_us), cycle_(believed, settings) {}

cycle::CycleOutput ClosedLoop::serve(JudgedFixation& judged) {
  const auto timed = [&judged](const auto& call) {
    const double start_ms = cpu_ms();
    cycle::CycleOutput output = call();
    judged.locate_ms = cpu_ms() - start_ms;
    judged.cycle_ms += judged.locate_ms;
    return output;
  };
  if (*robot_.next_state_utime_us() <= *robot_.next_frame_utime_us()) {
    const geometry::HeadState state = *robot_.next_state();
    return timed([&] { return cycle_.on_head_state(state); });
  }
  const geometry::Frame frame = *robot_.next_frame(
      [this](std::int64_t utime_us) { return cycle_.may_look_at_frame(utime_us); });
  return timed([&] { return cycle_.on_frame(frame); });
}

JudgedFixation ClosedLoop::next() {
  JudgedFixation judged;
  view_1_us_.reset();
  const std::int64_t end_us = robot_.now_us() + longest_fixation_us;
  while (robot_.now_us() < end_us) {
    cycle::CycleOutput output = serve(judged);
    if (output.command) robot_.command(*output.command);
    if (output.saliency && output.saliency->first_view) view_1_us_ = output.saliency->utime_us;
    if (!output.fixation) continue;
    judged.fixation = std::move(*output.fixation);
    judge(judged);
    robot_.next_test();
    return judged;
  }
  throw std::runtime_error("no fixation within two minutes");
}

void ClosedLoop::judge(JudgedFixation& judged) const {
  const cycle::Fixation& fixation = judged.fixation;
  if (!view_1_us_ || !fixation.pixel_1.allFinite()) return;
  const geometry::HeadAngles angles = *robot_.true_angles(*view_1_us_, fixation.pixel_1.y());
  judged.truth = robot_.true_hit_in_frame(*view_1_us_, fixation.pixel_1);
  if (!judged.truth || !fixation.estimate.torso_point_m.allFinite()) return;
  const sim::SimTruth truth = robot_.truth();
  const geometry::Pose torso_from_cam = geometry::cam_from_torso(truth.head, angles).inverse();
  const Eigen::Vector3d true_ray =
      torso_from_cam.rotation * geometry::normalise(truth.camera, fixation.pixel_1)->homogeneous();
  judged.bearing_error_rad =
      angle_between(fixation.estimate.torso_point_m - torso_from_cam.translation, true_ray);
}

}  // namespace gazed::benchmarks
