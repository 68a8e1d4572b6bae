// A message as it goes over the wire.
#pragma once

#include <cstdint>
#include <string>

#include "drivers/naoqi/message.hpp"

namespace gazed::naoqi {

[[nodiscard]] inline std::string header_bytes(const QiHeader& header) {
  return {reinterpret_cast<const char*>(&header), sizeof header};
}
[[nodiscard]] inline std::string message_bytes(QiHeader header, QiBytes payload) {
  header.payload_bytes = static_cast<std::uint32_t>(payload.size());
  return header_bytes(header).append(payload);
}

}  // namespace gazed::naoqi
