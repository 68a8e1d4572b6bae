#include "agent/lab/io/line_reader.hpp"

#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <sys/stat.h>
#include <system_error>

namespace gazed::lab::io {

namespace {

std::runtime_error read_error(const std::string& name, const char* what) {
  return std::runtime_error(name + ": cannot be " + what + ": " +
                            std::generic_category().message(errno));
}

}  // namespace

LineReader::LineReader(const std::string& file)
    : name_(file == "-" ? "standard input" : file),
      file_(file == "-" ? stdin : std::fopen(file.c_str(), "rb")) {
  if (!file_) throw read_error(name_, "opened");
  struct stat about {};
  if (fstat(fileno(file_.get()), &about) == 0 && S_ISREG(about.st_mode)) {
    bytes_in_all_ = static_cast<std::size_t>(about.st_size);
  }
}

bool LineReader::next() {
  line_.clear();
  int c = EOF;
  while ((c = getc_unlocked(file_.get())) != EOF) {
    ++bytes_read_;
    if (c == '\n') break;
    line_ += static_cast<char>(c);
    if (line_.size() > longest_line) {
      ++number_;
      throw std::runtime_error(place() + "the line is longer than " + std::to_string(longest_line) +
                               " bytes");
    }
  }
  if (std::ferror(file_.get()) != 0) throw read_error(name_, "read");
  if (c == EOF && line_.empty()) return false;
  ++number_;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
  if (line_.ends_with('\r')) line_.pop_back();
  return true;
}

std::string LineReader::place() const {
  return name_ + ":" + std::to_string(number_) + ": ";
}

}  // namespace gazed::lab::io
