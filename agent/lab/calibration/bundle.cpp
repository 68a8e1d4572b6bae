#include "agent/lab/calibration/bundle.hpp"

#include <glog/logging.h>
#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/bundle_fit.hpp"

namespace gazed::lab::calibration {

namespace {

/// With the parameters as they are, what was seen fitted anew.
ResidualRms residuals_of(BundleFit& fit) {
  ResidualRms rms;
  fit.put_looks_back();
  fit.solve({.parameters = false, .looks = false}, coarse);
  rms.measured_px = fit.rms_px();
  fit.solve({.parameters = false, .looks = true}, coarse);
  rms.refined_px = fit.rms_px();
  return rms;
}

void check_size(const BundleInput& input) {
  const std::size_t equations = 2 * input.sightings.size();
  std::size_t unknowns = input.pattern_m.empty()
                             ? point_size * static_cast<std::size_t>(input.point_count)
                             : (input.pattern_held ? 0 : pose_size);
  unknowns += 2;  // the least that anybody calibrates
  if (equations >= unknowns && !input.looks.empty()) return;
  throw std::invalid_argument(
      base::text("%zu image points in %zu looks found; allowed: more than there are unknowns (%zu)",
                 input.sightings.size(), input.looks.size(), unknowns / 2));
}

}  // namespace

BundleResult adjust_bundle(const BundleInput& input) {
  check_size(input);
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres: what it has to say is in its return values
  BundleResult result;
  BundleFit fit(input);
  // The first errors are of the unknown mount, not of the image: a coarse scale at first, then the
  // residuals' own.
  constexpr double first_scale = 10.0;
  constexpr int rounds = 4;
  fit.pixel_sigma_px *= first_scale;
  for (int round = 0; round < rounds; ++round) {
    result.converged = fit.solve({}, coarse);
    if (!result.converged) break;
    fit.judge_sightings();
    fit.judge_looks();
  }
  result.converged = result.converged && fit.solve({}, fine);
  if (!result.converged) {
    result.sightings_used = fit.used();
    if (fit.used() > 0) result.after.measured_px = fit.rms_px();
    return result;
  }
  result.estimate = fit.parameters;
  result.looks = fit.refined_looks();
  result.neck_from_pattern = fit.pattern_place();
  result.sightings_used = fit.used();
  result.pixel_sigma_px = fit.pixel_sigma_px;
  result.encoder_sigma_rad = fit.encoder_sigma_rad;
  result.information = fit.information();
  BundleFit after = fit;
  result.after = residuals_of(after);
  fit.parameters = input.prior.mean;
  result.before = residuals_of(fit);
  return result;
}

}  // namespace gazed::lab::calibration
