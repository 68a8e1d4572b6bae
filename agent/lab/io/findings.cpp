#include "agent/lab/io/findings.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "agent/lab/io/csv.hpp"

namespace gazed::lab::io {

namespace {

bool is_stdout(const std::string& csv) {
  return csv.empty() || csv == "-";
}

}  // namespace

FindingsWriter::FindingsWriter(const std::string& csv, std::span<const std::string> images,
                               double distinctness_min)
    : name_(is_stdout(csv) ? "standard output" : csv),
      to_terminal_(is_stdout(csv) && isatty(STDOUT_FILENO) == 1),
      columns_(to_terminal_ && csv.empty()),
      file_(is_stdout(csv) ? stdout : std::fopen(csv.c_str(), "w")),
      distinctness_min_(distinctness_min) {
  if (file_ == nullptr) {
    throw std::invalid_argument(name_ +
                                ": cannot be written: " + std::generic_category().message(errno));
  }
  for (const std::string& image : images) {
    image_width_ = std::max(image_width_, static_cast<int>(image.size()));
  }
  if (columns_) {
    std::fprintf(file_, "%-*s %9s %9s  %8s  %12s\n", image_width_, "image", "x px", "y px",
                 "saliency", "distinctness");
  } else {
    std::fputs("image,x_px,y_px,saliency,distinctness,distinct\n", file_);
  }
}

FindingsWriter::~FindingsWriter() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

void FindingsWriter::add(const Finding& finding) {
  const double x_px = finding.winner_px.x();
  const double y_px = finding.winner_px.y();
  const auto saliency = static_cast<double>(finding.saliency);
  const auto distinctness = static_cast<double>(finding.distinctness);
  const bool distinct = distinctness >= distinctness_min_;
  if (columns_) {
    std::fprintf(file_, "%-*s %9.1f %9.1f  %8.3f  %12.3f%s\n", image_width_, finding.image.c_str(),
                 x_px, y_px, saliency, distinctness, distinct ? "" : "  no salient object");
  } else {
    std::fprintf(file_, "%s,%.3f,%.3f,%.6f,%.6f,%s\n", csv_field(finding.image).c_str(), x_px, y_px,
                 saliency, distinctness, distinct ? "yes" : "no");
  }
}

void FindingsWriter::finish() {
  bool good = std::fflush(file_) == 0 && std::ferror(file_) == 0;
  if (file_ != stdout) good = std::fclose(std::exchange(file_, nullptr)) == 0 && good;
  if (!good) {
    throw std::runtime_error(name_ +
                             ": could not be written: " + std::generic_category().message(errno));
  }
}

}  // namespace gazed::lab::io
