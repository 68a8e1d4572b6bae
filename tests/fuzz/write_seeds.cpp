// Writes what the fuzzers begin with: FOLDER/<fuzzer>/<seed>.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tests/lola_robot/encoding.hpp"

namespace {

std::filesystem::path folder;

void seed(const std::string& fuzzer, const std::string& name, const std::string& bytes) {
  std::filesystem::create_directories(folder / fuzzer);
  std::ofstream(folder / fuzzer / name, std::ios::binary) << bytes;
}

void lola_seeds() {
  lola_robot::Sensors standing;
  standing.stiffness.fill(0.8F);
  standing.temperature.fill(38.0F);
  std::mt19937_64 random(1);
  const std::string usual = lola_robot::state_packet(standing);
  const std::string shuffled = lola_robot::state_packet(standing, &random);
  seed("lola_state", "usual", usual);
  seed("lola_state", "shuffled", shuffled);
  // The first byte and then one every piece say how long it is (lola_stream_fuzz.cpp).
  std::string pieces;
  const std::string stream = usual + shuffled + usual;
  for (std::size_t at = 0; at < stream.size(); at += 200) pieces += '\xc8' + stream.substr(at, 200);
  seed("lola_stream", "pieces", pieces);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("Usage: write_seeds FOLDER\n", stderr);
    return 2;
  }
  folder = argv[1];
  lola_seeds();
}
