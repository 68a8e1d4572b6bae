#include "agent/saliency/hysteresis.hpp"

#include <algorithm>
#include <optional>

#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

namespace {

struct Sample {
  int x = 0;
  int y = 0;
};

// None outside the frame, and for a pixel that is not finite. The last sample also stands for the
// pixels beyond it.
std::optional<Sample> sample_at(const SaliencyPlane& map, const geometry::Pixel& pixel) {
  const geometry::Pixel place = pixel / saliency_cell_px;
  if (!(place.x() > -0.5 && place.y() > -0.5 && place.x() < map.width && place.y() < map.height))
    return std::nullopt;
  return Sample{std::min(static_cast<int>(place.x() + 0.5), map.width - 1),
                std::min(static_cast<int>(place.y() + 0.5), map.height - 1)};
}

}  // namespace

Winner find_winner(const SaliencyPlane& map, const geometry::Pixel& previous_px,
                   std::int32_t margin) {
  const Winner rival = find_winner(map);
  const std::optional<Sample> previous = sample_at(map, previous_px);
  if (!previous) return rival;
  const Winner kept = summit_above(map, previous->x, previous->y);
  const auto at_least =
      std::int64_t{map.row(kept.y)[kept.x]} * ((std::int64_t{1} << margin_fraction_bits) + margin);
  const std::int64_t rival_value = std::int64_t{map.row(rival.y)[rival.x]} << margin_fraction_bits;
  return rival_value > at_least ? rival : kept;
}

}  // namespace gazed::saliency
