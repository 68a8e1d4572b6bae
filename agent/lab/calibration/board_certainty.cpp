#include "agent/lab/calibration/board_certainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "agent/geometry/cholesky.hpp"
#include "agent/geometry/singular_values.hpp"

namespace gazed::lab::calibration {

namespace {

CameraMatrix information_of_all(std::span<const PictureInformation> pictures,
                                const CameraNumbers& prior_sigma) {
  CameraMatrix all = prior_sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  for (const PictureInformation& picture : pictures) all += picture.information;
  return all;
}

/// Infinite where the information is singular: nothing is known.
CameraMatrix covariance_of(CameraMatrix information) {
  if (!geometry::factorise(information)) {
    return CameraMatrix::Identity() * std::numeric_limits<double>::infinity();
  }
  geometry::invert_factorised(information);
  return information;
}

CameraNumbers by_jackknife(std::span<const PictureInformation> pictures, const CameraMatrix& all) {
  std::vector<CameraNumbers> changes;  // as each picture is left out, to first order
  CameraNumbers mean = CameraNumbers::Zero(), squares = CameraNumbers::Zero();
  const auto count = static_cast<double>(pictures.size());
  for (const PictureInformation& picture : pictures) {
    CameraMatrix others = all - picture.information;
    CameraNumbers change = picture.gradient;
    if (!geometry::factorise(others)) {
      return CameraNumbers::Constant(std::numeric_limits<double>::infinity());
    }
    geometry::solve_factorised(others, change);
    changes.push_back(change);
    mean += changes.back() / count;
  }
  for (const CameraNumbers& change : changes) squares += (change - mean).cwiseAbs2();
  return ((count - 1.0) / count * squares).cwiseSqrt();
}

}  // namespace

double disagreement(std::span<const PictureInformation> pictures,
                    const CameraNumbers& prior_sigma) {
  const CameraMatrix covariance = covariance_of(information_of_all(pictures, prior_sigma));
  // So that pixels and coefficients can be compared.
  const CameraNumbers unit = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  double chi2 = 0.0, freedom = 0.0;
  for (const PictureInformation& picture : pictures) {
    CameraMatrix scaled = unit.asDiagonal() * picture.information * unit.asDiagonal();
    const CameraNumbers gradient = unit.cwiseProduct(picture.gradient);
    CameraMatrix directions;  // the eigenvectors; `scaled` becomes them times the eigenvalues
    geometry::decompose(scaled, directions);
    constexpr double told = 1e-6;  // a board in one picture does not tell all nine numbers
    const double least = told * scaled.colwise().norm().maxCoeff();
    for (int i = 0; i < camera_number_count; ++i) {
      const double information = scaled.col(i).norm();
      if (!(information > least)) continue;
      const double along = directions.col(i).dot(gradient);
      chi2 += along * along / information;
      freedom += 1.0;
    }
    freedom -= (covariance * picture.information).trace();  // what the fit took
  }
  return freedom >= 1.0 ? std::max(1.0, std::sqrt(chi2 / freedom)) : 1.0;
}

CameraNumbers camera_sigma(std::span<const PictureInformation> pictures,
                           const CameraNumbers& prior_sigma) {
  const CameraMatrix all = information_of_all(pictures, prior_sigma);
  return (disagreement(pictures, prior_sigma) *
          covariance_of(all).diagonal().cwiseMax(0.0).cwiseSqrt())
      .cwiseMax(by_jackknife(pictures, all));
}

}  // namespace gazed::lab::calibration
