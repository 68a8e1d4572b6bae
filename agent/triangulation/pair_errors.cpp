#include "agent/triangulation/pair_errors.hpp"

namespace gazed::triangulation {

PairErrors::PairErrors(const TwoViews& views, const ErrorSources& errors,
                       const Solution& solution) {
  const auto add = [&](const ErrorSource& source) {
    const SolutionError error = solution.linearisation.error(solution.response, source);
    columns_[count_++] = {
        .scope = source.scope,
        .solution_error = error.solution,
        .inverse_range_error_per_m = inverse_range_error(solution.point, error.solution),
        .torso_from_cam1 = source.torso_from_cam1};
  };
  for (const ErrorSource& source : image_noise(views)) add(source);
  for (const ErrorSource& source : errors.all()) add(source);
}

JointCovariance joint_covariance(std::span<const PairErrors> pairs) {
  const auto size = static_cast<Eigen::Index>(pairs.size());
  JointCovariance out{PairMatrix::Zero(size, size), PairMatrix::Zero(size, size)};
  for (std::size_t i = 0; i < pairs.front().columns().size(); ++i) {
    PairVector errors(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      errors(k) = pairs[static_cast<std::size_t>(k)].columns()[i].inverse_range_error_per_m;
    }
    switch (pairs.front().columns()[i].scope) {
      case Scope::this_pair:
        out.noise.diagonal() += errors.cwiseAbs2();
        break;
      case Scope::first_look:
        out.noise += errors * errors.transpose();
        break;
      case Scope::all_looks:
        out.calibration += errors * errors.transpose();
        break;
    }
  }
  return out;
}

void add_fused(std::span<const PairErrors> pairs, const PairVector& weights, CovarianceSum& sum) {
  for (std::size_t i = 0; i < pairs.front().columns().size(); ++i) {
    const PairErrors::Column& shared = pairs.front().columns()[i];
    Eigen::Vector3d error = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Eigen::Vector3d part =
          weights(static_cast<Eigen::Index>(k)) * pairs[k].columns()[i].solution_error;
      if (shared.scope == Scope::this_pair) {
        sum.add(part, {});  // a later look's noise does not move camera 1
      } else {
        error += part;
      }
    }
    if (shared.scope != Scope::this_pair) sum.add(error, shared.torso_from_cam1);
  }
}

}  // namespace gazed::triangulation
