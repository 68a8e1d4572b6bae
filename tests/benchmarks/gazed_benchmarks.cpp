// gazed_benchmarks [--frame FILE.ppm] [options of Google Benchmark]: what gazed's stages cost,
// beside their peers. Saliency's times mean something as ratios to peer/pyrdown_8uc3 of the same
// run: see README.md and `ratios`, both in this folder.
#include <benchmark/benchmark.h>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/benchmarks/float_report.hpp"
#include "tests/benchmarks/locating.hpp"
#include "tests/benchmarks/ppm.hpp"
#include "tests/benchmarks/room_frame.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#ifdef GAZED_OPENCV_SALIENCY
#include <opencv2/saliency.hpp>
#endif

namespace gazed::benchmarks {
namespace {

/// One picture in the two formats of a camera, kept while benchmarks run.
struct Frames {
  cv::Mat rgb;
  std::vector<std::uint8_t> yuyv;  // empty when the width is odd

  explicit Frames(const base::ImageView& source)
      : rgb(cv::Mat(source.height_px, source.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(source.data),  // only read, and copied at once
                    static_cast<std::size_t>(source.row_stride))
                .clone()) {
    if (rgb.cols % 2 == 0) yuyv = saliency::frames::yuyv_of(source);
  }

  [[nodiscard]] base::ImageView view(base::PixelFormat format) const {
    if (format == base::PixelFormat::yuyv)
      return saliency::frames::yuyv_view(yuyv, rgb.cols, rgb.rows);
    return {rgb.data, rgb.cols, rgb.rows, static_cast<int>(rgb.step), base::PixelFormat::rgb24};
  }
};

std::string& append(std::string& text, const cv::Size& size) {
  return text.append(std::to_string(size.width)).append("x").append(std::to_string(size.height));
}

void look(benchmark::State& state, const Frames& frames, saliency::SaliencyProfile profile,
          base::PixelFormat format) {
  saliency::SaliencySettings settings;
  settings.profile = profile;
  saliency::Saliency stage(settings, frames.rgb.cols, frames.rgb.rows);
  const base::ImageView frame = frames.view(format);
  for (auto _ : state) benchmark::DoNotOptimize(stage.examine(frame));
  state.counters["pixels"] = static_cast<double>(frames.rgb.total());
}

void pyr_down(benchmark::State& state, const Frames& frames) {
  cv::Mat half;
  for (auto _ : state) {
    cv::pyrDown(frames.rgb, half);
    benchmark::DoNotOptimize(half.data);
    benchmark::ClobberMemory();
  }
  state.counters["pixels"] = static_cast<double>(frames.rgb.total());
}

void float_model(benchmark::State& state, const Frames& frames) {
  for (auto _ : state) benchmark::DoNotOptimize(float_report(frames.rgb));
}

#ifdef GAZED_OPENCV_SALIENCY
template <class Model>
void opencv_saliency(benchmark::State& state, const Frames& frames) {
  const auto model = Model::create();
  cv::Mat bgr, map;
  cv::cvtColor(frames.rgb, bgr, cv::COLOR_RGB2BGR);
  for (auto _ : state) {
    if (!model->computeSaliency(bgr, map)) state.SkipWithError("computeSaliency failed");
    benchmark::DoNotOptimize(map.data);
  }
}
#endif

/// What every frame size has: the stage in its three forms, and the yardstick.
void register_stage(const std::shared_ptr<const Frames>& frames, const std::string& suffix) {
  const auto add = [&](const std::string& name, saliency::SaliencyProfile profile,
                       base::PixelFormat format) {
    benchmark::RegisterBenchmark((name + suffix).c_str(), [=](benchmark::State& state) {
      look(state, *frames, profile, format);
    });
  };
  add("saliency/report/rgb", saliency::SaliencyProfile::report, base::PixelFormat::rgb24);
  add("saliency/robust/rgb", saliency::SaliencyProfile::robust, base::PixelFormat::rgb24);
  add("saliency/surround/rgb", saliency::SaliencyProfile::surround, base::PixelFormat::rgb24);
  if (!frames->yuyv.empty())
    add("saliency/robust/yuyv", saliency::SaliencyProfile::robust, base::PixelFormat::yuyv);
  benchmark::RegisterBenchmark(("peer/pyrdown_8uc3" + suffix).c_str(),
                               [=](benchmark::State& state) { pyr_down(state, *frames); });
}

void register_peers(const std::shared_ptr<const Frames>& frames) {
  benchmark::RegisterBenchmark("peer/float_report",
                               [=](benchmark::State& state) { float_model(state, *frames); });
#ifdef GAZED_OPENCV_SALIENCY
  benchmark::RegisterBenchmark("peer/spectral_residual", [=](benchmark::State& state) {
    opencv_saliency<cv::saliency::StaticSaliencySpectralResidual>(state, *frames);
  });
  benchmark::RegisterBenchmark("peer/fine_grained", [=](benchmark::State& state) {
    opencv_saliency<cv::saliency::StaticSaliencyFineGrained>(state, *frames);
  });
#endif
}

/// The same picture at other sizes: `given` resampled, else the room drawn anew.
void register_sizes(const cv::Mat& given) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(480, 360), cv::Size(800, 600),
                              cv::Size(960, 720), cv::Size(1280, 960), cv::Size(2560, 1920)}) {
    cv::Mat resampled;
    if (!given.empty()) cv::resize(given, resampled, size, 0, 0, cv::INTER_AREA);
    const auto frames = std::make_shared<const Frames>(
        given.empty()
            ? room_frame(size.width, size.height).view()
            : base::ImageView{resampled.data, size.width, size.height,
                              static_cast<int>(resampled.step), base::PixelFormat::rgb24});
    std::string suffix = "/";
    register_stage(frames, append(suffix, size));
  }
}

