// What the error sources do to several pairs of looks (1, k) at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation {

inline constexpr int pairs_max = static_cast<int>(looks_max) - 1;
/// One number, or one row, for each pair; no memory is allocated.
using PairVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, pairs_max, 1>;
using PairMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, pairs_max, pairs_max>;

/// What each source does to one pair's solution. The sources of all pairs of one head are added in
/// one order: those at the same place are the same cause, where their scope is not their own pair.
class PairErrors {
 public:
  struct Column {
    Scope scope = Scope::this_pair;
    Eigen::Vector3d solution_error = Eigen::Vector3d::Zero();  // direction, inverse depth
    double inverse_range_error_per_m = 0.0;
    PoseChange torso_from_cam1{};
  };

  PairErrors() = default;
  PairErrors(const TwoViews& views, const ErrorSources& errors, const Solution& solution);

  [[nodiscard]] std::span<const Column> columns() const { return {columns_.data(), count_}; }

 private:
  std::array<Column, ErrorSources::capacity + image_sources> columns_;
  std::size_t count_ = 0;
};

/// Joint covariance of the pairs' inverse ranges, 1/m^2, in two parts.
struct JointCovariance {
  PairMatrix noise;        // of the looks themselves
  PairMatrix calibration;  // common to all looks
};
[[nodiscard]] JointCovariance joint_covariance(std::span<const PairErrors> pairs);

/// What all sources do to the weighted sum of the pairs' solutions.
void add_fused(std::span<const PairErrors> pairs, const PairVector& weights, CovarianceSum& sum);

}  // namespace gazed::triangulation
