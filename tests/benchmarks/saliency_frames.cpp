// saliency_frames [--flicker] report|robust|surround rgb|yuyv N [WIDTH HEIGHT]: looks at the
// built-in frame N times, with --flicker as a still head does; prints the last winner, and a hash
// of all that the look gave. The difference of two runs is the cost of a frame without that of
// starting: what `instructions` and `cycles` count. Needs nothing but the saliency stage, so it can
// be built for any target.
#include <charconv>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/benchmarks/room_frame.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/result_hash.hpp"

namespace {

int positive(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || number < 1 || number > 1'000'000)
    throw std::invalid_argument("'" + std::string(text) + "' found; wanted: 1 to 1000000");
  return number;
}

gazed::saliency::SaliencyProfile profile_of(std::string_view text) {
  if (text == "report") return gazed::saliency::SaliencyProfile::report;
  if (text == "robust") return gazed::saliency::SaliencyProfile::robust;
  if (text == "surround") return gazed::saliency::SaliencyProfile::surround;
  throw std::invalid_argument("'" + std::string(text) +
                              "' found; wanted: report, robust, surround");
}

bool is_rgb(std::string_view text) {
  if (text != "rgb" && text != "yuyv")
    throw std::invalid_argument("'" + std::string(text) + "' found; wanted: rgb or yuyv");
  return text == "rgb";
}

void look(std::vector<std::string_view> arguments) {
  const bool flicker = std::erase(arguments, "--flicker") > 0;
  if (arguments.size() != 3 && arguments.size() != 5)
    throw std::invalid_argument(
        "usage: [--flicker] report|robust|surround rgb|yuyv FRAMES [WIDTH HEIGHT]");
  gazed::saliency::SaliencySettings settings;
  settings.profile = profile_of(arguments[0]);
  settings.flicker_weight = flicker ? 1.0 : 0.0;
  const bool rgb = is_rgb(arguments[1]);
  const int frames = positive(arguments[2]);
  const int width_px = arguments.size() == 5 ? positive(arguments[3]) : 640;
  const int height_px = arguments.size() == 5 ? positive(arguments[4]) : 480;

  const gazed::base::Image room = gazed::benchmarks::room_frame(width_px, height_px);
  const std::vector<std::uint8_t> yuyv = gazed::saliency::frames::yuyv_of(room.view());
  const gazed::base::ImageView frame =
      rgb ? room.view() : gazed::saliency::frames::yuyv_view(yuyv, width_px, height_px);
  gazed::saliency::Saliency stage(settings, width_px, height_px);
  gazed::saliency::SaliencyResult result;
  // Flicker costs the same whether anything has changed or not.
  for (int i = 0; i < frames; ++i) result = stage.examine(frame, {.head_is_still = flicker});
  std::printf("winner %.3f %.3f, hash %016" PRIx64 "\n", result.peak_px.x(), result.peak_px.y(),
              gazed::saliency::hash_of(result));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    look({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "saliency_frames: %s\n", error.what());
    return 2;
  }
  return 0;
}
