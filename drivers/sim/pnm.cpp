#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "agent/base/regular_file.hpp"
#include "drivers/sim/mipmap.hpp"

namespace gazed::sim {

namespace {

constexpr std::size_t largest_file = 64U << 20U;
constexpr int largest_side = 4096;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw std::invalid_argument(path + ": " + what + "; allowed: an 8 bit P5 or P6 picture");
}

std::string contents(const std::string& path) {
  std::string bytes = base::read_text(path, largest_file);
  if (bytes.size() > largest_file) refuse(path, "over 64 MB");
  return bytes;
}

/// The next number of the header, after white space and comments; -1 when there is none.
int header_number(std::string_view bytes, std::size_t& position) {
  const auto is = [&](int (*kind)(int)) {
    return position < bytes.size() && kind(static_cast<unsigned char>(bytes[position])) != 0;
  };
  while (is(std::isspace) || (position < bytes.size() && bytes[position] == '#')) {
    if (bytes[position] == '#')
      while (position < bytes.size() && bytes[position] != '\n') ++position;
    else
      ++position;
  }
  if (!is(std::isdigit)) return -1;
  int number = 0;
  while (is(std::isdigit)) {
    number = std::min(number * 10 + (bytes[position] - '0'), 1'000'000);
    ++position;
  }
  return number;
}

}  // namespace

std::shared_ptr<const MipMap> load_pnm(const std::string& path) {
  const std::string bytes = contents(path);
  const std::string_view magic = std::string_view(bytes).substr(0, 2);
  if (magic != "P5" && magic != "P6") refuse(path, "no P5 or P6 at the start");
  const bool grey = magic == "P5";
  std::size_t position = 2;
  const int width = header_number(bytes, position);
  const int height = header_number(bytes, position);
  const int greatest = header_number(bytes, position);
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    refuse(path, "size " + std::to_string(width) + " x " + std::to_string(height) + " found");
  if (greatest < 1 || greatest > 255)
    refuse(path, "greatest value " + std::to_string(greatest) + " found");
  ++position;  // the single white space after the header
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t needed = pixels * (grey ? 1U : 3U);
  if (position > bytes.size() || bytes.size() - position < needed)
    refuse(path, "truncated: " + std::to_string(bytes.size()) + " bytes found");
  std::vector<std::int16_t> samples;
  samples.reserve(pixels * 3U);
  const float scale = 255.0F / static_cast<float>(greatest) * MipMap::sample_scale;
  for (std::size_t i = 0; i < needed; ++i) {
    const int value = std::min<int>(static_cast<unsigned char>(bytes[position + i]), greatest);
    samples.insert(samples.end(), grey ? 3U : 1U,
                   static_cast<std::int16_t>(static_cast<float>(value) * scale + 0.5F));
  }
  return std::make_shared<const MipMap>(width, height, 3, false, std::move(samples));
}

}  // namespace gazed::sim
