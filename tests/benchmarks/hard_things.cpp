#include "tests/benchmarks/hard_things.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gazed::benchmarks {

namespace {

/// The object's size stays: a ball of RoboCup's league, or a smaller one.
void make_ball(sim::Appearance& object, Strain strain, base::Random& random) {
  object.shape = sim::Shape::ball;
  object.mark = sim::Mark::none;
  object.size_m[1] = object.size_m[0];
  object.finish.shading = random.uniform(0.3, 0.7);
  if (strain == Strain::ball_pattern) {
    object.texture.pattern = sim::Pattern::leaves;
    object.texture.contrast = random.uniform(15.0, 40.0);
    object.texture.tile_m = object.size_m[0] * random.uniform(0.7, 2.0);
  } else if (strain == Strain::ball_glossy) {
    object.finish.gloss = random.uniform(0.3, 0.8);
    object.finish.shininess = 20 + static_cast<int>(60.0 * random.uniform());
  }
}

/// The lamp stands where a place on the object mirrors it into camera 1.
void add_highlight(sim::Scene& scene, base::Random& random, const Camera1& camera, Target& target) {
  sim::PlacedPlane& object = target.object;
  object.appearance.finish.gloss = random.uniform(0.3, 0.7);
  object.appearance.finish.shininess = 100 + static_cast<int>(300.0 * random.uniform());
  const double radius_m = 0.3 * object.appearance.size_m[0];
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(object.normal).normalized();
  const Eigen::Vector3d up = object.normal.normalized().cross(across);
  const double across_m = radius_m * random.symmetric(), up_m = radius_m * random.symmetric();
  const Eigen::Vector3d at_m = object.centre_m + across_m * across + up_m * up;
  const Eigen::Vector3d to_eye = (camera.centre_m() - at_m).normalized();
  const Eigen::Vector3d normal = object.normal.normalized();
  const Eigen::Vector3d mirrored = 2.0 * normal.dot(to_eye) * normal - to_eye;
  scene.room.lamp_m = at_m + random.uniform(1.0, 2.5) * mirrored;
}

/// Upright, its edge just beside the object as camera 1 sees it.
void add_edge(sim::Scene& scene, base::Random& random, const Camera1& camera,
              const Target& target) {
  const double range_m = target.range_m * random.uniform(0.55, 0.75);
  const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
  const double width_rad = random.uniform(0.1, 0.3), gap_rad = random.uniform(0.005, 0.03);
  const double off_rad = target.radius_rad + gap_rad + 0.5 * width_rad;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(target.direction).normalized();
  const Eigen::Vector3d direction = (target.direction + side * off_rad * across).normalized();
  sim::Texture texture;
  const double grey = random.uniform(40.0, 220.0);
  texture.colour = {grey, grey * random.uniform(0.8, 1.2), grey * random.uniform(0.8, 1.2)};
  for (double& channel : texture.colour) channel = std::min(channel, 255.0);
  scene.planes.push_back(plane(camera.centre_m() + range_m * direction, -target.direction,
                               {range_m * width_rad, 3.0 * range_m}, texture));
}

/// Millimetres a second all the time, or centimetres within a twentieth of a second.
void add_motion(sim::Motion& motion, base::Random& random, Strain strain) {
  Eigen::Vector3d direction(random.symmetric(), random.symmetric(), random.symmetric());
  direction.normalize();
  if (strain != Strain::jump) {
    const bool is_fast = strain == Strain::fast_drift;
    motion.velocity_m_s =
        random.uniform(is_fast ? 0.005 : 0.001, is_fast ? 0.030 : 0.003) * direction;
    return;
  }
  constexpr double duration_s = 0.05;
  const double start_s = random.uniform(0.5, 3.5);
  motion.velocity_m_s = random.uniform(0.01, 0.04) / duration_s * direction;
  motion.moving_s = {start_s, start_s + duration_s};
}

/// Towards the middle of the view, so that both are seen.
void add_twin(sim::Scene& scene, base::Random& random, const Camera1& camera,
              const Target& target) {
  sim::PlacedPlane twin = target.object;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(twin.normal).normalized();
  const double towards_middle = across.dot(camera.axis() - target.direction) < 0.0 ? -1.0 : 1.0;
  twin.centre_m += towards_middle * random.uniform(1.3, 2.5) * twin.appearance.size_m[0] * across;
  scene.planes.push_back(twin);
}

}  // namespace

bool is_ball(Strain strain) {
  return strain == Strain::ball || strain == Strain::ball_pattern || strain == Strain::ball_glossy;
}

void add_hard_things(sim::Scene& scene, base::Random& random, Strain strain, const Camera1& camera,
                     Target& target) {
  if (is_ball(strain)) make_ball(target.object.appearance, strain, random);
  switch (strain) {
    case Strain::highlight:
      return add_highlight(scene, random, camera, target);
    case Strain::edge:
      return add_edge(scene, random, camera, target);
    case Strain::drift:
    case Strain::fast_drift:
    case Strain::jump:
      return add_motion(target.object.motion, random, strain);
    case Strain::twins:
      return add_twin(scene, random, camera, target);
    default:
      return;
  }
}

}  // namespace gazed::benchmarks
