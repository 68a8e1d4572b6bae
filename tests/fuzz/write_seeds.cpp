// Writes what the fuzzers begin with: FOLDER/<fuzzer>/<seed>.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "drivers/naoqi/message.hpp"

#include "tests/lola_robot/encoding.hpp"
#include "tests/unit/drivers/naoqi/message_bytes.hpp"

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

/// An answer to the question of that number in naoqi_answer_fuzz.cpp.
void naoqi_answer(char question, const std::string& name, const gazed::naoqi::QiWriter& answer) {
  seed("naoqi_answer", name, question + std::string(answer.bytes()));
}

gazed::naoqi::QiWriter naoqi_image() {
  gazed::naoqi::QiWriter image;  // of 4x2 pixels
  image.text("[m]").u32(12);
  for (const std::uint32_t number : {4U, 2U, 2U, 9U, 1'700'000'000U, 5U})
    image.text("i").u32(number);
  image.text("r").text("sixteen bytes...");
  for (int i = 0; i < 5; ++i) image.dynamic(0.5F);
  return image;
}

void naoqi_seeds() {
  naoqi_answer(0, "image", naoqi_image());
  gazed::naoqi::QiWriter angles, capabilities, place, methods, tuple;
  naoqi_answer(1, "angles", angles.u32(2).f32(0.5F).f32(-0.25F));
  capabilities.u32(2).text("ClientServerSocket").text("b").integer(1, 1);
  naoqi_answer(2, "authenticated", capabilities.text("__qi_auth_state").text("I").u32(3));
  place.text("ALMotion").u32(7).text("machine").u32(1).u32(2).text("qi:here");
  naoqi_answer(3, "place", place.text("tcp://127.0.0.1:9559").text("session"));
  methods.u32(1).u32(100).u32(100).text("[f]").text("getAngles").text("(mb)").text("");
  naoqi_answer(4, "methods", methods.u32(1).text("names").text("").text(""));
  tuple.text("({sm}[(if)<A,b,c>]l)").u32(1).text("key").dynamic(0.5F);
  naoqi_answer(5, "tuple", tuple.u32(1).u32(5).f32(0.5F).integer(9, 8));

  const std::string message = gazed::naoqi::message_bytes({}, angles.bytes());
  const std::string stream = message + message;
  std::string pieces;
  for (std::size_t at = 0; at < stream.size(); at += 10) pieces += '\x0a' + stream.substr(at, 10);
  seed("naoqi_stream", "pieces", pieces);
  // 63 bytes that come 512 times (naoqi_stream_fuzz.cpp), and so 4 times: more than a connection
  // makes room for at once.
  std::string image = char(sizeof(gazed::naoqi::QiHeader)) +
                      gazed::naoqi::header_bytes({.payload_bytes = 4 * 512 * 63});
  for (int i = 0; i < 4; ++i) image += '\xff' + std::string(63, 'x');
  seed("naoqi_stream", "image", image);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("Usage: write_seeds FOLDER\n", stderr);
    return 2;
  }
  folder = argv[1];
  lola_seeds();
  naoqi_seeds();
}
