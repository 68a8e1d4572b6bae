// to_ppm PICTURE OUT.ppm: a photograph as the simulator's textures are read, P6.
#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>

int main(int argc, char** argv) {
  try {
    const cv::Mat picture = argc == 3 ? cv::imread(argv[1], cv::IMREAD_COLOR) : cv::Mat();
    if (!picture.empty() && cv::imwrite(argv[2], picture)) return 0;
    std::fprintf(stderr, "to_ppm PICTURE OUT.ppm\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "to_ppm: %s\n", error.what());
  }
  return 2;
}
