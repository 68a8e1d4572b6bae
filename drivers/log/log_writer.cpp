#include "drivers/log/log_writer.hpp"

#include <stdexcept>
#include <utility>

namespace gazed::log {

LogWriter::LogWriter(std::string path, const lcm::Channels& channels, std::string configuration)
    : path_(std::move(path)),
      encoder_(channels),
      file_(path_, channels.configuration, std::move(configuration)) {
  refuse_what_is_no_file(path_);
  if (const LogTrouble trouble = file_.open())
    throw std::invalid_argument(words(trouble, path_, 0));
}

bool LogWriter::add(const Event& event) {
  if (trouble_) return false;
  trouble_ = file_.add(event);
  if (trouble_) file_.close();
  return !trouble_;
}

std::string LogWriter::fault() const {
  return words(trouble_, path_, file_.events());
}

}  // namespace gazed::log
