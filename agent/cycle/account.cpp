// How a track reports the way its estimate was reached.
#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "agent/cycle/track.hpp"
#include "agent/triangulation/report_answer.hpp"

namespace gazed::cycle {

namespace {

using triangulation::all_looks::BelievedRobot;

/// Camera 1's centre in a look's image. Whether it is in front or behind, this is where the
/// epipolar lines meet.
geometry::Pixel epipole(const BelievedRobot& robot, geometry::HeadAngles reading_1,
                        const FixationLook& look) {
  const Eigen::Vector3d centre_in_torso_m =
      look.torso_1_from_torso.inverse() *
      geometry::cam_from_torso(robot.head, reading_1).inverse().translation;
  const Eigen::Vector3d centre_m =
      geometry::cam_from_torso(robot.head, look.refined) * centre_in_torso_m;
  const auto in_front = geometry::project(robot.camera, centre_m);
  return in_front ? *in_front : geometry::project(robot.camera, -centre_m).value_or(no_pixel());
}

}  // namespace

void Track::account_for(Fixation& fixation) const {
  fixation.look_count = static_cast<std::size_t>(views_taken_);
  std::size_t place = 0;  // index among the looks that saw the target
  for (std::size_t i = 0; i < fixation.look_count; ++i) {
    const Taken& taken = taken_[i];
    FixationLook& look = fixation.looks[i];
    look.utime_us = taken.utime_us;
    look.measured = taken.look.head;
    look.pixel = taken.look.pixel;
    look.reason = taken.missed;
    if (taken.missed.empty()) account_for_look(taken, place++, look);
  }
  fixation.outline = registration_.outline();
  fixation.patch_half_size_px = registration_.half_size_px();
  fixation.budget = found_.budget;
  if (looks_count_ >= triangulation::looks_min) fixation.robot = found_.robot;
  fixation.features_used = found_.features_used;
  fixation.features_rejected = found_.features_rejected;
  if (views_taken_ < 2) return;
  fixation.report_position_m = triangulation::report_answer_m(
      rig_, {taken_[0].look.head, taken_[1].look.head, taken_[0].winner, taken_[1].winner});
  const Eigen::Vector3d in_cam1_m =
      geometry::cam_from_torso(rig_.head, taken_[0].look.head) * fixation.report_position_m;
  fixation.report_range_m = std::copysign(in_cam1_m.norm(), in_cam1_m.z());
}

/// For a look that saw the target.
void Track::account_for_look(const Taken& taken, std::size_t place, FixationLook& out) const {
  out.covariance_px2 = taken.look.covariance_px2;
  for (const triangulation::FeatureObservations& feature : background_.features()) {
    const geometry::Pixel& pixel = feature.pixel[place];
    if (!pixel.allFinite()) continue;
    const auto index = static_cast<std::size_t>(&feature - background_.features().data());
    const bool used = (found_.feature_used_in[index] >> place & 1U) != 0;
    out.corners[out.corner_count++] = {pixel.cast<float>(), used};
  }
  if (looks_count_ < triangulation::looks_min) return;
  const triangulation::all_looks::LookVerdict& verdict = found_.looks[place];
  out.refined = found_.reading[place];
  out.torso_1_from_torso = found_.torso_1_from_torso[place];
  out.used = verdict.used;
  out.chi2 = verdict.chi2;
  out.pair_inverse_range_per_m = verdict.inverse_range_per_m;
  out.pair_inverse_range_sigma_per_m = verdict.inverse_range_sigma_per_m;
  if (place > 0) out.epipole = epipole(found_.robot, found_.reading.front(), out);
  if (!out.used) out.reason = verdict.reason.empty() ? found_.point.reason : verdict.reason;
}

}  // namespace gazed::cycle
