// Sentences with numbers in them.
#pragma once

#include <string>

namespace gazed {

/// printf's format, checked by the compiler; any length.
[[nodiscard]] [[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace gazed
