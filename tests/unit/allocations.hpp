// Counts what a test program allocates, once allocations.cpp is linked into it.
#pragma once

namespace gazed::test {

/// Calls of operator new so far, by all threads.
[[nodiscard]] long allocations();

}  // namespace gazed::test
