// What the official client and server (libqi 4.0.3) were seen to send to each other.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace gazed::naoqi {

/// getAngles(["HeadYaw", "HeadPitch"], true), and the payload of the answer: 0.5 and -0.25 rad.
inline constexpr std::string_view golden_get_angles_call =
    "42dead42 0a000000 2e000000 0000 01 00 02000000 01000000 64000000"
    "03000000 5b6d5d 02000000 01000000 73 07000000 48656164596177"
    "01000000 73 09000000 486561645069746368 01";
inline constexpr std::string_view golden_get_angles_answer = "02000000 0000003f 000080be";

[[nodiscard]] inline std::string from_hex(std::string_view text) {
  std::string digits;
  for (const char c : text)
    if (c != ' ') digits += c;
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    std::uint8_t byte = 0;
    std::from_chars(&digits[i], &digits[i] + 2, byte, 16);
    bytes.push_back(static_cast<char>(byte));
  }
  return bytes;
}

}  // namespace gazed::naoqi
