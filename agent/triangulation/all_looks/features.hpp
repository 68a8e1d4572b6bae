// The background's features in the all-looks problem: their initial values, and which of their
// pixels to believe.
#pragma once

#include <span>

#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/feature_observations.hpp"

namespace gazed::triangulation::all_looks {

/// Adds the features that look 1 and at least one later look of `looks` saw inside the frame.
/// Initial inverse depths come from the encoders' angles and are at least 0.
void add_features(std::span<const FeatureObservations> features, LookSet looks, Problem& problem,
                  State& state);

/// How much the features' residuals exceed their sigmas, at least 1. Taken from the median feature,
/// so half of them may be wrong.
[[nodiscard]] double typical_scale(const Problem& problem, const State& state);

struct FeatureAgreement {
  int pixels_seen = 0;  // in later looks, including those of features behind the camera
  int pixels_kept = 0;
  double scale = 1.0;  // how much the residuals of the kept pixels exceed their sigmas, at least 1
  bool changed = false;
};

/// Decides again, for the current angles, which pixels of each feature can be images of one point
/// (chi-square, 99.9 %): removes the pixel without which the others agree best, until they agree.
/// If fewer pixels are kept than were removed, the feature is left out; so is a feature behind the
/// camera.
[[nodiscard]] FeatureAgreement keep_agreeing(Problem& problem, const State& state);

}  // namespace gazed::triangulation::all_looks
