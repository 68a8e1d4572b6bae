// Any bytes as a camera's JPEG frame of 32 x 16 pixels.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "drivers/jpeg/decoder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed;
  static base::Image image;
  const std::string problem = jpeg::decode(std::span(data, size), 32, 16, image);
  const base::ImageView view = image.view();
  if (problem.empty() && (view.width_px != 32 || view.height_px != 16)) std::abort();
  return 0;
}
