// What no answer can be made of: numbers that are none, and sizes that cannot be.
#pragma once

#include <optional>
#include <string>

#include "agent/geometry/robot.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/linear_mmse.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed {

/// In words, with the value; none when all is well.
[[nodiscard]] std::optional<std::string> what_is_invalid(const TwoViews& views,
                                                         const ErrorSources& errors,
                                                         const Gate& gate);
[[nodiscard]] std::optional<std::string> what_is_invalid(const Prior& prior);
[[nodiscard]] std::optional<std::string> what_is_invalid(const Uncertainty& uncertainty);

}  // namespace gazed
