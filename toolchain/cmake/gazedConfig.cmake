# find_package(gazed) gives gazed::saliency, gazed::geometry and gazed::triangulation: static libraries, C++20, whose headers are included as
# here, "agent/saliency/saliency.hpp".
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
include(${CMAKE_CURRENT_LIST_DIR}/gazedTargets.cmake)
