#include "agent/lab/triangulate_rows.hpp"

#include <string>

#include "agent/lab/io/progress.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::lab {

void triangulate(const CameraPair& pair, triangulation::methods::Method method,
                 CorrespondenceReader& reader, PointTable& table) {
  const triangulation::Gate gate{.relative_sigma_max = pair.relative_sigma_max};
  io::Progress progress(reader.lines().bytes_in_all());
  while (const auto correspondence = reader.next()) {
    const triangulation::TwoViews views =
        two_views(pair, correspondence->pixel_1, correspondence->pixel_2);
    table.add(correspondence->id,
              triangulation::estimate_point(views, error_sources(pair, views), gate, method));
    if (!table.to_terminal()) {
      progress.show(reader.lines().bytes_read(), std::to_string(table.rows()) + " correspondences");
    }
  }
}

}  // namespace gazed::lab
