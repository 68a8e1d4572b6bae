#include "agent/tracking/flow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "agent/tracking/float4.hpp"
#include "agent/tracking/plane.hpp"

namespace gazed::tracking {

namespace {

constexpr int max_iterations = 12;
constexpr int unknowns = 4;               // x, y, gain, bias
constexpr float step_converged = 0.004F;  // samples
constexpr float step_max = 1.0F;
// Gains outside this range mean another object, not another exposure.
constexpr float gain_min = 0.4F, gain_max = 2.5F;
// If the slopes in one direction are this much weaker than in the other, the patch is an edge.
constexpr float roundness_min = 0.01F;

// Weights for fractions in 256ths, where every sample has a fraction of its own: at most 0.002
// samples off.
constexpr int fraction_bits = 8;
constexpr auto weight_table = [] {
  std::array<std::array<float, 4>, 1 << fraction_bits> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = cubic_weights(static_cast<float>(i) / static_cast<float>(table.size()));
  }
  return table;
}();

// Sums over a patch, in four columns until the end.
template <int side, typename Term>
float sum_over(Term&& term) {
  static_assert(side % 4 == 0);
  Float4 sum{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(side * side); i += 4) sum += term(i);
  return sum4(sum);
}

// Reads side x side samples around `centre`, all at the same fraction, in grey levels.
template <int side>
bool read_shifted(const LumaLevel& level, const Eigen::Vector2f& centre, float* out) {
  constexpr int rows = side + 3, columns = side + 4;
  const Eigen::Vector2f first = centre.array() - 0.5F * (side - 1) - 1.0F;
  if (!(first.x() >= 0.0F && first.y() >= 0.0F && first.x() < 32767.0F && first.y() < 32767.0F)) {
    return false;
  }
  const int column = static_cast<int>(first.x()), row = static_cast<int>(first.y());
  if (column + columns > level.width || row + rows > level.height) return false;
  const auto wx = cubic_weights(first.x() - static_cast<float>(column));
  const auto wy = cubic_weights(first.y() - static_cast<float>(row));

  std::array<float, static_cast<std::size_t>(rows * columns)> samples;
  for (int y = 0; y < rows; ++y) {
    const std::uint16_t* from = level.row(row + y) + column;
    for (int x = 0; x < columns; x += 4) store4(samples.data() + y * columns + x, load4(from + x));
  }
  constexpr float to_grey = 1.0F / luma_one;
  std::array<float, columns + 4> mixed{};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < columns; x += 4) {
      const float* at = samples.data() + y * columns + x;
      store4(mixed.data() + x,
             to_grey * (wy[0] * load4(at) + wy[1] * load4(at + columns) +
                        wy[2] * load4(at + 2 * columns) + wy[3] * load4(at + 3 * columns)));
    }
    for (int x = 0; x < side; x += 4) {
      const float* at = mixed.data() + x;
      store4(out + y * side + x, wx[0] * load4(at) + wx[1] * load4(at + 1) + wx[2] * load4(at + 2) +
                                     wx[3] * load4(at + 3));
    }
  }
  return true;
}

template <int side>
void remove_mean(float* values) {
  const float mean =
      sum_over<side>([&](std::size_t i) { return load4(values + i); }) / (side * side);
  for (int i = 0; i < side * side; i += 4) store4(values + i, load4(values + i) - mean);
}

}  // namespace

template <int side>
bool read_warped(const LumaLevel& level, const Eigen::Vector2f& centre, const Eigen::Matrix2f& step,
                 float* out) {
  constexpr float half = 0.5F * (side - 1);
  // The patch's extent, plus one sample before and two after for the spline.
  const Eigen::Vector2f extent = half * step.cwiseAbs().rowwise().sum();
  const Eigen::Vector2f low = centre - extent, high = centre + extent;
  if (!(low.x() >= 1.0F && low.y() >= 1.0F && high.x() < static_cast<float>(level.width - 3) &&
        high.y() < static_cast<float>(level.height - 3))) {
    return false;
  }
  constexpr float one = 1 << fraction_bits;
  constexpr int fraction_mask = (1 << fraction_bits) - 1;
  constexpr float to_grey = 1.0F / luma_one;
  for (int j = 0; j < side; ++j) {
    const float dy = static_cast<float>(j) - half;
    for (int i = 0; i < side; ++i) {
      const float dx = static_cast<float>(i) - half;
      const int x = static_cast<int>(one * (centre.x() + step(0, 0) * dx + step(0, 1) * dy) + 0.5F);
      const int y = static_cast<int>(one * (centre.y() + step(1, 0) * dx + step(1, 1) * dy) + 0.5F);
      const auto& wx = weight_table[static_cast<std::size_t>(x & fraction_mask)];
      const auto& wy = weight_table[static_cast<std::size_t>(y & fraction_mask)];
      const std::uint16_t* at = level.row((y >> fraction_bits) - 1) + (x >> fraction_bits) - 1;
      Float4 sum = wy[0] * load4(at);
      for (std::size_t k = 1; k < 4; ++k) sum += wy[k] * load4(at += level.width);
      *out++ = to_grey * sum4(sum * load4(wx.data()));
    }
  }
  return true;
}

