#include "drivers/naoqi/motion.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "agent/base/text.hpp"
#include "agent/geometry/limits.hpp"

namespace gazed::naoqi {

namespace {

float towards_zero(double value) {
  const auto nearest = static_cast<float>(value);
  return std::abs(static_cast<double>(nearest)) > std::abs(value) ? std::nextafter(nearest, 0.0F)
                                                                  : nearest;
}

}  // namespace

void write_set_angles(QiWriter& arguments, geometry::HeadAngles target, double speed_fraction) {
  const float yaw_rad = towards_zero(target.yaw_rad);
  const geometry::AngleRange pitch =
      geometry::HeadLimits().pitch_range(static_cast<double>(yaw_rad));
  const double pitch_rad = std::clamp(target.pitch_rad, pitch.min_rad, pitch.max_rad);
  write_joints(arguments, {yaw_rad, towards_zero(pitch_rad)});
  arguments.f32(towards_zero(speed_fraction));
}

std::optional<geometry::AngleRange> limits_in(const QiResult& result) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const QiValue joint = result.value.element(0);
  const double min_rad = joint.element(0).number().value_or(nan);
  const double max_rad = joint.element(1).number().value_or(nan);
  if (!(min_rad < max_rad)) return std::nullopt;
  return geometry::AngleRange{min_rad, max_rad};
}

std::string model_in(const QiResult& result) {
  const QiValue names = result.value.element(0), values = result.value.element(1);
  constexpr std::size_t most = 64;  // settings
  for (std::size_t i = 0; i < most && names.element(i); ++i) {
    if (names.element(i).text() == "Model Type")
      return std::string(values.element(i).text().value_or(""));
  }
  return {};
}

bool may_be_nao(std::string_view model) {
  constexpr std::string_view nao = "nao";
  const auto same = [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); };
  return model.empty() ||
         (model.size() >= nao.size() && std::ranges::equal(nao, model.substr(0, nao.size()), same));
}

std::string trouble_of(MotionMethod method, const QiResult& result) {
  const std::string_view why = result.value ? "an answer of another form" : result.error;
  return "ALMotion." + std::string(motion_methods[method].name) + ": " + base::excerpt(why);
}

}  // namespace gazed::naoqi
