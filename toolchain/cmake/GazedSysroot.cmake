# What the robots' toolchain files share: libraries and headers come from a sysroot only, programs of the build from the host only.
# The sysroot is what toolchain/sysroot made, or one of your own: the environment's GAZED_SYSROOT, or -DGAZED_SYSROOT=/path where the
# environment has none. A compiler of your own with it: GAZED_CXX, or -DCMAKE_CXX_COMPILER=... (C++20).
if(NOT "$ENV{GAZED_SYSROOT}" STREQUAL "")
  set(GAZED_SYSROOT "$ENV{GAZED_SYSROOT}" CACHE PATH "root of the robot's libraries and headers" FORCE)
endif()
set(GAZED_SYSROOT "" CACHE PATH "root of the robot's libraries and headers")
if(NOT GAZED_SYSROOT)
  set(GAZED_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot/${GAZED_PRESET})
endif()
get_filename_component(GAZED_SYSROOT ${GAZED_SYSROOT} ABSOLUTE)
if(NOT IS_DIRECTORY ${GAZED_SYSROOT}/usr/include)
  message(FATAL_ERROR "no sysroot at ${GAZED_SYSROOT}: run toolchain/sysroot ${GAZED_PRESET}, or set GAZED_SYSROOT to your own")
endif()
# What was found in one sysroot is in the cache, and is not looked for in another.
if(DEFINED GAZED_SYSROOT_SEARCHED AND NOT GAZED_SYSROOT_SEARCHED STREQUAL GAZED_SYSROOT)
  message(FATAL_ERROR "${CMAKE_BINARY_DIR} was configured with the sysroot ${GAZED_SYSROOT_SEARCHED}, and now it is ${GAZED_SYSROOT}: "
                      "cmake --fresh --preset ${GAZED_PRESET}, or remove that folder")
endif()
set(GAZED_SYSROOT_SEARCHED ${GAZED_SYSROOT} CACHE INTERNAL "the sysroot of everything that the cache holds")
if(NOT DEFINED GAZED_CXX_ASKED)
  set(GAZED_CXX_ASKED "$ENV{GAZED_CXX}" CACHE INTERNAL "the environment's GAZED_CXX, when the compiler was chosen")
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES GAZED_SYSROOT)

set(CMAKE_SYSROOT ${GAZED_SYSROOT})
if(IS_DIRECTORY ${GAZED_SYSROOT}/usr/lib/${GAZED_SYSROOT_TRIPLET})
  set(CMAKE_LIBRARY_ARCHITECTURE ${GAZED_SYSROOT_TRIPLET})
endif()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# gazed_emulator(PROGRAM CPU): test programs run in QEMU's emulation of CPU, with the sysroot's loader and libraries.
function(gazed_emulator program cpu)
  find_program(GAZED_EMULATOR NAMES ${program} ${program}-static)
  mark_as_advanced(GAZED_EMULATOR)
  if(GAZED_EMULATOR)
    set(CMAKE_CROSSCOMPILING_EMULATOR ${GAZED_EMULATOR} -cpu ${cpu} -L ${GAZED_SYSROOT} PARENT_SCOPE)
  endif()
endfunction()
