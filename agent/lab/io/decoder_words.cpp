#include "agent/lab/io/decoder_words.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

#include "agent/base/text.hpp"

namespace gazed::lab::io {

namespace {

/// Of "imdecode_(''): can't read data: OpenCV(4.6.0) FILE:LINE: error: (CODE) REASON in function
/// 'NAME'" the reason; any other line as it is.
std::string_view reason_of(std::string_view line) {
  constexpr std::string_view before_code = "error: (", before_reason = ") ";
  const std::size_t code = line.find(before_code);
  const std::size_t reason =
      code == std::string_view::npos ? code : line.find(before_reason, code + before_code.size());
  if (reason == std::string_view::npos) return line;
  line.remove_prefix(reason + before_reason.size());
  return line.substr(0, line.rfind(" in function '"));
}

}  // namespace

DecoderWords::DecoderWords()
    : kept_(memfd_create("decoder_words", MFD_CLOEXEC)), standard_error_(dup(STDERR_FILENO)) {
  std::fflush(stderr);
  if (kept_.get() >= 0 && standard_error_.get() >= 0) dup2(kept_.get(), STDERR_FILENO);
}

void DecoderWords::stop() {
  std::fflush(stderr);
  if (standard_error_.get() >= 0) dup2(standard_error_.get(), STDERR_FILENO);
  standard_error_ = base::FileDescriptor(-1);
}

std::string DecoderWords::heard() {
  stop();
  std::array<char, 1024> bytes{};
  const ssize_t count = pread(kept_.get(), bytes.data(), bytes.size(), 0);
  if (count <= 0) return {};
  const std::string_view all(bytes.data(), static_cast<std::size_t>(count));
  return base::excerpt(reason_of(all.substr(0, all.find('\n'))));
}

}  // namespace gazed::lab::io
