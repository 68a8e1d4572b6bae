#include "agent/lab/io/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <unistd.h>
#include <utility>

namespace gazed::lab::io {

namespace {

constexpr std::chrono::seconds patience{2};
constexpr std::chrono::milliseconds interval{100};

std::string bar(std::size_t done, std::size_t total) {
  constexpr std::size_t width = 20;
  const std::size_t filled = total == 0 ? width : std::min(width, width * done / total);
  std::string text = "[";
  text.append(filled, '=').append(width - filled, ' ').append("] ");
  return text;
}

}  // namespace

Progress::Progress(std::optional<std::size_t> total)
    : total_(total),
      to_terminal_(isatty(STDERR_FILENO) == 1),
      next_show_(Clock::now() + patience) {}

void Progress::show(std::size_t done, std::string_view label) {
  if (!to_terminal_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_show_) return;
  next_show_ = now + interval;
  std::string line = total_ ? bar(done, *total_) : "";
  if (!label.empty()) {
    line += label;
  } else {
    line += std::to_string(done);
    if (total_) line += " of " + std::to_string(*total_);
  }
  std::fprintf(stderr, "\r%s", line.c_str());
  shown_ = true;
}

void Progress::clear() {
  if (std::exchange(shown_, false)) std::fputs("\r\033[K", stderr);
}

}  // namespace gazed::lab::io
