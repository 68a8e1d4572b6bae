// One bundle adjustment under way: its unknowns, what of the sightings is believed, and the steps
// that adjust_bundle() makes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <cstddef>
#include <memory>
#include <vector>

#include "agent/lab/calibration/bundle.hpp"
#include "agent/lab/calibration/reprojection.hpp"

namespace gazed::lab::calibration {

/// What a fit may change, beside what was seen.
struct Freedom {
  bool parameters = true;
  bool looks = true;
};

/// When a fit is good enough: the relative change of the cost in a step.
struct Effort {
  double tolerance;
  int iterations;
};
constexpr Effort coarse{1e-4, 30};  // its outcome is judged and fitted again
constexpr Effort fine{1e-8, 100};

class BundleFit {
 public:
  explicit BundleFit(const BundleInput& input);

  /// The unknowns that are free, fitted to the sightings in use, with a robust loss. False when
  /// that led nowhere.
  bool solve(Freedom freedom, Effort effort);
  /// Of the pixel coordinates in use.
  [[nodiscard]] double rms_px() const;
  /// Judges every sighting anew by the residuals' own scale, which becomes pixel_sigma_px.
  void judge_sightings();
  /// The encoders' sigma from the corrections of the looks, never below the one believed.
  void judge_looks();
  /// BundleResult::information.
  [[nodiscard]] Eigen::MatrixXd information();

  /// The angles as measured.
  void put_looks_back();
  [[nodiscard]] std::vector<geometry::HeadAngles> refined_looks() const;
  [[nodiscard]] geometry::Pose pattern_place() const;
  [[nodiscard]] std::size_t used() const {
    return static_cast<std::size_t>(std::ranges::count(used_, true));
  }

  Parameters parameters;
  double pixel_sigma_px;
  double encoder_sigma_rad;

 private:
  using Problem = std::unique_ptr<ceres::Problem>;
  [[nodiscard]] bool is_scene() const { return in_.pattern_m.empty(); }
  [[nodiscard]] double* target(int point) {
    return targets_[is_scene() ? static_cast<std::size_t>(point) : 0].data();
  }
  void start_scene();
  /// Without the parameters' own prior where it is not wanted.
  [[nodiscard]] Problem problem(Freedom freedom, ceres::LossFunction* loss, bool with_prior);
  [[nodiscard]] std::vector<double*> free_targets();
  [[nodiscard]] std::unique_ptr<ceres::CostFunction> error_of(const PointSighting& sighting,
                                                              double sigma_px) const;
  [[nodiscard]] double error_px(const PointSighting& sighting) const;
  [[nodiscard]] double freedom_share() const;

  const BundleInput& in_;
  std::vector<int> free_;
  std::vector<std::array<double, angle_count>> looks_;
  std::vector<std::array<double, pose_size>> targets_;  // one pose, or points (three numbers)
  std::vector<Eigen::Matrix3d> tangents_;               // of the points
  std::vector<std::shared_ptr<LookPlace>> places_;
  std::vector<bool> used_;
};

}  // namespace gazed::lab::calibration
