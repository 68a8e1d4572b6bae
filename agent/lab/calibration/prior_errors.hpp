// What is believed before any picture, as residuals of a fit: each in its own standard deviations.
#pragma once

#include <ceres/cost_function.h>
#include <cstddef>
#include <utility>
#include <vector>

namespace gazed::lab::calibration {

/// A number of a block of unknowns.
struct Belief {
  int at;
  double mean, sigma;
};

/// (x - mean) / sigma of each belief.
class PriorError final : public ceres::CostFunction {
 public:
  PriorError(int block_size, std::vector<Belief> beliefs)
      : block_size_(static_cast<std::size_t>(block_size)), beliefs_(std::move(beliefs)) {
    set_num_residuals(static_cast<int>(beliefs_.size()));
    mutable_parameter_block_sizes()->push_back(block_size);
  }

  bool Evaluate(const double* const* blocks, double* residual, double** jacobians) const override {
    double* const jacobian = jacobians != nullptr ? jacobians[0] : nullptr;
    for (std::size_t i = 0; i < beliefs_.size(); ++i) {
      const auto& [at, mean, sigma] = beliefs_[i];
      residual[i] = (blocks[0][at] - mean) / sigma;
      if (jacobian == nullptr) continue;
      double* const row = jacobian + i * block_size_;
      for (std::size_t k = 0; k < block_size_; ++k) row[k] = 0.0;
      row[at] = 1.0 / sigma;
    }
    return true;
  }

 private:
  std::size_t block_size_;
  std::vector<Belief> beliefs_;
};

}  // namespace gazed::lab::calibration
