#include "agent/lab/calibration/board_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <utility>

#include "agent/geometry/cholesky.hpp"
#include "agent/lab/calibration/board_certainty.hpp"
#include "agent/lab/calibration/board_problem.hpp"

namespace gazed::lab::calibration {

namespace {

/// All equations, the poses eliminated: of the camera alone.
struct Eliminated {
  CameraMatrix information = CameraMatrix::Zero();
  CameraNumbers gradient = CameraNumbers::Zero();
};

template <class Matrix>
Matrix damped(Matrix matrix, double damping) {
  matrix.diagonal() *= 1.0 + damping;
  return matrix;
}

/// Zero where a matrix is singular: a board of which too little is seen tells nothing of the
/// camera.
PoseMatrix inverse_of(PoseMatrix matrix) {
  if (!geometry::factorise(matrix)) return PoseMatrix::Zero();
  geometry::invert_factorised(matrix);
  return matrix;
}

Eliminated eliminated(const BoardProblem& problem, const BoardUnknowns& at,
                      const std::vector<PictureEquations>& all, double damping) {
  Eliminated result;
  result.gradient = problem.prior_gradient(at.camera);
  for (const PictureEquations& e : all) {
    result.information += e.camera;
    result.gradient += e.camera_gradient;
  }
  result.information.diagonal() += problem.prior_information();
  result.information = damped(result.information, damping);
  for (const PictureEquations& e : all) {
    const PoseMatrix inverse = inverse_of(damped(e.pose, damping));
    result.information -= e.coupled * inverse * e.coupled.transpose();
    result.gradient -= e.coupled * inverse * e.pose_gradient;
  }
  return result;
}

std::vector<PictureEquations> all_equations(const BoardProblem& problem, const BoardUnknowns& at) {
  std::vector<PictureEquations> all;
  for (std::size_t i = 0; i < problem.pictures(); ++i) all.push_back(problem.equations(at, i));
  return all;
}

/// Of each picture, as certain as the residuals have it.
std::vector<PictureInformation> told_by_pictures(const BoardProblem& problem,
                                                 const BoardUnknowns& at) {
  const double per_variance = 1.0 / (problem.noise_px() * problem.noise_px());
  std::vector<PictureInformation> told;
  for (const PictureEquations& e : all_equations(problem, at)) {
    const PoseMatrix inverse = inverse_of(e.pose);
    told.push_back({per_variance * (e.camera - e.coupled * inverse * e.coupled.transpose()),
                    per_variance * (e.camera_gradient - e.coupled * inverse * e.pose_gradient)});
  }
  return told;
}

/// The unknowns after one step down the normal equations; none where these are singular.
std::optional<BoardUnknowns> stepped(const BoardProblem& problem, const BoardUnknowns& at,
                                     const std::vector<PictureEquations>& all, double damping) {
  Eliminated camera = eliminated(problem, at, all, damping);
  if (!geometry::factorise(camera.information)) return std::nullopt;
  CameraNumbers step = -camera.gradient;
  geometry::solve_factorised(camera.information, step);
  BoardUnknowns result = at;
  result.camera += step;
  for (std::size_t i = 0; i < all.size(); ++i) {
    result.poses[i] -= inverse_of(damped(all[i].pose, damping)) *
                       (all[i].pose_gradient + all[i].coupled.transpose() * step);
  }
  return result;
}

/// Down to the least cost, the weights as they are.
void descend(const BoardProblem& problem, BoardUnknowns& at) {
  constexpr int most_steps = 100;
  constexpr double least_damping = 1e-12, greatest_damping = 1e12, negligible_gain = 1e-10;
  double damping = 1e-3, cost = problem.cost(at);
  for (int step = 0; step < most_steps; ++step) {
    const std::vector<PictureEquations> all = all_equations(problem, at);
    double gain = 0.0;
    while (damping < greatest_damping) {
      std::optional<BoardUnknowns> next = stepped(problem, at, all, damping);
      const double next_cost = next ? problem.cost(*next) : cost;
      if (next_cost < cost) {
        gain = (cost - next_cost) / cost;
        cost = next_cost;
        at = std::move(*next);
        damping = std::max(least_damping, damping / 10.0);
        break;
      }
      damping *= 10.0;
    }
    if (gain < negligible_gain) return;
  }
}

/// The noise of a coordinate, from the median distance, which outliers do not move (Rayleigh).
double robust_noise_px(const BoardProblem& problem, const BoardUnknowns& at) {
  std::vector<double> distances_px;
  for (std::size_t i = 0; i < problem.pictures(); ++i) {
    for (const double square : problem.squares(at, i)) distances_px.push_back(std::sqrt(square));
  }
  const auto middle = distances_px.begin() + std::ssize(distances_px) / 2;
  std::ranges::nth_element(distances_px, middle);
  constexpr double median_of_rayleigh = 1.17741, least_px = 0.005;
  return std::max(least_px, *middle / median_of_rayleigh);
}

/// The board's poses as a camera without distortion has them.
BoardUnknowns first_guess(const std::vector<cv::Point3f>& places,
                          std::span<const std::vector<cv::Point2f>> pixels, cv::Size image,
                          const CameraPrior& prior) {
  BoardUnknowns guess;
  guess.camera = prior.mean;
  const std::vector<std::vector<cv::Point3f>> points(pixels.size(), places);
  const std::vector<std::vector<cv::Point2f>> seen(pixels.begin(), pixels.end());
  const cv::Mat k = cv::initCameraMatrix2D(points, seen, image, 1.0);
  const double focal_px = k.at<double>(0, 0);
  // Boards parallel to the image do not determine the focal length, and this one is then anything.
  if (std::isfinite(focal_px) && focal_px > 0.3 * image.width && focal_px < 10.0 * image.width) {
    guess.camera[0] = guess.camera[1] = focal_px;
  }
  for (const std::vector<cv::Point2f>& picture : pixels) {
    cv::Vec3d turn, shift;
    cv::solvePnP(places, picture, matrix_of(guess.camera), cv::noArray(), turn, shift);
    guess.poses.emplace_back(
        (PoseNumbers() << turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]).finished());
  }
  return guess;
}

void write_residuals(const BoardProblem& problem, const BoardUnknowns& at, BoardFit& fit) {
  double all = 0.0, count = 0.0;
  for (std::size_t i = 0; i < problem.pictures(); ++i) {
    const Eigen::VectorXd squares = problem.squares(at, i);
    fit.picture_rms_px.push_back(std::sqrt(squares.mean()));
    all += squares.sum();
    count += static_cast<double>(squares.size());
  }
  fit.rms_px = std::sqrt(all / count);
  fit.corners_left_out = static_cast<int>(count - problem.weight_sum());
}

}  // namespace

