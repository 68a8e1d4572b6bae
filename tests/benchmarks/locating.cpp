#include "tests/benchmarks/locating.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "agent/triangulation/estimate.hpp"

#include "tests/unit/agent/tracking/bench.hpp"

namespace gazed::benchmarks {

namespace {

constexpr geometry::HeadAngles first_look{0.2, 0.1}, second_look{-0.1, 0.25};

/// Looks at points 0.25 to 1.0 m before the torso, spread over the field of view.
std::vector<triangulation::TwoLooks> looks_at_points(const geometry::Rig& rig) {
  constexpr int points = 64;
  std::vector<triangulation::TwoLooks> all;
  for (int i = 0; i < points; ++i) {
    const Eigen::Vector3d torso_point_m(0.25 + 0.75 * i / points, 0.05 * std::sin(i),
                                        0.15 + 0.05 * std::cos(2 * i));
    const auto pixel_1 = geometry::project(
        rig.camera, geometry::cam_from_torso(rig.head, first_look) * torso_point_m);
    const auto pixel_2 = geometry::project(
        rig.camera, geometry::cam_from_torso(rig.head, second_look) * torso_point_m);
    if (!pixel_1 || !pixel_2) throw std::logic_error("a point that the camera does not see");
    // As a registration would have it: a few tenths of a pixel off, and its covariance.
    const geometry::Pixel error(0.2 * std::sin(3 * i), 0.2 * std::cos(5 * i));
    all.push_back(
        {first_look, second_look, *pixel_1, *pixel_2 + error, 0.04 * Eigen::Matrix2d::Identity()});
  }
  return all;
}

}  // namespace

void triangulate(benchmark::State& state, triangulation::methods::Method method) {
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;  // none of its sigmas is zero
  const std::vector<triangulation::TwoLooks> looks = looks_at_points(rig);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        triangulation::estimate_point(rig, looks[i++ % looks.size()], {}, method));
  }
}

void locate_two_views(benchmark::State& state) {
  constexpr double half_size_px = 40.0, range_m = 0.5;
  const tracking::Bench bench;
  const tracking::Scene scene =
      bench.scene(tracking::Object::textured, half_size_px, range_m, second_look);
  const tracking::Capture capture{.noise_levels = 2.0};
  base::Random random(1);
  const tracking::Shot shot_1 =
      tracking::expose(tracking::look(scene, scene.head_1), capture, random);
  const tracking::Shot shot_2 =
      tracking::expose(tracking::look(scene, second_look), capture, random);

  tracking::Registration registration = bench.registration();
  const auto pixel_1 =
      registration.choose_target(shot_1.view(), scene.object_px + tracking::winner_error);
  if (!pixel_1) return state.SkipWithError("no target chosen in view 1");
  for (auto _ : state) {
    const tracking::RegistrationResult found = registration.find(shot_2.view());
    if (!found.match) return state.SkipWithError(found.reason.c_str());
    const triangulation::TwoLooks looks{shot_1.head, shot_2.head, *pixel_1, found.match->pixel_2,
                                        found.match->covariance_px2};
    benchmark::DoNotOptimize(triangulation::estimate_point(bench.rig, looks, {}));
  }
}

}  // namespace gazed::benchmarks
