#include "agent/lab/triangulate_rows.hpp"

#include <string>

#include "agent/lab/progress.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed {

void triangulate(const CameraPair& pair, Method method, CorrespondenceReader& reader,
                 PointTable& table) {
  const Gate gate{.relative_sigma_max = pair.relative_sigma_max};
  Progress progress(reader.lines().bytes_in_all());
  while (const auto correspondence = reader.next()) {
    const TwoViews views = two_views(pair, correspondence->pixel_1, correspondence->pixel_2);
    table.add(correspondence->id, estimate_point(views, error_sources(pair, views), gate, method));
    if (!table.to_terminal()) {
      progress.show(reader.lines().bytes_read(), std::to_string(table.rows()) + " correspondences");
    }
  }
}

}  // namespace gazed
