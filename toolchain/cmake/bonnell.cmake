# The CPU of NAO V3.3 to V5: Atom Z530 (Bonnell), 32-bit programs, SSSE3 and nothing newer. What compiles for it, and how.
# A toolchain file for programs that need no library of the robot's; nao-v4.cmake adds those.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
if(NOT CMAKE_CXX_COMPILER)
  # gcc 12, as in the sysroot's release, whatever this machine's own is.
  find_program(GAZED_GCC NAMES i686-linux-gnu-g++-12 i686-linux-gnu-g++ NO_CACHE)
  set(CMAKE_CXX_COMPILER ${GAZED_GCC})
  if(NOT "$ENV{GAZED_CXX}" STREQUAL "")
    set(CMAKE_CXX_COMPILER $ENV{GAZED_CXX})
  endif()
endif()
set(CMAKE_CXX_FLAGS_INIT "-march=bonnell")  # doubles in SSE registers: GazedTargets.cmake, for every 32-bit build
