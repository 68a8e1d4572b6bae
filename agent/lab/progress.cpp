#include "agent/lab/progress.hpp"

#include <cstdio>
#include <unistd.h>
#include <utility>

namespace gazed {

void Progress::show(std::size_t done) {
  constexpr std::chrono::seconds patience{2};
  if (isatty(STDERR_FILENO) == 0) return;
  if (std::chrono::steady_clock::now() - start_ < patience) return;
  std::fprintf(stderr, "\r%zu of %zu", done, total_);
  shown_ = true;
}

void Progress::clear() {
  if (std::exchange(shown_, false)) std::fputs("\r\033[K", stderr);
}

}  // namespace gazed
