// The error of one image point and its derivatives, as Ceres asks for them.
//
// The chain of the head is differentiated automatically, but once a look, not once a point: a look
// has hundreds of points, and the chain is nine tenths of the work.
#pragma once

#include <Eigen/Core>
#include <array>
#include <ceres/jet.h>
#include <ceres/rotation.h>
#include <ceres/sized_cost_function.h>
#include <memory>
#include <utility>

#include "agent/lab/calibration/chain.hpp"

namespace gazed::lab::calibration {

constexpr int lens_count = mount_offset_at;                // the first parameters
constexpr int chain_count = parameter_count - lens_count;  // the others
constexpr int angle_count = 2;                             // of a look
constexpr int pose_size = 6;   // a turn after the first guess (rotation vector), a translation
constexpr int point_size = 3;  // two tangents of the first direction, inverse range in 1/m

/// Where the camera is at one look, with the derivatives by the chain's parameters and the look's
/// angles; kept until it is asked for other numbers.
class LookPlace {
 public:
  using Jet = ceres::Jet<double, chain_count + angle_count>;

  [[nodiscard]] const CameraPlace<Jet>& at(const double* parameters, const double* look);

 private:
  std::array<double, chain_count + angle_count> numbers_{};
  bool known_ = false;
  CameraPlace<Jet> place_;
};

/// A point from the neck in homogeneous coordinates, (direction, inverse), and its derivatives by
/// the numbers that place it.
template <int size>
struct Homogeneous {
  Eigen::Vector3d direction;
  double inverse = 1.0;
  Eigen::Matrix<double, 3, size> by_direction = Eigen::Matrix<double, 3, size>::Zero();
  Eigen::Matrix<double, 1, size> by_inverse = Eigen::Matrix<double, 1, size>::Zero();
};

/// A point of a pattern, whose pose is six numbers.
struct PatternPoint {
  static constexpr int size = pose_size;
  Eigen::Vector3d point_m;
  Eigen::Matrix3d neck_from_pattern;  // the first guess of the rotation

  [[nodiscard]] Homogeneous<size> at(const double* pose) const;
};

/// A point of a scene, which is three numbers of its own.
struct ScenePoint {
  static constexpr int size = point_size;
  Eigen::Matrix3d frame;  // the first direction, then two at right angles to it

  [[nodiscard]] Homogeneous<size> at(const double* point) const;
};

/// (seen - pixel) / sigma; fails for a point behind the camera.
template <class Point>
class ReprojectionError final
    : public ceres::SizedCostFunction<2, parameter_count, angle_count, Point::size> {
 public:
  ReprojectionError(Point point, std::shared_ptr<LookPlace> place, const geometry::Pixel& pixel,
                    double sigma_px)
      : point_(std::move(point)), place_(std::move(place)), pixel_(pixel), sigma_px_(sigma_px) {}

  bool Evaluate(const double* const* blocks, double* residual, double** jacobians) const override;

 private:
  Point point_;
  std::shared_ptr<LookPlace> place_;
  geometry::Pixel pixel_;
  double sigma_px_;
};

extern template class ReprojectionError<PatternPoint>;
extern template class ReprojectionError<ScenePoint>;

}  // namespace gazed::lab::calibration
