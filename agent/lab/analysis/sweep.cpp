#include "agent/lab/analysis/sweep.hpp"

#include <Eigen/Core>
#include <optional>
#include <span>

#include "agent/triangulation/estimate.hpp"

namespace gazed::lab::analysis {

namespace {

/// What the gate says of a belief, by the optimal method.
triangulation::Status judged(const TwoViewSetup& setup, const Belief& belief) {
  const double sigma_px = setup.error_size(Parameter::point).sigma;
  const geometry::CameraModel camera{.focal_px = belief.focal_px, .centre_px = belief.centre_px};
  const Eigen::Matrix2d noise_px2 = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  const auto point_1 = triangulation::image_point(camera, belief.pixel_1, noise_px2);
  const auto point_2 = triangulation::image_point(camera, belief.pixel_2, noise_px2);
  if (!point_1 || !point_2) return triangulation::Status::invalid_input;
  const triangulation::TwoViews views{.cam2_from_cam1 = belief.cam2_from_cam1,
                                      .point_1 = *point_1,
                                      .point_2 = *point_2,
                                      .torso_from_cam1 = std::nullopt};
  return triangulation::estimate_point(views, error_sources(setup, views), triangulation::Gate{})
      .status;
}

SweepRow sweep_one(const TwoViewSetup& setup, Parameter parameter, double error) {
  SweepRow row{.setup = &setup, .parameter = parameter, .error = error};
  std::array<double, most_elements> storage;
  storage.fill(error);
  const std::span<const double> errors(storage.data(), setup.error_size(parameter).elements);
  const auto points = scene_points_m();
  for (const Eigen::Vector3d& point_m : points) {
    const Belief exact = truth(setup, point_m);
    const Belief belief = with_errors(setup, exact, parameter, errors);
    row.statuses.push_back(judged(setup, belief));
    for (const Estimator estimator : all_estimators) {
      const auto estimate_m = reconstruct(estimator, belief, exact);
      row.mean_error_m.at(static_cast<std::size_t>(estimator)) +=
          (estimate_m ? (*estimate_m - point_m).norm() : triangulation::not_a_number) /
          static_cast<double>(points.size());
    }
  }
  return row;
}

}  // namespace

std::vector<SweepRow> sweep(const TwoViewSetup& setup, std::size_t samples,
                            const std::function<void()>& parameter_done) {
  constexpr double reach = 2.0;  // sigmas, as the report
  std::vector<SweepRow> rows;
  for (const Parameter parameter : all_parameters) {
    const double end = reach * setup.error_size(parameter).sigma;
    for (std::size_t i = 0; i < samples; ++i) {
      // Exactly 0 in the middle and the same on both sides of it.
      const double part = (2.0 * static_cast<double>(i) - static_cast<double>(samples - 1)) /
                          static_cast<double>(samples - 1);
      rows.push_back(sweep_one(setup, parameter, part * end));
    }
    parameter_done();
  }
  return rows;
}

}  // namespace gazed::lab::analysis
