#include "agent/lab/point_table.hpp"

#include <Eigen/Core>
#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/lab/io/csv.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

constexpr const char* point_header =
    "id,status,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,range_m,range_sigma_m,residual_px,"
    "parallax_rad\n";
constexpr const char* column_header =
    "id            status         x m         y m         z m         range m            "
    "residual px\n";

bool is_stdout(const std::string& csv) {
  return csv.empty() || csv == "-";
}

[[noreturn]] void refuse(const std::string& name) {
  throw std::invalid_argument(name +
                              ": cannot be written: " + std::generic_category().message(errno));
}

struct OpenFile {
  std::FILE* stream = nullptr;
  fs::path target;  // the name it gets when it is complete; empty: it has that already
  fs::path part;    // and until then
};

/// A file of its own beside `target`, whatever is there and whoever else writes: 'x' never opens
/// one that exists (O_EXCL).
OpenFile open_part_of(const fs::path& target) {
  for (int attempt = 0;; ++attempt) {
    const fs::path part = target.parent_path() /
                          base::text("gazelab-%d-%d.part", static_cast<int>(getpid()), attempt);
    std::FILE* stream = std::fopen(part.c_str(), "wbx");
    if (stream != nullptr) return {.stream = stream, .target = target, .part = part};
    if (errno != EEXIST) return {};
  }
}

OpenFile open_output(const std::string& csv) {
  if (is_stdout(csv)) return {.stream = stdout, .target = {}, .part = {}};
  std::error_code error;
  const fs::file_status status = fs::status(csv, error);
  OpenFile file;
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file.stream = std::fopen(csv.c_str(), "wb");
  } else {
    // A link is followed, and what it names replaced.
    file = open_part_of(fs::exists(status) ? fs::canonical(csv, error) : fs::path(csv));
  }
  if (file.stream == nullptr) refuse(csv);
  return file;
}

/// A length for a person, in `width` columns.
std::string metres(double value_m, int width) {
  constexpr double most_with_decimals_m = 1e5;  // beyond it they would not fit
  return base::text(std::abs(value_m) < most_with_decimals_m ? "%*.4f" : "%*.4g", width, value_m);
}

/// 12 significant digits; "nan" whatever its sign bit, and no negative zero.
std::string number(double value) {
  if (std::isnan(value)) return "nan";
  return base::text("%.12g", value == 0.0 ? 0.0 : value);
}

}  // namespace

std::string column_row(const std::string& id, const triangulation::PointEstimate& point) {
  constexpr int width = 10;
  std::string row = base::text("%-12s  %-13s", base::excerpt(id).c_str(),
                               std::string(triangulation::name(point.status)).c_str());
  for (int i = 0; i < 3; ++i) row.append(" ").append(metres(point.point_m[i], width)).append(" ");
  row.append(" ").append(metres(point.range_m, width));
  row.append(" +- ").append(metres(point.range_sigma_m, -9));
  return row.append(base::text(" %8.3g\n", point.residual_px));
}

PointTable::PointTable(const std::string& csv)
    : name_(is_stdout(csv) ? "standard output" : csv),
      to_terminal_(is_stdout(csv) && isatty(STDOUT_FILENO) == 1),
      columns_(to_terminal_ && csv.empty()) {
  const OpenFile file = open_output(csv);
  file_ = file.stream;
  target_ = file.target;
  part_ = file.part;
  std::fputs(columns_ ? column_header : point_header, file_);
}

PointTable::~PointTable() {
  if (file_ == nullptr || is_to_stdout()) return;
  std::fclose(file_);
  std::error_code ignored;
  if (!part_.empty()) fs::remove(part_, ignored);
}

void PointTable::add(const std::string& id, const triangulation::PointEstimate& point) {
  ++rows_;
  ++rows_by_status_[static_cast<std::size_t>(point.status)];
  if (columns_) {
    std::fputs(column_row(id, point).c_str(), file_);
    return;
  }
  std::string row = io::csv_field(id) + ",";
  row += triangulation::name(point.status);
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
    fs::rename(part_, target_, error);
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
    counts += triangulation::name(static_cast<triangulation::Status>(i));
  }
  return std::to_string(rows_) + (rows_ == 1 ? " correspondence" : " correspondences") + counts;
}

}  // namespace gazed::lab
