#include "agent/lab/analysis/sweep.hpp"

#include <span>

#include "agent/triangulation/two_view.hpp"

namespace gazed {

namespace {

SweepRow sweep_one(const TwoViewSetup& setup, Parameter parameter, double error) {
  SweepRow row{.setup = &setup, .parameter = parameter, .error = error};
  std::array<double, most_elements> storage;
  storage.fill(error);
  const std::span<const double> errors(storage.data(), setup.error_size(parameter).elements);
  const auto points = scene_points_m();
  for (const Eigen::Vector3d& point_m : points) {
    const Belief exact = truth(setup, point_m);
    const Belief belief = with_errors(setup, exact, parameter, errors);
    for (const Estimator estimator : all_estimators) {
      const auto estimate_m = reconstruct(estimator, belief, exact);
      row.mean_error_m.at(static_cast<std::size_t>(estimator)) +=
          (estimate_m ? (*estimate_m - point_m).norm() : not_a_number) /
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

}  // namespace gazed
