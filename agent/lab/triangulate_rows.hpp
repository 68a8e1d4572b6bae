// Correspondences to points, one row at a time.
#pragma once

#include "agent/lab/correspondences.hpp"
#include "agent/lab/pair_file.hpp"
#include "agent/lab/point_table.hpp"
#include "agent/triangulation/methods/method.hpp"

namespace gazed::lab {

/// Adds a row to `table` for each that `reader` has; holds no more than one. Throws what the reader
/// throws.
void triangulate(const CameraPair& pair, triangulation::methods::Method method,
                 CorrespondenceReader& reader, PointTable& table);

}  // namespace gazed::lab
