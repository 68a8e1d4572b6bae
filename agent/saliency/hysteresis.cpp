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

// None outside the frame, and for a pixel that is not a number. A last sample stands for the pixels
// beyond it as well.
std::optional<Sample> sample_at(const SaliencyPlane& map, const geometry::Pixel& pixel) {
  const geometry::Pixel place = pixel / saliency_cell_px;
  if (!(place.x() > -0.5 && place.y() > -0.5 && place.x() < map.width && place.y() < map.height))
    return std::nullopt;
  return Sample{std::min(static_cast<int>(place.x() + 0.5), map.width - 1),
                std::min(static_cast<int>(place.y() + 0.5), map.height - 1)};
}

// The largest of a sample and its 8 neighbours; the sample itself when none is larger.
Sample largest_around(const SaliencyPlane& map, Sample centre) {
  Sample largest = centre;
  for (int y = std::max(centre.y - 1, 0); y <= std::min(centre.y + 1, map.height - 1); ++y)
    for (int x = std::max(centre.x - 1, 0); x <= std::min(centre.x + 1, map.width - 1); ++x)
      if (map.row(y)[x] > map.row(largest.y)[largest.x]) largest = {x, y};
  return largest;
}

// Every step is strictly upwards, so it ends.
Sample summit_above(const SaliencyPlane& map, Sample sample) {
  while (true) {
    const Sample next = largest_around(map, sample);
    if (next.x == sample.x && next.y == sample.y) return sample;
    sample = next;
  }
}

}  // namespace

Winner find_winner(const SaliencyPlane& map, const geometry::Pixel& previous_px,
                   std::int32_t margin) {
  const Winner rival = find_winner(map);
  const std::optional<Sample> previous = sample_at(map, previous_px);
  if (!previous) return rival;
  const Sample kept = summit_above(map, *previous);
  const auto at_least =
      std::int64_t{map.row(kept.y)[kept.x]} * ((std::int64_t{1} << margin_fraction_bits) + margin);
  const std::int64_t rival_value = std::int64_t{map.row(rival.y)[rival.x]} << margin_fraction_bits;
  return rival_value > at_least ? rival : refined_winner(map, kept.x, kept.y);
}

}  // namespace gazed::saliency