CameraPrior prior_of_any_camera(cv::Size image) {
  // From a wide angle to a telephoto lens, its axis near the middle. Lenses of NAO heads and
  // webcams have a k1 of -0.5 to 0.2.
  const double side_px = std::max(image.width, image.height);
  CameraPrior prior;
  prior.mean << side_px, side_px, 0.5 * (image.width - 1), 0.5 * (image.height - 1), 0.0, 0.0, 0.0,
      0.0, 0.0;
  prior.sigma << 0.5 * side_px, 0.5 * side_px, 0.05 * side_px, 0.05 * side_px, 0.5, 1.0, 0.02, 0.02,
      1.0;
  return prior;
}

BoardFit fit_boards(const std::vector<cv::Point3f>& places,
                    std::span<const std::vector<cv::Point2f>> pixels, cv::Size image) {
  const CameraPrior prior = prior_of_any_camera(image);
  BoardProblem problem(places, pixels, prior);
  BoardUnknowns unknowns = first_guess(places, pixels, image, prior);
  descend(problem, unknowns);
  constexpr int reweightings = 6;
  for (int i = 0; i < reweightings; ++i) {
    problem.set_noise(robust_noise_px(problem, unknowns));
    constexpr double cauchy_sigmas = 2.385;  // 95 % efficient where the noise is Gaussian
    const double scale_px = cauchy_sigmas * problem.noise_px();
    problem.reweight(unknowns,
                     [&](double square) { return 1.0 / (1.0 + square / (scale_px * scale_px)); });
    descend(problem, unknowns);
  }
  constexpr double farthest_sigmas = 4.0;
  const double limit_px = farthest_sigmas * robust_noise_px(problem, unknowns);
  problem.reweight(unknowns,
                   [&](double square) { return square <= limit_px * limit_px ? 1.0 : 0.0; });
  descend(problem, unknowns);

  BoardFit fit;
  fit.camera = unknowns.camera;
  write_residuals(problem, unknowns, fit);
  const double unknown_count =
      camera_number_count + pose_number_count * static_cast<double>(problem.pictures());
  const double freedom = std::max(1.0, 2.0 * problem.weight_sum() - unknown_count);
  problem.set_noise(0.0);  // the residuals alone
  fit.noise_px = std::max(std::sqrt(problem.cost(unknowns) / freedom), 1e-4);
  problem.set_noise(fit.noise_px);
  fit.sigma = camera_sigma(told_by_pictures(problem, unknowns), prior.sigma);
  return fit;
}

}  // namespace gazed::lab::calibration
