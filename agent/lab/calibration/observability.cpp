#include "agent/lab/calibration/observability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/geometry/singular_values.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr double weak_share = 0.5;  // below it the prior knows more than the pictures

struct Candidate {
  std::string name;
  Parameters direction = Parameters::Zero();
};

/// Directions with a name: what a person would call them.
std::vector<Candidate> candidates(const Parameters& estimate) {
  std::vector<Candidate> all;
  Candidate yaw{"yaw zero (head.zero_rad yaw): turns the whole world with the robot"};
  yaw.direction[zero_at] = 1.0;
  all.push_back(yaw);

  // Ry(pitch + d) (o, R) = Ry(pitch) (Ry(d) o, Ry(d) R).
  Candidate pitch{"pitch zero (head.zero_rad pitch): the mount's pitch and offset take it up"};
  pitch.direction[zero_at + 1] = 1.0;
  pitch.direction[mount_rotation_at + 1] = -1.0;
  pitch.direction[mount_offset_at] = -estimate[mount_offset_at + 2];
  pitch.direction[mount_offset_at + 2] = estimate[mount_offset_at];
  all.push_back(pitch);

  Candidate arm{"the arm's length (scale of camera.mount_offset_m): the scene's size follows it"};
  arm.direction.segment<3>(mount_offset_at) = estimate.segment<3>(mount_offset_at);
  arm.direction.segment<3>(axis_offset_at) = estimate.segment<3>(axis_offset_at);
  all.push_back(arm);

  Candidate along{"axis offset y against camera.mount_offset_m y: along the pitch axis"};
  along.direction[axis_offset_at + 1] = 1.0;
  along.direction[mount_offset_at + 1] = -1.0;
  all.push_back(along);
  for (int i = 0; i < parameter_count; ++i) {
    Candidate one{std::string(parameter_names()[static_cast<std::size_t>(i)].text)};
    one.direction[i] = 1.0;
    all.push_back(one);
  }
  return all;
}

/// "camera.centre_px y +0.94, camera.mount_rotation_rad pitch -0.33", in sigmas of the prior.
std::string spelled_out(const Eigen::VectorXd& direction, const std::vector<int>& free) {
  constexpr double least_part = 0.3;
  std::string name;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double part = direction[static_cast<Eigen::Index>(i)];
    if (std::abs(part) < least_part) continue;
    const auto& parameter = parameter_names()[static_cast<std::size_t>(free[i])];
    name +=
        (name.empty() ? "" : " with ") + std::string(parameter.text) + base::text(" %+.2f", part);
  }
  return "a mixture, in prior sigmas: " + name;
}

Eigen::VectorXd whitened(const Parameters& direction, const Prior& prior,
                         const std::vector<int>& free) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    result[static_cast<Eigen::Index>(i)] = direction[free[i]] / prior.sigma[free[i]];
  }
  return result;
}

/// Whether nothing of a direction is held.
bool is_free(const Parameters& direction, const Prior& prior) {
  for (int i = 0; i < parameter_count; ++i) {
    if (direction[i] != 0.0 && !(prior.sigma[i] > 0.0)) return false;
  }
  return true;
}

double share_of(double information) {
  const double known = std::max(0.0, information);
  return known / (1.0 + known);
}

struct Eigensystem {
  Eigen::VectorXd values;  // ascending
  Eigen::MatrixXd vectors;
};

/// Of a matrix whose eigenvalues are not negative, but for rounding.
Eigensystem eigensystem_of(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd scaled = matrix, vectors(matrix.rows(), matrix.cols());
  geometry::decompose(scaled, vectors);
  return {scaled.colwise().norm().transpose(), vectors};
}

std::vector<WeakDirection> weak_directions(const Eigen::MatrixXd& information, const Prior& prior,
                                           const std::vector<int>& free,
                                           const Parameters& estimate) {
  const Eigensystem eigen = eigensystem_of(information);
  Eigen::Index count = 0;  // eigenvalues ascend
  while (count < information.cols() && share_of(eigen.values[count]) < weak_share) ++count;
  if (count == 0) return {};
  Eigen::MatrixXd weak = eigen.vectors.leftCols(count);
  std::vector<WeakDirection> result;
  for (const Candidate& candidate : candidates(estimate)) {
    if (!is_free(candidate.direction, prior)) continue;
    const Eigen::VectorXd direction = whitened(candidate.direction, prior, free).normalized();
    if (!direction.allFinite()) continue;
    const Eigen::VectorXd inside = weak.lazyProduct(weak.transpose().lazyProduct(direction).eval());
    constexpr double least_cosine = 0.95;
    if (inside.norm() < least_cosine) continue;
    const Eigen::VectorXd unit = inside.normalized();
    result.push_back({candidate.name, share_of(unit.dot(information.lazyProduct(unit)))});
    const Eigen::RowVectorXd along = unit.transpose().lazyProduct(weak);
    weak -= unit.lazyProduct(along);  // what is named is not named twice
  }
  // What has no name.
  const Eigensystem rest = eigensystem_of(weak.lazyProduct(weak.transpose()));
  for (Eigen::Index i = rest.values.size(); i-- > 0;) {
    if (rest.values[i] < 0.5) break;
    const Eigen::VectorXd unit = rest.vectors.col(i);
    result.push_back({spelled_out(unit, free), share_of(unit.dot(information.lazyProduct(unit)))});
  }
  std::ranges::stable_sort(result, {}, &WeakDirection::data_share);
  return result;
}

/// Standard deviations of the parameters of `free`, `held` left out.
Parameters sigma_of(const Eigen::MatrixXd& whitened_information, const Prior& prior,
                    const std::vector<int>& free, bool zeros_held) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const bool zero = free[i] == zero_at || free[i] == zero_at + 1;
    if (!zeros_held || !zero) kept.push_back(static_cast<int>(i));
  }
  const auto size = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd with_prior = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      with_prior(i, j) += whitened_information(kept[static_cast<std::size_t>(i)],
                                               kept[static_cast<std::size_t>(j)]);
    }
  }
  const Eigen::MatrixXd covariance = pseudo_inverse(with_prior);
  Parameters sigma = Parameters::Zero();
  for (Eigen::Index i = 0; i < size; ++i) {
    const int at = free[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])];
    sigma[at] = std::sqrt(std::max(0.0, covariance(i, i))) * prior.sigma[at];
  }
  return sigma;
}

}  // namespace

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  const auto [values, vectors] = eigensystem_of(matrix);
  const double least = static_cast<double>(matrix.cols()) * std::numeric_limits<double>::epsilon() *
                       values.maxCoeff();
  Eigen::MatrixXd weighted = vectors;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    weighted.col(i) *= values[i] > least ? 1.0 / values[i] : 0.0;
  }
  return weighted.lazyProduct(vectors.transpose());
}

Certainty certainty_of(const Eigen::MatrixXd& information, const Prior& prior,
                       const Parameters& estimate) {
  const std::vector<int> free = prior.free_indices();
  Eigen::VectorXd scale(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    scale[static_cast<Eigen::Index>(i)] = prior.sigma[free[i]];
  }
  const Eigen::MatrixXd whitened_information =
      scale.asDiagonal() * information * scale.asDiagonal();
  return {.sigma = sigma_of(whitened_information, prior, free, false),
          .sigma_given_zeros = sigma_of(whitened_information, prior, free, true),
          .weak = weak_directions(whitened_information, prior, free, estimate)};
}

}  // namespace gazed::lab::calibration
