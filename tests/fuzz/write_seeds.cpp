// Writes what the fuzzers begin with: FOLDER/<fuzzer>/<seed>.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>

#include "agent/settings/settings.hpp"
#include "drivers/jpeg/encoder.hpp"
#include "drivers/lcm/conversions.hpp"
#include "drivers/log/event.hpp"
#include "drivers/naoqi/message.hpp"
#include "drivers/sim/scene.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/head_state_t.hpp"

#include "tests/lola_robot/encoding.hpp"
#include "tests/unit/drivers/naoqi/message_bytes.hpp"

namespace {

std::filesystem::path folder;

void seed(const std::string& fuzzer, const std::string& name, const std::string& bytes) {
  std::filesystem::create_directories(folder / fuzzer);
  std::ofstream(folder / fuzzer / name, std::ios::binary) << bytes;
}

template <class Message>
std::string bytes_of(const Message& message) {
  std::string bytes(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

std::string log_event(const std::string& channel, const std::string& message) {
  const auto header =
      gazed::log::encode({.number = 0,
                          .time_us = 1'700'000'000'000'000,
                          .channel_bytes = static_cast<std::int32_t>(channel.size()),
                          .message_bytes = static_cast<std::int32_t>(message.size())});
  return std::string(header.begin(), header.end()) + channel + message;
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

/// An image of 32x16 grey pixels.
std::string image_bytes() {
  bot_core::image_t image{};
  image.utime = 1'700'000'000'000'000;
  image.width = 32;
  image.height = 16;
  image.row_stride = 32;
  image.pixelformat = bot_core::image_t::PIXEL_FORMAT_GREY;
  image.size = 32 * 16;
  image.data.resize(32 * 16);
  return bytes_of(image);
}

/// 32x16 pixels of a few colours, in RGB and in grey, and as a camera's message.
void jpeg_seeds() {
  using gazed::base::PixelFormat;
  for (const auto& [name, format] :
       {std::pair{"rgb", PixelFormat::rgb24}, {"grey", PixelFormat::grey}}) {
    gazed::base::Image picture(32, 16, format);
    int value = 0;
    for (std::uint8_t& byte : picture.pixels()) byte = static_cast<std::uint8_t>(value += 3);
    gazed::jpeg::Encoder encoder(50);
    const auto file = encoder.encode(picture.view());
    seed("jpeg", name, std::string(file.begin(), file.end()));
    bot_core::image_t message{};
    gazed::lcm::to_message({picture.view(), 1'700'000'000'000'000}, file, message);
    seed("lcm_messages", std::string("jpeg_") + name, bytes_of(message));
  }
}

void lcm_seeds() {
  gazed::head_state_t state{};
  state.utime = 1'700'000'000'000'000;
  seed("lcm_messages", "image", image_bytes());
  seed("lcm_messages", "head_state", bytes_of(state));

  // Short datagrams and one in two fragments; before each its length and sender
  // (lcm_datagrams_fuzz.cpp).
  const std::string small("LC02\0\0\0\1IMAGE\0data", 18);
  const std::string first("LC03\0\0\0\2\0\0\0\10\0\0\0\0\0\0\0\2IMAGE\0half", 30);
  const std::string second("LC03\0\0\0\2\0\0\0\10\0\0\0\4\0\1\0\2half", 24);
  std::string datagrams;
  for (const std::string& one : {small, first, second})
    datagrams += static_cast<char>(one.size()) + std::string(1, '\0') + one;
  seed("lcm_datagrams", "message", datagrams);

  seed("log", "two_frames", log_event("IMAGE", image_bytes()) + log_event("IMAGE", image_bytes()));
  seed("log", "configuration", log_event("GAZED_CONFIGURATION", "robot = \"nao-v6\"\n"));
}

void text_seeds() {
  const std::string configuration =
      gazed::settings::to_toml(gazed::settings::default_settings("nao-v6"));
  const std::string scene(gazed::sim::default_scene_toml());
  for (const auto& [name, text] : {std::pair{"configuration", configuration}, {"scene", scene}})
    seed("toml", name, text.substr(0, 2000));
  for (std::size_t at = 0; at < configuration.size(); at += 1500)
    seed("configuration", "part" + std::to_string(at), configuration.substr(at, 1500));
  seed("configuration", "log", "[camera]\nsource = \"lcm\"\nwidth_px = 320\nheight_px = 240\n");
  seed("scene", "default", scene);
  seed("scene", "things",
       "[room]\nlamp_m = [0, 1, 2]\n[[plane]]\ncentre_m = [1, 0, 0]\nsize_m = [1, 1]\n"
       "[[target_test]]\npixel = [320, 240]\nrange_m = 1.0\n[sway]\nrotation_rad = 0.01\n");
  seed("scene", "picture", "P6 2 1 255\n" + std::string(6, 'x'));
  seed("options", "run", "--fixations\n2\n--set\nlocate.looks=8\n--camera\nlcm\n--head\nlcm");
  seed("options", "flags", "--check\n--print-config\n--seed=7\n--profile\nreport\n--robot=nao-v4");
}

/// The first byte chooses the reader (tables_fuzz.cpp).
void table_seeds() {
  const std::string matrix = "[[600, 0, 320], [0, 600, 240], [0, 0, 1]]\n";
  seed("tables", "pair",
       std::string(1, '\0') + "K1 = " + matrix + "K2 = " + matrix +
           "R = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nt = [0.1, 0, 0]\npixel_sigma_px = 0.5\n");
  seed("tables", "correspondences", "\1id,x1,y1,x2,y2\na,1,2,3,4\nb,nan,2,+3,4e1\n");
  seed("tables", "frames", "\2utime_us,file,yaw_rad,pitch_rad\n1700000000000000,a.jpg,0.1,0\n");
  seed("tables", "marks", "\3utime_us,yaw_rad,pitch_rad,x_px,y_px,x_m,y_m,z_m\n1,0,0,2,3,1,0,0\n");
  seed("tables", "jpeg",
       std::string("\4\xff\xd8\xff\xe0\0\4ab\xff\xda\0\4cd12\xff\0"
                   "34\xff\xd9",
                   23));
  seed("tables", "png", std::string("\4\x89PNG\r\n\x1a\n\0\0\0\0IEND\xae\x42\x60\x82", 21));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("Usage: write_seeds FOLDER\n", stderr);
    return 2;
  }
  folder = argv[1];
  jpeg_seeds();
  lcm_seeds();
  lola_seeds();
  naoqi_seeds();
  text_seeds();
  table_seeds();
}
