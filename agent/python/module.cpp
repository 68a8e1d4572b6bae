#include "agent/python/module.hpp"

#include <pybind11/stl.h>
#include <string>

#include "agent/geometry/robot.hpp"
#include "agent/saliency/settings.hpp"
#include "agent/triangulation/methods/method.hpp"

PYBIND11_MODULE(_native, module) {
  module.doc() = "The compiled part of gazed.";
  module.attr("__version__") = GAZED_VERSION;
  const auto tuple_of = [](const auto& names) {
    pybind11::list list;
    for (const auto& name : names) list.append(std::string(name));
    return pybind11::tuple(list);
  };
  module.attr("robots") = tuple_of(gazed::geometry::robot_names);
  module.attr("profiles") = tuple_of(gazed::saliency::profile_names);
  module.attr("methods") = tuple_of(gazed::triangulation::methods::method_names());
  gazed::python::add_rig(module);
  gazed::python::add_saliency(module);
}
