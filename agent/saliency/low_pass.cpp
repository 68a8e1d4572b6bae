#include "agent/saliency/low_pass.hpp"

#include <algorithm>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/row_ring.hpp"

namespace gazed::saliency {

namespace {

std::int32_t filtered(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d,
                      std::int32_t e) {
  return rounding_shift<binomial_gain_log2>(a + e + 4 * (b + d) + 6 * c);
}

void filter_row(const std::int32_t* from, int width, std::int32_t* to) {
  const auto at = [&](int x) { return from[reflect_101(x, width)]; };
  const auto near_end = [&](int x) {
    to[x] = filtered(at(x - 2), at(x - 1), at(x), at(x + 1), at(x + 2));
  };
  const int inner = std::max(width - 2, 2);
  for (int x = 0; x < std::min(2, width); ++x) near_end(x);
  for (int x = 2; x < inner; ++x)
    to[x] = filtered(from[x - 2], from[x - 1], from[x], from[x + 1], from[x + 2]);
  for (int x = inner; x < width; ++x) near_end(x);
}

}  // namespace

void low_pass(const PlaneView<std::int32_t>& plane, const PlaneView<std::int32_t>& scratch) {
  for (int y = 0; y < plane.height; ++y) filter_row(plane.row(y), plane.width, scratch.row(y));
  for (int y = 0; y < plane.height; ++y) {
    const auto beside = [&](int v) { return scratch.row(reflect_101(y + v, plane.height)); };
    const std::int32_t *a = beside(-2), *b = beside(-1), *c = beside(0), *d = beside(1),
                       *e = beside(2);
    std::int32_t* to = plane.row(y);
    for (int x = 0; x < plane.width; ++x) to[x] = filtered(a[x], b[x], c[x], d[x], e[x]);
  }
}

}  // namespace gazed::saliency
