#include "agent/lab/calibration/camera_file.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <stdexcept>
#include <vector>
#include <yaml-cpp/yaml.h>

#include "agent/base/regular_file.hpp"
#include "agent/base/text.hpp"
#include "agent/base/trailing_zeros.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr std::size_t most_bytes = 1'000'000;

/// What all formats say, before any of it is believed.
struct Described {
  int width_px = 0, height_px = 0;  // 0: not said
  std::vector<double> camera;       // fx, fy, cx, cy, or the nine of a matrix, row by row
  std::vector<double> distortion;
  std::string lens;  // the model's name; empty: not said
};

class CameraFile {
 public:
  explicit CameraFile(const std::filesystem::path& file)
      : name_(base::excerpt(file.string(), base::longest_file_name)),
        text_(base::read_text(file.string(), most_bytes)) {
    if (text_.size() > most_bytes) fail("more than 1 MB", "a calibration");
  }

  [[nodiscard]] Described described() const {
    return text_.find("<opencv_storage>") != std::string::npos ? of_xml() : of_yaml();
  }

  [[noreturn]] void fail(const std::string& found, const std::string& allowed) const {
    throw std::invalid_argument(name_ + ": " + found + " found; allowed: " + allowed);
  }
  /// `why`: in the words of who reads the format.
  [[noreturn]] void fail_to_read(const std::string& why, const std::string& allowed) const {
    throw std::invalid_argument(name_ + ": cannot be read: " + base::excerpt(why) +
                                "; allowed: " + allowed);
  }

 private:
  [[nodiscard]] Described of_yaml() const;
  [[nodiscard]] static Described of_camchain(const YAML::Node& camera);
  [[nodiscard]] Described of_xml() const;

  std::string name_, text_;
};

YAML::Node first_of(const YAML::Node& map, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (map[key]) return map[key];
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

/// An array, or the data of a matrix.
std::vector<double> numbers_of(const YAML::Node& node) {
  if (!node) return {};
  return (node.IsMap() ? node["data"] : node).as<std::vector<double>>();
}

Described CameraFile::of_camchain(const YAML::Node& camera) {
  Described result;
  const std::string projection = camera["camera_model"].as<std::string>("pinhole");
  const std::string lens = camera["distortion_model"].as<std::string>("none");
  result.lens = projection == "pinhole" ? lens : projection;
  result.camera = numbers_of(camera["intrinsics"]);
  result.distortion = numbers_of(camera["distortion_coeffs"]);
  const auto size = camera["resolution"].as<std::vector<int>>();
  if (size.size() == 2) result.width_px = size[0], result.height_px = size[1];
  return result;
}

Described CameraFile::of_yaml() const try {
  // OpenCV's first line is no YAML directive.
  const bool of_opencv = text_.starts_with("%YAML:");
  const YAML::Node root = YAML::Load(of_opencv ? text_.substr(text_.find('\n') + 1) : text_);
  if (!root.IsMap()) fail("no key", "camera_matrix or cam0");
  if (root["cam0"]) return of_camchain(root["cam0"]);
  return {.width_px = root["image_width"].as<int>(0),
          .height_px = root["image_height"].as<int>(0),
          .camera = numbers_of(first_of(root, {"camera_matrix", "cameraMatrix", "K", "M1"})),
          .distortion = numbers_of(
              first_of(root, {"distortion_coefficients", "distCoeffs", "dist_coeffs", "D", "D1"})),
          .lens = root["distortion_model"].as<std::string>("")};
} catch (const YAML::Exception& error) {
  fail_to_read(error.what(), "ROS's or OpenCV's YAML, Kalibr's camchain");
}

Described CameraFile::of_xml() const try {
  const cv::FileStorage storage(text_, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  const auto numbers = [&storage](std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
      cv::Mat matrix;
      storage[key] >> matrix;
      if (matrix.empty()) continue;
      matrix.convertTo(matrix, CV_64F);
      return std::vector<double>(matrix.begin<double>(), matrix.end<double>());
    }
    return std::vector<double>();
  };
  Described result;
  if (!storage["image_width"].empty()) storage["image_width"] >> result.width_px;
  if (!storage["image_height"].empty()) storage["image_height"] >> result.height_px;
  result.camera = numbers({"camera_matrix", "cameraMatrix", "Camera_Matrix", "M1"});
  result.distortion =
      numbers({"distortion_coefficients", "distCoeffs", "Distortion_Coefficients", "D1"});
  return result;
} catch (const cv::Exception& error) {
  fail_to_read(error.err, "OpenCV's XML");
}

bool all_finite(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
}

}  // namespace

