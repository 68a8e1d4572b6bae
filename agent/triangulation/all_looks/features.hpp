// The background's features in the problem of all looks: where they start from, and which of their
// pixels are to be believed.
#pragma once

#include <span>

#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/feature_observations.hpp"

namespace gazed::triangulation::all_looks {

/// Adds the features that look 1 and at least one later look of `looks` saw inside the frame, at
/// the inverse depth that the encoders' angles make of them, not below 0.
void add_features(std::span<const FeatureObservations> features, LookSet looks, Problem& problem,
                  State& state);

/// Of the features' residuals against their sigmas, by the median feature: half of them may be
/// wrong. At least 1.
[[nodiscard]] double typical_scale(const Problem& problem, const State& state);

struct FeatureAgreement {
  int pixels_seen = 0;  // in later looks, features behind the camera among them
  int pixels_kept = 0;
  double scale = 1.0;  // of the residuals of those kept against their sigmas, at least 1
  bool changed = false;
};

/// Decides anew, with the angles as they are, which pixels of each feature can be images of one
/// point (chi-square, 99.9 %): the pixel goes without which the others agree best, until they do.
/// They must be more than those that went, else the feature goes; so does one behind the camera.
[[nodiscard]] FeatureAgreement keep_agreeing(Problem& problem, const State& state);

}  // namespace gazed::triangulation::all_looks
