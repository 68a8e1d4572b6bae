// Benchmarks of what comes after saliency: from two looks to a point.
#pragma once

#include <benchmark/benchmark.h>

#include "agent/triangulation/methods/method.hpp"

namespace gazed::benchmarks {

/// One point from two looks: triangulation by `method` with the covariance of every error source of
/// a head, 64 points in turn.
void triangulate(benchmark::State& state, triangulation::methods::Method method);

/// The same point in a rendered second view, and its estimate: what is done between the capture of
/// image 2 and the published point, saliency aside.
void locate_two_views(benchmark::State& state);

}  // namespace gazed::benchmarks
