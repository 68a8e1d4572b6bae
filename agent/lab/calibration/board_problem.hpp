// The least-squares problem of board_fit: a camera's numbers and the board's poses against the
// corners that were found, in pixels.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "agent/lab/calibration/board_fit.hpp"

namespace gazed::lab::calibration {

constexpr int pose_number_count = 6;  // rotation vector, translation
using PoseNumbers = Eigen::Matrix<double, pose_number_count, 1>;
using CoupledMatrix = Eigen::Matrix<double, camera_number_count, pose_number_count>;
using PoseMatrix = Eigen::Matrix<double, pose_number_count, pose_number_count>;

/// The camera, and the board in each picture.
struct BoardUnknowns {
  CameraNumbers camera = CameraNumbers::Zero();
  std::vector<PoseNumbers> poses;
};

[[nodiscard]] cv::Matx33d matrix_of(const CameraNumbers& camera);

/// The normal equations of one picture.
struct PictureEquations {
  CameraMatrix camera = CameraMatrix::Zero();
  CoupledMatrix coupled = CoupledMatrix::Zero();
  PoseMatrix pose = PoseMatrix::Zero();
  CameraNumbers camera_gradient = CameraNumbers::Zero();
  PoseNumbers pose_gradient = PoseNumbers::Zero();
};

/// What is fitted: where the corners are seen, their weights, and the prior of the camera. Refers
/// to `places` and `pixels`, which must outlive it.
class BoardProblem {
 public:
  BoardProblem(const std::vector<cv::Point3f>& places,
               std::span<const std::vector<cv::Point2f>> pixels, const CameraPrior& prior)
      : places_(places),
        pixels_(pixels),
        prior_(prior),
        weights_(pixels.size(), Eigen::VectorXd::Ones(static_cast<Eigen::Index>(places.size()))) {}

  [[nodiscard]] std::size_t pictures() const { return pixels_.size(); }

  /// Of each corner of a picture, its distance from where the unknowns put it, squared.
  [[nodiscard]] Eigen::VectorXd squares(const BoardUnknowns& at, std::size_t picture) const {
    return residuals(at, picture, nullptr).colwise().squaredNorm().transpose();
  }
  [[nodiscard]] double cost(const BoardUnknowns& at) const {
    double sum =
        noise_px_ * noise_px_ * (at.camera - prior_.mean).cwiseQuotient(prior_.sigma).squaredNorm();
    for (std::size_t i = 0; i < pictures(); ++i) sum += weights_[i].dot(squares(at, i));
    return sum;
  }
  [[nodiscard]] PictureEquations equations(const BoardUnknowns& at, std::size_t picture) const;

  /// The weight of the prior beside residuals in pixels.
  [[nodiscard]] CameraNumbers prior_information() const {
    return noise_px_ * noise_px_ * prior_.sigma.cwiseAbs2().cwiseInverse();
  }
  [[nodiscard]] CameraNumbers prior_gradient(const CameraNumbers& camera) const {
    return prior_information().cwiseProduct(camera - prior_.mean);
  }

  void set_noise(double noise_px) { noise_px_ = noise_px; }
  [[nodiscard]] double noise_px() const { return noise_px_; }
  /// weight(squared distance) of each corner.
  template <class Weight>
  void reweight(const BoardUnknowns& at, Weight weight) {
    for (std::size_t i = 0; i < pictures(); ++i) weights_[i] = squares(at, i).unaryExpr(weight);
  }
  [[nodiscard]] double weight_sum() const {
    double sum = 0.0;
    for (const Eigen::VectorXd& weights : weights_) sum += weights.sum();
    return sum;
  }

 private:
  /// A column for each corner. A row of the Jacobian for each coordinate: by the pose, then by the
  /// camera's numbers.
  [[nodiscard]] Eigen::Matrix2Xd residuals(const BoardUnknowns& at, std::size_t picture,
                                           cv::Mat* jacobian) const;

  const std::vector<cv::Point3f>& places_;
  std::span<const std::vector<cv::Point2f>> pixels_;
  CameraPrior prior_;
  std::vector<Eigen::VectorXd> weights_;
  double noise_px_ = 0.1;
};

}  // namespace gazed::lab::calibration
