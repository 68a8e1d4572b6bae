// Values that are allowed and can hardly be meant.
#pragma once

#include <string>
#include <vector>

#include "agent/settings/settings.hpp"

namespace gazed::settings {

/// A sentence for each: the key, its value and what is usual. Ranges of keys are the widest that
/// make sense for some robot; these are a NAO's.
[[nodiscard]] std::vector<std::string> doubts(const Settings& settings);

}  // namespace gazed::settings
