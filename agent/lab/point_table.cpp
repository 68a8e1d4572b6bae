#include "agent/lab/point_table.hpp"

#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "agent/lab/csv.hpp"
#include "agent/text.hpp"

namespace gazed {

namespace {

namespace fs = std::filesystem;

constexpr const char* csv_header =
    "id,status,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,range_m,range_sigma_m,residual_px,"
    "parallax_rad\n";
constexpr const char* column_header =
    "id            status         x m         y m         z m         range m            "
    "residual px\n";

bool is_stdout(const std::string& csv) {
  return csv.empty() || csv == "-";
}

/// Where the rows of `file` stand until all are there.
fs::path part_of(const std::string& file) {
  std::error_code missing;
  const fs::file_status status = fs::status(file, missing);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  return file + ".part";
}

/// 12 significant digits; "nan" whatever its sign bit, and no negative zero.
std::string number(double value) {
  if (std::isnan(value)) return "nan";
  return text("%.12g", value == 0.0 ? 0.0 : value);
}

}  // namespace

PointTable::PointTable(const std::string& csv)
    : name_(is_stdout(csv) ? "standard output" : csv),
      to_terminal_(is_stdout(csv) && isatty(STDOUT_FILENO) == 1),
      columns_(to_terminal_ && csv.empty()),
      part_(is_stdout(csv) ? fs::path() : part_of(csv)),
      file_(is_stdout(csv) ? stdout
                           : std::fopen(part_.empty() ? csv.c_str() : part_.c_str(), "wb")) {
  if (file_ == nullptr) {
    throw std::invalid_argument(name_ +
                                ": cannot be written: " + std::generic_category().message(errno));
  }
  std::fputs(columns_ ? column_header : csv_header, file_);
}

PointTable::~PointTable() {
  if (file_ == nullptr || is_to_stdout()) return;
  std::fclose(file_);
  std::error_code ignored;
  if (!part_.empty()) fs::remove(part_, ignored);
}

void PointTable::add(const std::string& id, const PointEstimate& point) {
  ++rows_;
  ++rows_by_status_[static_cast<std::size_t>(point.status)];
  const std::string status(name(point.status));
  if (columns_) {
    std::fprintf(
        file_, "%-12s  %-13s %s\n", excerpt(id).c_str(), status.c_str(),
        text("%10.4f  %10.4f  %10.4f  %10.4f +- %-9.4f %8.3f", point.point_m.x(), point.point_m.y(),
             point.point_m.z(), point.range_m, point.range_sigma_m, point.residual_px)
            .c_str());
    return;
  }
  std::string row = csv_field(id) + "," + status;
  const Eigen::Vector3d sigma_m = point.covariance_m2.diagonal().cwiseSqrt();
  for (const double value :
       {point.point_m.x(), point.point_m.y(), point.point_m.z(), sigma_m.x(), sigma_m.y(),
        sigma_m.z(), point.range_m, point.range_sigma_m, point.residual_px, point.parallax_rad}) {
    row += ',';
    row += number(value);
  }
  row += '\n';
  std::fwrite(row.data(), 1, row.size(), file_);
}

void PointTable::finish() {
  bool good = std::fflush(file_) == 0 && std::ferror(file_) == 0;
  if (!is_to_stdout()) good = std::fclose(std::exchange(file_, nullptr)) == 0 && good;
  std::error_code error(errno, std::generic_category());
  if (good && !part_.empty()) {
    const bool is_there = fs::exists(name_);  // then a link is followed, and what it names replaced
    fs::rename(part_, is_there ? fs::canonical(name_, error) : fs::path(name_), error);
    good = !error;
  }
  if (good) return;
  std::error_code ignored;
  if (!part_.empty()) fs::remove(part_, ignored);
  throw std::runtime_error(name_ + ": could not be written: " + error.message());
}

std::string PointTable::summary() const {
  std::string counts;
  for (std::size_t i = 0; i < rows_by_status_.size(); ++i) {
    if (rows_by_status_[i] == 0) continue;
    counts += (counts.empty() ? ": " : ", ") + std::to_string(rows_by_status_[i]) + " ";
    counts += name(static_cast<Status>(i));
  }
  return std::to_string(rows_) + (rows_ == 1 ? " correspondence" : " correspondences") + counts;
}

}  // namespace gazed
