#include "agent/lab/calibration/reprojection.hpp"

#include <algorithm>

namespace gazed::lab::calibration {

namespace {

using LensJet = ceres::Jet<double, lens_count + 3>;  // by the lens, then by the point in the camera

Vector2<LensJet> seen_with_derivatives(const double* parameters, const Eigen::Vector3d& in_cam) {
  std::array<LensJet, parameter_count> lens;
  for (int i = 0; i < lens_count; ++i) {
    lens[static_cast<std::size_t>(i)] = LensJet(parameters[i], i);
  }
  const Vector3<LensJet> point(LensJet(in_cam.x(), lens_count), LensJet(in_cam.y(), lens_count + 1),
                               LensJet(in_cam.z(), lens_count + 2));
  return seen_at(lens.data(), point);
}

}  // namespace

const CameraPlace<LookPlace::Jet>& LookPlace::at(const double* parameters, const double* look) {
  std::array<double, chain_count + angle_count> numbers{};
  std::copy_n(parameters + lens_count, chain_count, numbers.begin());
  std::copy_n(look, angle_count, numbers.begin() + chain_count);
  if (known_ && numbers == numbers_) return place_;
  numbers_ = numbers;
  known_ = true;
  std::array<Jet, parameter_count> chain;
  for (int i = 0; i < chain_count; ++i) {
    chain[static_cast<std::size_t>(lens_count + i)] = Jet(parameters[lens_count + i], i);
  }
  const std::array<Jet, angle_count> angles{Jet(look[0], chain_count),
                                            Jet(look[1], chain_count + 1)};
  place_ = camera_place(chain.data(), angles.data());
  return place_;
}

Homogeneous<pose_size> PatternPoint::at(const double* pose) const {
  using Jet = ceres::Jet<double, 3>;
  const std::array<Jet, 3> turn{Jet(pose[0], 0), Jet(pose[1], 1), Jet(pose[2], 2)};
  const std::array<Jet, 3> point{Jet(point_m.x()), Jet(point_m.y()), Jet(point_m.z())};
  std::array<Jet, 3> turned;
  ceres::AngleAxisRotatePoint(turn.data(), point.data(), turned.data());
  Eigen::Vector3d value;
  Eigen::Matrix3d by_turn;
  for (int i = 0; i < 3; ++i) {
    value[i] = turned[static_cast<std::size_t>(i)].a;
    by_turn.row(i) = turned[static_cast<std::size_t>(i)].v;
  }
  Homogeneous<size> result;
  result.direction = neck_from_pattern * value + Eigen::Map<const Eigen::Vector3d>(pose + 3);
  result.by_direction << neck_from_pattern * by_turn, Eigen::Matrix3d::Identity();
  return result;
}

Homogeneous<point_size> ScenePoint::at(const double* point) const {
  Homogeneous<size> result;
  result.direction = frame * Eigen::Vector3d(1.0, point[0], point[1]);
  result.inverse = point[2];
  result.by_direction.leftCols<2>() = frame.rightCols<2>();
  result.by_inverse[2] = 1.0;
  return result;
}

template <class Point>
bool ReprojectionError<Point>::Evaluate(const double* const* blocks, double* residual,
                                        double** jacobians) const {
  const auto& place = place_->at(blocks[0], blocks[1]);
  const Homogeneous<Point::size> point = point_.at(blocks[2]);
  // in_cam = R^T (direction - inverse centre), and its derivatives by chain and angles.
  Eigen::Matrix3d cam_from_neck;
  Eigen::Vector3d centre_m, from_centre;
  for (int i = 0; i < 3; ++i) {
    centre_m[i] = place.centre_m[i].a;
    from_centre[i] = point.direction[i] - point.inverse * centre_m[i];
    for (int k = 0; k < 3; ++k) cam_from_neck(k, i) = place.neck_from_cam(i, k).a;
  }
  const Eigen::Vector3d in_cam = cam_from_neck * from_centre;
  if (!(in_cam.z() > 0.0)) return false;
  const Vector2<LensJet> seen = seen_with_derivatives(blocks[0], in_cam);
  for (int i = 0; i < 2; ++i) residual[i] = (seen[i].a - pixel_[i]) / sigma_px_;
  if (jacobians == nullptr) return true;

  Eigen::Matrix<double, 2, 3> by_in_cam;
  for (int i = 0; i < 2; ++i) by_in_cam.row(i) = seen[i].v.template tail<3>() / sigma_px_;
  Eigen::Matrix<double, 3, chain_count + angle_count> in_cam_by_place;
  for (int k = 0; k < 3; ++k) {
    in_cam_by_place.row(k).setZero();
    for (int i = 0; i < 3; ++i) {
      in_cam_by_place.row(k) += from_centre[i] * place.neck_from_cam(i, k).v -
                                point.inverse * cam_from_neck(k, i) * place.centre_m[i].v;
    }
  }
  const Eigen::Matrix<double, 2, chain_count + angle_count> by_place = by_in_cam * in_cam_by_place;
  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, parameter_count, Eigen::RowMajor>> out(jacobians[0]);
    for (int i = 0; i < 2; ++i) {
      out.row(i).template head<lens_count>() = seen[i].v.template head<lens_count>() / sigma_px_;
    }
    out.template rightCols<chain_count>() = by_place.template leftCols<chain_count>();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, angle_count, Eigen::RowMajor>> out(jacobians[1]);
    out = by_place.template rightCols<angle_count>();
  }
  if (jacobians[2] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, Point::size, Eigen::RowMajor>> out(jacobians[2]);
    out = by_in_cam * cam_from_neck * (point.by_direction - centre_m * point.by_inverse);
  }
  return true;
}

template class ReprojectionError<PatternPoint>;
template class ReprojectionError<ScenePoint>;

}  // namespace gazed::lab::calibration
