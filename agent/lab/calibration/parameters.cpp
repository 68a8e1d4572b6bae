#include "agent/lab/calibration/parameters.hpp"

namespace gazed::lab::calibration {

const std::array<ParameterName, parameter_count>& parameter_names() {
  static constexpr std::array<ParameterName, parameter_count> names{{
      {"camera.focal_px x", "px"},
      {"camera.focal_px y", "px"},
      {"camera.centre_px x", "px"},
      {"camera.centre_px y", "px"},
      {"camera.distortion k1", ""},
      {"camera.distortion k2", ""},
      {"camera.distortion p1", ""},
      {"camera.distortion p2", ""},
      {"camera.distortion k3", ""},
      {"camera.mount_offset_m x", "m"},
      {"camera.mount_offset_m y", "m"},
      {"camera.mount_offset_m z", "m"},
      {"camera.mount_rotation_rad roll", "rad"},
      {"camera.mount_rotation_rad pitch", "rad"},
      {"camera.mount_rotation_rad yaw", "rad"},
      {"head.zero_rad yaw", "rad"},
      {"head.zero_rad pitch", "rad"},
      {"encoder scale yaw", ""},
      {"encoder scale pitch", ""},
      {"axis offset x", "m"},
      {"axis offset y", "m"},
      {"axis offset z", "m"},
  }};
  return names;
}

Parameters parameters_of(const HeadModel& model) {
  Parameters p;
  p.segment<2>(focal_at) = model.camera.focal_px;
  p.segment<2>(centre_at) = model.camera.centre_px;
  p.segment<5>(distortion_at) =
      Eigen::Map<const Eigen::Matrix<double, 5, 1>>(model.camera.distortion.data());
  p.segment<3>(mount_offset_at) = model.head.mount_offset_m;
  p.segment<3>(mount_rotation_at) = model.head.mount_rotation_rad;
  p.segment<2>(zero_at) << model.head.zero.yaw_rad, model.head.zero.pitch_rad;
  p.segment<2>(encoder_scale_at) = model.encoder_scale;
  p.segment<3>(axis_offset_at) = model.axis_offset_m;
  return p;
}

HeadModel with_parameters(HeadModel model, const Parameters& p) {
  model.camera.focal_px = p.segment<2>(focal_at);
  model.camera.centre_px = p.segment<2>(centre_at);
  Eigen::Map<Eigen::Matrix<double, 5, 1>>(model.camera.distortion.data()) =
      p.segment<5>(distortion_at);
  model.head.mount_offset_m = p.segment<3>(mount_offset_at);
  model.head.mount_rotation_rad = p.segment<3>(mount_rotation_at);
  model.head.zero = {p[zero_at], p[zero_at + 1]};
  model.encoder_scale = p.segment<2>(encoder_scale_at);
  model.axis_offset_m = p.segment<3>(axis_offset_at);
  return model;
}

std::vector<int> Prior::free_indices() const {
  std::vector<int> indices;
  for (int i = 0; i < parameter_count; ++i) {
    if (sigma[i] > 0.0) indices.push_back(i);
  }
  return indices;
}

std::vector<int> Prior::held_indices() const {
  std::vector<int> indices;
  for (int i = 0; i < parameter_count; ++i) {
    if (!(sigma[i] > 0.0)) indices.push_back(i);
  }
  return indices;
}

}  // namespace gazed::lab::calibration
