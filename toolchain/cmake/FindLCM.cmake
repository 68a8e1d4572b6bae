# Finds LCM as Debian 12 packages it: 1.3.1, without a CMake configuration, and with a pkg-config file that
# asks for GLib's headers though LCM's own do not. Targets: LCM::lcm (the library), LCM::gen (the program lcm-gen).
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
find_program(LCM_GEN_EXECUTABLE lcm-gen)  # runs on the build machine, so never from a sysroot
if(LCM_GEN_EXECUTABLE)
  execute_process(COMMAND ${LCM_GEN_EXECUTABLE} --version OUTPUT_VARIABLE _lcm_gen_version
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" LCM_VERSION "${_lcm_gen_version}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR LCM_GEN_EXECUTABLE
                                  VERSION_VAR LCM_VERSION)
if(LCM_FOUND AND NOT TARGET LCM::lcm)
  add_library(LCM::lcm UNKNOWN IMPORTED)
  set_target_properties(LCM::lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
  add_executable(LCM::gen IMPORTED)
  set_target_properties(LCM::gen PROPERTIES IMPORTED_LOCATION ${LCM_GEN_EXECUTABLE})
endif()
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY LCM_GEN_EXECUTABLE)
