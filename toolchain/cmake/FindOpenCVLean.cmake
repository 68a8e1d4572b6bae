# Finds single OpenCV components. Debian ships OpenCVConfig.cmake only in libopencv-dev, which pulls in
# 687 MB; the components' own packages hold the headers and libraries that are needed here.
# find_package(OpenCVLean REQUIRED COMPONENTS core imgproc) gives the targets opencv::core, opencv::imgproc.
find_path(OpenCVLean_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(_opencv_required OpenCVLean_INCLUDE_DIR)
foreach(component IN LISTS OpenCVLean_FIND_COMPONENTS)
  find_library(OpenCVLean_${component}_LIBRARY opencv_${component})
  list(APPEND _opencv_required OpenCVLean_${component}_LIBRARY)
  mark_as_advanced(OpenCVLean_${component}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVLean REQUIRED_VARS ${_opencv_required})
if(OpenCVLean_FOUND)
  foreach(component IN LISTS OpenCVLean_FIND_COMPONENTS)
    if(NOT TARGET opencv::${component})
      add_library(opencv::${component} UNKNOWN IMPORTED)
      set_target_properties(opencv::${component} PROPERTIES
        IMPORTED_LOCATION ${OpenCVLean_${component}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenCVLean_INCLUDE_DIR})
    endif()
  endforeach()
endif()
mark_as_advanced(OpenCVLean_INCLUDE_DIR)
