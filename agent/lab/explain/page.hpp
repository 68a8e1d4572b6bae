// The page that explains a fixation, and its pictures and charts as files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "agent/lab/explain/replay.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::lab::explain {

struct Explained {
  std::filesystem::path page;
  std::string complaint;  // what the page lacks, and how to have it; empty when it lacks nothing
};

/// Writes DIR/fixation-N.html, which needs no other file, and beside it what it shows:
/// fixation-N-look-K.png, -map-K.png, -patches.png, -range.png, -costs.png. `all` are the lines of
/// all fixations of the recording. Throws std::runtime_error for a file that cannot be written.
[[nodiscard]] Explained write_page(const ReplayedFixation& replayed,
                                   const settings::Settings& settings, const std::string& log_file,
                                   const std::vector<std::string>& all,
                                   const std::filesystem::path& folder);

}  // namespace gazed::lab::explain
