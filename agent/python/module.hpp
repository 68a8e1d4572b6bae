// The parts of the Python module gazed._native.
#pragma once

#include <Eigen/Core>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

namespace gazed::python {

/// Rig and Point: a camera in a head, and what it saw twice.
void add_rig(pybind11::module_& module);
/// saliency() and SaliencyResult.
void add_saliency(pybind11::module_& module);

}  // namespace gazed::python
