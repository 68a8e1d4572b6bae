#include "scratch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace gazed::lab {

namespace {

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  quoted += '\'';
  return quoted;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "gazelab_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder " + name);
  folder_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Outcome run_gazelab(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  const ScratchFolder outputs;
  std::string command;
  if (!surroundings.path.empty()) command = "PATH=" + shell_quoted(surroundings.path) + " ";
  command += GAZELAB_PROGRAM;
  for (const std::string& argument : arguments) command.append(" ").append(shell_quoted(argument));
  command.append(" >").append(outputs / "out").append(" 2>").append(outputs / "err");
  command.append(" <").append(shell_quoted(surroundings.standard_input));
  const int status = std::system(command.c_str());
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = file_text(outputs / "out"),
          .err = file_text(outputs / "err")};
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

void write_cut(const std::filesystem::path& whole, const std::filesystem::path& cut,
               std::size_t bytes) {
  write_text(cut, file_text(whole).substr(0, bytes));
}

cv::Mat red_disc(cv::Size size, cv::Point2d centre_px, double radius_px) {
  const cv::Vec3d wall(150.0, 150.0, 150.0);  // blue, green, red
  const cv::Vec3d red(30.0, 30.0, 200.0);
  cv::Mat picture(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double inside = radius_px - std::hypot(x - centre_px.x, y - centre_px.y) + 0.5;
      const double part = std::clamp(inside, 0.0, 1.0);
      picture.at<cv::Vec3b>(y, x) = wall * (1.0 - part) + red * part;
    }
  }
  return picture;
}

}  // namespace gazed::lab
