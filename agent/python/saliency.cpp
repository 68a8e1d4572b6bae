#include "agent/saliency/saliency.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <pybind11/numpy.h>
#include <stdexcept>
#include <string>
#include <utility>

#include "agent/base/image.hpp"
#include "agent/base/text.hpp"
#include "agent/python/module.hpp"

namespace gazed::python {
namespace {

namespace py = pybind11;

struct Result {
  py::array_t<std::uint16_t> map;
  Eigen::Vector2d peak_px;
  float saliency = 0.0F;
  float distinctness = 0.0F;
  bool distinct = false;
};

std::string shape_text(const py::array& picture) {
  std::string text;
  for (py::ssize_t i = 0; i < picture.ndim(); ++i) {
    text += (i == 0 ? "" : " x ") + std::to_string(picture.shape(i));
  }
  return text + " of " + std::string(py::str(picture.dtype()));
}

/// Throws std::invalid_argument, in Python ValueError, for what is no picture.
py::array_t<std::uint8_t> pixels_of(const py::array& picture) {
  const bool is_grey = picture.ndim() == 2;
  const bool is_rgb = picture.ndim() == 3 && picture.shape(2) == 3;
  if (!(is_grey || is_rgb) || !picture.dtype().is(py::dtype::of<std::uint8_t>())) {
    throw std::invalid_argument("picture: " + shape_text(picture) +
                                " found; allowed: height x width x 3 (r, g, b) or height x width "
                                "(grey), of uint8");
  }
  return py::array_t<std::uint8_t, py::array::c_style>::ensure(picture);
}

saliency::SaliencySettings settings_of(const std::string& profile) {
  const auto chosen = saliency::profile_of(profile);
  if (!chosen) {
    throw std::invalid_argument("profile: '" + profile +
                                "' found; allowed: " + base::listed(saliency::profile_names));
  }
  saliency::SaliencySettings settings;
  settings.profile = *chosen;
  return settings;
}

Result examine(const py::array& picture, const std::string& profile) {
  const py::array_t<std::uint8_t> pixels = pixels_of(picture);
  const saliency::SaliencySettings settings = settings_of(profile);
  base::ImageView view;
  view.data = pixels.data();
  view.width_px = static_cast<int>(pixels.shape(1));
  view.height_px = static_cast<int>(pixels.shape(0));
  view.format = pixels.ndim() == 2 ? base::PixelFormat::grey : base::PixelFormat::rgb24;
  view.row_stride = view.width_px * base::bytes_per_pixel(view.format);
  saliency::Saliency stage(settings, view.width_px, view.height_px);
  const saliency::SaliencyResult found = stage.examine(view);
  py::array_t<std::uint16_t> map({found.map.height, found.map.width});
  std::ranges::copy(found.map.samples, map.mutable_data());
  return {std::move(map), found.peak_px, found.saliency, found.distinctness,
          found.distinctness >= static_cast<float>(settings.distinctness_min)};
}

}  // namespace

void add_saliency(py::module_& module) {
  py::class_<Result>(module, "SaliencyResult", "What stands out in a picture.")
      .def_readonly("map", &Result::map,
                    "uint16, Q8 (65280 is full scale); sample (row, column) is centred on pixel 16 "
                    "(column, row)")
      .def_readonly("peak_px", &Result::peak_px, "the winner, (x, y), pixels")
      .def_readonly("saliency", &Result::saliency, "of the peak, 0 to 1")
      .def_readonly("distinctness", &Result::distinctness, "how far the winner stands out, 0 to 1")
      .def_readonly("distinct", &Result::distinct, "whether gazed would look at it");
  module.def("saliency", &examine, py::arg("picture"), py::arg("profile") = "surround",
             "The most salient place of a picture: uint8, height x width x 3 (r, g, b) or height x "
             "width (grey), 160x120 to 2560x1920. profile: surround, robust or report. Raises "
             "ValueError with what was found and what is allowed.");
}

}  // namespace gazed::python