/// Takes `--frame FILE` or `--frame=FILE` out of the arguments.
std::optional<std::string> take_frame_option(std::vector<char*>& arguments) {
  constexpr std::string_view option = "--frame";
  for (auto it = arguments.begin() + 1; it != arguments.end(); ++it) {
    const std::string_view argument = *it;
    if (argument.starts_with(option) && argument.substr(option.size()).starts_with('=')) {
      std::string file(argument.substr(option.size() + 1));
      arguments.erase(it);
      return file;
    }
    if (argument == option) {
      if (it + 1 == arguments.end()) throw std::invalid_argument("--frame without a file");
      std::string file(*(it + 1));
      arguments.erase(it, it + 2);
      return file;
    }
  }
  return std::nullopt;
}

int run(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  const auto file = take_frame_option(arguments);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  cv::setNumThreads(1);
  const base::Image frame = file ? read_ppm(*file) : room_frame(640, 480);
  const auto frames = std::make_shared<const Frames>(frame.view());
  register_stage(frames, "");
  register_peers(frames);
  register_sizes(file ? frames->rgb : cv::Mat());
  for (const triangulation::methods::Method method :
       {triangulation::methods::Method::optimal, triangulation::methods::Method::lindstrom}) {
    const std::string name =
        std::string("triangulate/").append(gazed::triangulation::methods::name(method));
    benchmark::RegisterBenchmark(name.c_str(),
                                 [=](benchmark::State& state) { triangulate(state, method); });
  }
  benchmark::RegisterBenchmark("locate/two_views", locate_two_views);
  std::string shown = file.value_or("built-in").append(" ");
  benchmark::AddCustomContext("frame", append(shown, frames->rgb.size()));
  benchmark::AddCustomContext("opencv", CV_VERSION);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace gazed::benchmarks

int main(int argc, char** argv) {
  try {
    return gazed::benchmarks::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gazed_benchmarks: %s\n", error.what());
    return 2;
  }
}
