// saliency_frames report|robust|surround rgb|yuyv N [WIDTH HEIGHT]: looks at the built-in frame N
// times. The difference of two runs is the cost of a frame without that of starting: what
// `instructions` and `cycles` count. Needs nothing but the saliency stage, so it can be built for
// any target.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/benchmarks/room_frame.hpp"
#include "tests/unit/saliency/frames.hpp"

namespace {

int positive(const char* text) {
  char* end = nullptr;
  const long number = std::strtol(text, &end, 10);
  if (*end != '\0' || number < 1 || number > 1'000'000)
    throw std::invalid_argument("'" + std::string(text) + "' found; wanted: 1 to 1000000");
  return static_cast<int>(number);
}

gazed::SaliencyProfile profile_of(std::string_view text) {
  if (text == "report") return gazed::SaliencyProfile::report;
  if (text == "robust") return gazed::SaliencyProfile::robust;
  if (text == "surround") return gazed::SaliencyProfile::surround;
  throw std::invalid_argument("'" + std::string(text) +
                              "' found; wanted: report, robust, surround");
}

bool is_rgb(std::string_view text) {
  if (text != "rgb" && text != "yuyv")
    throw std::invalid_argument("'" + std::string(text) + "' found; wanted: rgb or yuyv");
  return text == "rgb";
}

void look(int argc, char** argv) {
  if (argc != 4 && argc != 6)
    throw std::invalid_argument("usage: report|robust|surround rgb|yuyv FRAMES [WIDTH HEIGHT]");
  gazed::SaliencySettings settings;
  settings.profile = profile_of(argv[1]);
  const bool rgb = is_rgb(argv[2]);
  const int frames = positive(argv[3]);
  const int width_px = argc == 6 ? positive(argv[4]) : 640;
  const int height_px = argc == 6 ? positive(argv[5]) : 480;

  const gazed::Image room = gazed::benchmarks::room_frame(width_px, height_px);
  const std::vector<std::uint8_t> yuyv = gazed::frames::yuyv_of(room.view());
  const gazed::ImageView frame =
      rgb ? room.view() : gazed::frames::yuyv_view(yuyv, width_px, height_px);
  gazed::Saliency stage(settings, width_px, height_px);
  gazed::Pixel winner = gazed::Pixel::Zero();
  for (int i = 0; i < frames; ++i) winner = stage.look(frame).peak_px;
  std::printf("winner %.3f %.3f\n", winner.x(), winner.y());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    look(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "saliency_frames: %s\n", error.what());
    return 2;
  }
  return 0;
}
