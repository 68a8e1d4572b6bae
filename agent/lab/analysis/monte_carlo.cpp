#include "agent/lab/analysis/monte_carlo.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "agent/base/random.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::lab::analysis {

namespace {

/// Takes the estimates of one point, gives their statistics.
class Errors {
 public:
  Errors(const Eigen::Vector3d& true_point_m, std::size_t samples) : truth_m_(true_point_m) {
    lengths_m_.reserve(samples);
    inverse_ranges_per_m_.reserve(samples);
  }

  void add(const std::optional<Eigen::Vector3d>& point_m, const geometry::Pose& cam2_from_cam1) {
    ++tried_;
    if (!point_m) {
      ++failures_;
      ++over_20_percent_;
      return;
    }
    const Eigen::Vector3d error = *point_m - truth_m_;
    lengths_m_.push_back(error.norm());
    // Welford 1962: mean and summed squares in one pass, without cancellation.
    const Eigen::Vector3d off = error - mean_m_;
    mean_m_ += off / static_cast<double>(lengths_m_.size());
    squares_m2_ += off.cwiseProduct(error - mean_m_);

    const double range_m = point_m->norm();
    inverse_ranges_per_m_.push_back(std::copysign(1.0 / range_m, point_m->z()));
    const bool behind = point_m->z() <= 0.0 || (cam2_from_cam1 * *point_m).z() <= 0.0;
    constexpr double bad = 0.2;
    if (behind) ++failures_;
    if (behind || std::abs(range_m - truth_m_.norm()) > bad * truth_m_.norm()) ++over_20_percent_;
  }

  [[nodiscard]] ErrorStatistics statistics() {
    const auto share = [this](std::size_t n) {
      return static_cast<double>(n) / static_cast<double>(tried_);
    };
    ErrorStatistics out;
    out.failures = share(failures_);
    out.over_20_percent = share(over_20_percent_);
    if (lengths_m_.empty()) {
      out.systematic_m = out.random_m = out.rms_m = out.median_m = out.half_width_m =
          triangulation::not_a_number;
      return out;
    }
    out.systematic_m = mean_m_.norm();
    out.random_m = std::sqrt(squares_m2_.sum() / static_cast<double>(lengths_m_.size()));
    out.rms_m = std::hypot(out.systematic_m, out.random_m);
    out.median_m = quantile(lengths_m_, 0.5);
    // The range passes infinity where its inverse passes 0, so the inverse is what has an order.
    constexpr double tail = 0.16;
    const double far_end = quantile(inverse_ranges_per_m_, tail);
    const double near_end = quantile(inverse_ranges_per_m_, 1.0 - tail);
    out.half_width_m = far_end > 0.0 ? 0.5 * (1.0 / far_end - 1.0 / near_end)
                                     : std::numeric_limits<double>::infinity();
    return out;
  }

 private:
  static double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }

  Eigen::Vector3d truth_m_;
  Eigen::Vector3d mean_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares_m2_ = Eigen::Vector3d::Zero();
  std::vector<double> lengths_m_;
  std::vector<double> inverse_ranges_per_m_;
  std::size_t tried_ = 0;
  std::size_t failures_ = 0;
  std::size_t over_20_percent_ = 0;
};

void draw(base::Random& random, Draws draws, double sigma, std::span<double> errors) {
  constexpr double reach = 2.0;  // sigmas: the report's "two times the standard deviation"
  for (double& error : errors) {
    error = sigma * (draws == Draws::uniform ? reach * random.symmetric() : random.normal());
  }
}

TableRow analyse_point(const TwoViewSetup& setup, Draws draws, const MonteCarlo& monte_carlo,
                       Parameter parameter, std::size_t point) {
  const Eigen::Vector3d& point_m = scene_points_m()[point];
  const Belief exact = truth(setup, point_m);
  const ErrorSize& size = setup.error_size(parameter);
  base::Random random(monte_carlo.seed, static_cast<std::uint64_t>(parameter));
  std::array<double, most_elements> storage{};
  const std::span<double> errors(storage.data(), size.elements);
  std::vector<Errors> errors_of(all_estimators.size(), Errors(point_m, monte_carlo.samples));
  for (std::size_t i = 0; i < monte_carlo.samples; ++i) {
    draw(random, draws, size.sigma, errors);
    const Belief belief = with_errors(setup, exact, parameter, errors);
    for (const Estimator estimator : all_estimators) {
      const bool cheats = estimator == Estimator::replica;
      errors_of[static_cast<std::size_t>(estimator)].add(reconstruct(estimator, belief, exact),
                                                         (cheats ? exact : belief).cam2_from_cam1);
    }
  }
  TableRow row{
      .setup = &setup, .draws = draws, .parameter = parameter, .point = point, .statistics = {}};
  std::ranges::transform(errors_of, row.statistics.begin(),
                         [](Errors& one) { return one.statistics(); });
  return row;
}

/// The greatest of each column; a NaN is greater than any number.
TableRow worst_of(std::span<const TableRow> points) {
  TableRow worst = points.front();
  worst.point = points.size();
  for (std::size_t e = 0; e < all_estimators.size(); ++e) {
    for (double ErrorStatistics::*column :
         {&ErrorStatistics::systematic_m, &ErrorStatistics::random_m, &ErrorStatistics::rms_m,
          &ErrorStatistics::median_m, &ErrorStatistics::half_width_m, &ErrorStatistics::failures,
          &ErrorStatistics::over_20_percent}) {
      for (const TableRow& row : points) {
        double& value = worst.statistics.at(e).*column;
        if (!(row.statistics.at(e).*column <= value)) value = row.statistics.at(e).*column;
      }
    }
  }
  return worst;
}

}  // namespace

std::string_view name(Draws draws) {
  return draws == Draws::uniform ? "uniform" : "gaussian";
}

std::vector<TableRow> analyse(const TwoViewSetup& setup, Draws draws, const MonteCarlo& monte_carlo,
                              const std::function<void()>& point_done) {
  std::vector<TableRow> rows;
  const std::size_t points = scene_points_m().size();
  for (const Parameter parameter : all_parameters) {
    for (std::size_t point = 0; point < points; ++point) {
      rows.push_back(analyse_point(setup, draws, monte_carlo, parameter, point));
      point_done();
    }
    rows.push_back(worst_of(std::span(rows).last(points)));
  }
  return rows;
}

}  // namespace gazed::lab::analysis
