// Recordings of earlier runs beside the one that is written: FILE.1 is the newest of them, FILE.2
// the one before.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::log {

/// Makes FILE.1 of `path`, FILE.2 of FILE.1 and so on; no file is lost. 0, or the errno of the
/// step that failed; what was renamed before stays so.
[[nodiscard]] int keep_as_older(const std::string& path);

/// Removes the oldest ones while they and `newest_bytes` have more than `most_bytes` together.
void remove_oldest(const std::string& path, std::int64_t newest_bytes, double most_bytes);

}  // namespace gazed::log
