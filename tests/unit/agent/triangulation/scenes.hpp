// Scenes with a known truth, and robots that are not quite what they are believed to be.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/triangulation/all_looks/look.hpp"
#include "agent/triangulation/estimate.hpp"
#include "agent/triangulation/gate.hpp"

#include "random.hpp"

namespace gazed::triangulation {

/// Nothing is turned away.
inline constexpr double unlimited = std::numeric_limits<double>::infinity();
inline constexpr Gate open_gate{
    .relative_sigma_max = unlimited, .epipolar_chi2_max = unlimited, .baseline_sigmas = 0.0};

/// Looks at a scene point, without any error.
struct Scene {
  geometry::HeadGeometry head;
  geometry::CameraModel camera;
  geometry::HeadAngles head_1, head_2;
  Eigen::Vector3d torso_point_m;

  [[nodiscard]] TwoLooks looks() const;
  [[nodiscard]] all_looks::Look look(geometry::HeadAngles angles) const;
  /// Of camera 1 at head_1.
  [[nodiscard]] double inverse_range_per_m() const;
};

/// The top camera of the V4 and later at the report's focal length.
[[nodiscard]] Scene report_scene();

/// A move on both axes, as the step rule makes it, at a point off the centre of both views.
[[nodiscard]] Scene step_rule_scene();

/// What may be wrong.
struct ErrorModel {
  std::string name;
  geometry::Uncertainty uncertainty;
  Eigen::Matrix2d pixel_2_covariance_px2 = Eigen::Matrix2d::Zero();
};
void PrintTo(const ErrorModel& model, std::ostream* stream);

[[nodiscard]] std::vector<ErrorModel> every_source_and_all();

/// The truth is the scene's; this is what an agent believes of its robot.
struct BelievedRobot {
  geometry::HeadGeometry head;
  geometry::CameraModel camera;
};
[[nodiscard]] BelievedRobot believed_robot(const Scene& scene,
                                           const geometry::Uncertainty& uncertainty,
                                           Random& random);

/// A look as it is measured; `registration_px2` is part of its covariance and drawn from it.
[[nodiscard]] all_looks::Look measured_look(const all_looks::Look& truth,
                                            const geometry::Uncertainty& uncertainty,
                                            const Eigen::Matrix2d& registration_px2,
                                            Random& random);

/// Two looks by a robot that is believed wrongly.
[[nodiscard]] PointEstimate estimate_with_errors(const Scene& scene, const ErrorModel& model,
                                                 const Gate& gate, methods::Method method,
                                                 Random& random);

}  // namespace gazed::triangulation
