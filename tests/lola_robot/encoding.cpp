#include "tests/lola_robot/encoding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace lola_robot {

namespace {

void append_number(std::string& bytes, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  bytes += '\xca';
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

std::string text(std::string_view value) {
  return std::string(1, static_cast<char>(0xa0 + value.size())).append(value);
}

std::string array_head(std::size_t count) {
  if (count < 16) return {static_cast<char>(0x90 + count)};
  return {'\xdc', '\0', static_cast<char>(count)};
}

template <class Values>
std::string numbers(std::string_view key, const Values& values) {
  std::string bytes = text(key) + array_head(values.size());
  for (const float value : values) append_number(bytes, value);
  return bytes;
}

std::vector<std::string> entries(const Sensors& sensors) {
  std::string status = text("Status") + array_head(joints);
  for (const unsigned value : sensors.status) status += static_cast<char>(value);
  const std::string config = text("RobotConfig") + array_head(4) + text("P0000000000000000001") +
                             text("6.0.0") + text("P0000000000000000002") + text("6.0.0");
  constexpr float gravity = 9.81F;
  return {numbers("Stiffness", sensors.stiffness),
          numbers("Position", sensors.position),
          numbers("Temperature", sensors.temperature),
          numbers("Current", sensors.current),
          numbers("Battery", std::array<float, 4>{0.9F, 0.0F, -0.3F, 31.0F}),
          numbers("Accelerometer", std::array<float, 3>{0.0F, 0.0F, -gravity}),
          numbers("Gyroscope", std::array<float, 3>{}),
          numbers("Angles", sensors.torso),
          numbers("Sonar", std::array<float, 2>{0.3F, 0.3F}),
          numbers("FSR", std::array<float, 8>{}),
          status,
          numbers("Touch", std::array<float, 14>{}),
          config};
}

/// Reads what must come next.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  bool takes(std::string_view expected) {
    if (!rest_.starts_with(expected)) return false;
    rest_.remove_prefix(expected.size());
    return true;
  }
  bool takes(Joints& values) {
    if (!takes(std::string_view("\xdc\0\x19", 3))) return false;
    for (float& value : values) {
      if (!takes("\xca") || rest_.size() < 4) return false;
      std::uint32_t bits = 0;
      for (int i = 0; i < 4; ++i) bits = bits << 8 | static_cast<unsigned char>(rest_[i]);
      std::memcpy(&value, &bits, sizeof value);
      rest_.remove_prefix(4);
    }
    return true;
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

bool finite(const Joints& values) {
  return std::all_of(values.begin(), values.end(),
                     [](float value) { return std::isfinite(value); });
}

}  // namespace

std::string state_packet(const Sensors& sensors, std::mt19937_64* shuffle) {
  std::vector<std::string> all = entries(sensors);
  for (std::size_t i = all.size(); shuffle != nullptr && i > 1; --i)
    std::swap(all[i - 1], all[(*shuffle)() % i]);
  std::string packet(1, static_cast<char>(0x80 + all.size()));
  for (const std::string& entry : all) packet += entry;
  return packet;
}

std::variant<Order, std::string> read_order(std::string_view packet) {
  Reader reader(packet);
  Order order;
  if (!reader.takes("\x82")) return "no map of two";
  if (!reader.takes("\xa8Position") || !reader.takes(order.position))
    return "no Position of 25 floats";
  if (!reader.takes("\xa9Stiffness") || !reader.takes(order.stiffness))
    return "no Stiffness of 25 floats";
  if (!reader.at_end()) return "bytes after the map";
  if (!finite(order.position) || !finite(order.stiffness)) return "a number that is not finite";
  return order;
}

}  // namespace lola_robot