template <int side>
bool make_template(const LumaLevel& level, const Eigen::Vector2f& centre,
                   const Eigen::Matrix2f& from_other, FlowTemplate<side>& out) {
  constexpr int wide = side + 2;
  std::array<float, static_cast<std::size_t>(wide * wide)> samples;
  if (!read_warped<wide>(level, centre, from_other, samples.data())) return false;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; x += 4) {
      const float* at = samples.data() + (y + 1) * wide + x + 1;
      const int to = y * side + x;
      store4(out.value.data() + to, load4(at));
      store4(out.slope_x.data() + to, 0.5F * (load4(at + 1) - load4(at - 1)));
      store4(out.slope_y.data() + to, 0.5F * (load4(at + wide) - load4(at - wide)));
    }
  }
  remove_mean<side>(out.value.data());
  const auto product = [](const auto& a, const auto& b) {
    return sum_over<side>([&](std::size_t i) { return load4(a.data() + i) * load4(b.data() + i); });
  };
  out.energy = product(out.value, out.value);
  if (!(out.energy > 0.0F)) return false;
  for (auto* slope : {&out.slope_x, &out.slope_y}) {
    remove_mean<side>(slope->data());
    const float share = product(*slope, out.value) / out.energy;
    for (std::size_t i = 0; i < out.area; i += 4) {
      store4(slope->data() + i, load4(slope->data() + i) - share * load4(out.value.data() + i));
    }
  }
  Eigen::Matrix2f& h = out.information;
  h(0, 0) = product(out.slope_x, out.slope_x);
  h(1, 1) = product(out.slope_y, out.slope_y);
  h(0, 1) = h(1, 0) = product(out.slope_x, out.slope_y);
  const float trace = h(0, 0) + h(1, 1), determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(0, 1);
  return determinant > roundness_min * trace * trace;
}

template <int side>
std::optional<Flow> find_patch(const FlowTemplate<side>& patch, const LumaLevel& level,
                               const Eigen::Vector2f& start, float reach) {
  std::array<float, FlowTemplate<side>::area> seen;
  const auto product = [&](const std::array<float, FlowTemplate<side>::area>& other) {
    return sum_over<side>(
        [&](std::size_t i) { return load4(seen.data() + i) * load4(other.data() + i); });
  };
  const Eigen::Matrix2f& h = patch.information;
  const float determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(0, 1);
  Flow flow{start};
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (!read_shifted<side>(level, flow.at, seen.data())) return std::nullopt;
    remove_mean<side>(seen.data());
    const float common = product(patch.value), energy = product(seen);
    const float gain = common / patch.energy;
    if (!(gain > gain_min && gain < gain_max)) return std::nullopt;
    const float bx = product(patch.slope_x) / gain, by = product(patch.slope_y) / gain;
    Eigen::Vector2f step(-(h(1, 1) * bx - h(0, 1) * by), -(h(0, 0) * by - h(0, 1) * bx));
    step /= determinant;
    const float length = step.norm();
    if (length > step_max) step *= step_max / length;
    flow.at += step;
    if (!((flow.at - start).norm() <= reach)) return std::nullopt;
    if (length < step_converged) {
      flow.correlation = common / std::sqrt(patch.energy * energy);
      const float left = std::max(energy - gain * common, 0.0F);
      flow.misfit = left / (gain * gain * (side * side - unknowns));
      flow.variance = flow.misfit * (h(0, 0) + h(1, 1)) / (2.0F * determinant);
      return flow;
    }
  }
  return std::nullopt;
}

template bool read_warped<8>(const LumaLevel&, const Eigen::Vector2f&, const Eigen::Matrix2f&,
                             float*);
template bool make_template<8>(const LumaLevel&, const Eigen::Vector2f&, const Eigen::Matrix2f&,
                               FlowTemplate<8>&);
template bool make_template<12>(const LumaLevel&, const Eigen::Vector2f&, const Eigen::Matrix2f&,
                                FlowTemplate<12>&);
template std::optional<Flow> find_patch<8>(const FlowTemplate<8>&, const LumaLevel&,
                                           const Eigen::Vector2f&, float);
template std::optional<Flow> find_patch<12>(const FlowTemplate<12>&, const LumaLevel&,
                                            const Eigen::Vector2f&, float);

}  // namespace gazed::tracking