geometry::CameraModel read_camera_file(const std::filesystem::path& path,
                                       const geometry::CameraModel& believed) {
  const CameraFile file(path);
  const Described found = file.described();
  // ROS calls the rational model so also where only its first five numbers are used.
  constexpr auto lenses =
      std::to_array<std::string_view>({"", "plumb_bob", "rational_polynomial", "radtan", "none"});
  if (std::ranges::find(lenses, found.lens) == lenses.end()) {
    file.fail("the lens model " + base::excerpt(found.lens),
              "plumb_bob, radtan; calibrate anew with a pinhole model of 5 numbers");
  }
  const std::vector<double>& k = found.camera;
  geometry::CameraModel camera = believed;
  if (k.size() == 4) {
    camera.focal_px = {k[0], k[1]};
    camera.centre_px = {k[2], k[3]};
  } else if (k.size() == 9) {
    camera.focal_px = {k[0], k[4]};
    camera.centre_px = {k[2], k[5]};
  } else {
    file.fail(base::text("a camera of %zu numbers", k.size()),
              "camera_matrix with 9, or a camchain's intrinsics with 4");
  }
  if (!all_finite(k) || !all_finite(found.distortion) || camera.focal_px.minCoeff() <= 0.0) {
    file.fail("a focal length that is not above 0, or a number that is not finite",
              "a calibrated camera");
  }
  if (found.width_px > 0 && found.height_px > 0) {
    camera.width_px = found.width_px;
    camera.height_px = found.height_px;
  }
  if (!base::assign_with_zeros(found.distortion, found.distortion.empty() ? 0 : 4,
                               camera.distortion)) {
    file.fail(base::text("distortion of %zu numbers", found.distortion.size()),
              "4 or 5, zeros behind them; the rational model is not gazed's: calibrate with 5");
  }
  return camera;
}

std::optional<CameraFormat> camera_format_of(const std::filesystem::path& file) {
  if (file.extension() == ".yaml" || file.extension() == ".yml") return CameraFormat::ros_yaml;
  if (file.extension() == ".xml") return CameraFormat::opencv_xml;
  return std::nullopt;
}

namespace {

std::string ros_yaml(const geometry::CameraModel& camera) {
  const Eigen::Matrix3d k = geometry::calibration_matrix(camera);
  YAML::Emitter out;
  out.SetDoublePrecision(12);
  const auto matrix = [&out](const char* name, int rows, int columns,
                             const std::vector<double>& numbers) {
    out << YAML::Key << name << YAML::Value << YAML::BeginMap;
    out << YAML::Key << "rows" << YAML::Value << rows << YAML::Key << "cols" << YAML::Value
        << columns << YAML::Key << "data" << YAML::Value << YAML::Flow << numbers << YAML::EndMap;
  };
  const auto row_by_row = [&k](bool with_shift) {
    std::vector<double> numbers;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) numbers.push_back(k(row, column));
      if (with_shift) numbers.push_back(0.0);
    }
    return numbers;
  };
  out << YAML::BeginMap << YAML::Key << "image_width" << YAML::Value << camera.width_px << YAML::Key
      << "image_height" << YAML::Value << camera.height_px << YAML::Key << "camera_name"
      << YAML::Value << "head";
  matrix("camera_matrix", 3, 3, row_by_row(false));
  out << YAML::Key << "distortion_model" << YAML::Value << "plumb_bob";
  matrix("distortion_coefficients", 1, 5, {camera.distortion.begin(), camera.distortion.end()});
  matrix("rectification_matrix", 3, 3, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  matrix("projection_matrix", 3, 4, row_by_row(true));
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

std::string opencv_xml(const geometry::CameraModel& camera) {
  cv::FileStorage storage(".xml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  const Eigen::Matrix3d k = geometry::calibration_matrix(camera);
  cv::Mat matrix(3, 3, CV_64F);
  for (int i = 0; i < 9; ++i) matrix.at<double>(i / 3, i % 3) = k(i / 3, i % 3);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  storage << "image_width" << camera.width_px << "image_height" << camera.height_px;
  storage << "camera_matrix" << matrix << "distortion_coefficients" << cv::Mat(distortion);
  return storage.releaseAndGetString();
}

}  // namespace

std::string camera_text(const geometry::CameraModel& camera, CameraFormat format) {
  return format == CameraFormat::ros_yaml ? ros_yaml(camera) : opencv_xml(camera);
}

}  // namespace gazed::lab::calibration
