#include "agent/cycle/fixation.hpp"

#include <array>

namespace gazed::cycle {

std::string_view name(Status status) {
  constexpr std::array<std::string_view, status_count> names{
      "LOCATED",       "NO_SALIENT_OBJECT", "TARGET_LOST", "DEGENERATE",
      "BEHIND_CAMERA", "UNCERTAIN",         "HEAD_FAULT",  "CAMERA_FAULT"};
  return names[static_cast<std::size_t>(status)];
}

Status status_of(triangulation::Status status) {
  switch (status) {
    case triangulation::Status::located:
      return Status::located;
    case triangulation::Status::degenerate:
      return Status::degenerate;
    case triangulation::Status::behind_camera:
      return Status::behind_camera;
    case triangulation::Status::uncertain:
      return Status::uncertain;
    case triangulation::Status::target_lost:
    case triangulation::Status::invalid_input:
      break;
  }
  return Status::target_lost;
}

}  // namespace gazed::cycle
