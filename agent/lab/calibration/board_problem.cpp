#include "agent/lab/calibration/board_problem.hpp"

#include <opencv2/calib3d.hpp>

namespace gazed::lab::calibration {

cv::Matx33d matrix_of(const CameraNumbers& c) {
  return {c[0], 0.0, c[2], 0.0, c[1], c[3], 0.0, 0.0, 1.0};
}

Eigen::Matrix2Xd BoardProblem::residuals(const BoardUnknowns& at, std::size_t picture,
                                         cv::Mat* jacobian) const {
  const PoseNumbers& pose = at.poses[picture];
  const CameraNumbers& c = at.camera;
  std::vector<cv::Point2d> projected;
  const std::vector<cv::Point3d> places(places_.begin(), places_.end());
  const cv::Vec<double, 5> distortion(c[4], c[5], c[6], c[7], c[8]);
  cv::projectPoints(places, cv::Vec3d(pose[0], pose[1], pose[2]),
                    cv::Vec3d(pose[3], pose[4], pose[5]), matrix_of(c), distortion, projected,
                    jacobian != nullptr ? cv::_InputOutputArray(*jacobian) : cv::noArray());
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(projected.size()));
  for (std::size_t i = 0; i < projected.size(); ++i) {
    const cv::Point2f& seen = pixels_[picture][i];
    result.col(static_cast<Eigen::Index>(i)) = Eigen::Vector2d(
        projected[i].x - static_cast<double>(seen.x), projected[i].y - static_cast<double>(seen.y));
  }
  return result;
}

PictureEquations BoardProblem::equations(const BoardUnknowns& at, std::size_t picture) const {
  cv::Mat jacobian;  // pose first, then the camera's numbers in our order
  const Eigen::Matrix2Xd r = residuals(at, picture, &jacobian);
  PictureEquations e;
  for (Eigen::Index row = 0; row < r.size(); ++row) {
    const double weight = weights_[picture][row / 2];
    const double* const derivative = jacobian.ptr<double>(static_cast<int>(row));
    const Eigen::Map<const PoseNumbers> by_pose(derivative);
    const Eigen::Map<const CameraNumbers> by_camera(derivative + pose_number_count);
    e.camera += weight * by_camera * by_camera.transpose();
    e.coupled += weight * by_camera * by_pose.transpose();
    e.pose += weight * by_pose * by_pose.transpose();
    e.camera_gradient += weight * r(row % 2, row / 2) * by_camera;
    e.pose_gradient += weight * r(row % 2, row / 2) * by_pose;
  }
  return e;
}

}  // namespace gazed::lab::calibration
