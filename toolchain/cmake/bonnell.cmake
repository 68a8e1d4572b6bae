# The CPU of NAO V3.3 to V5: Atom Z530 (Bonnell), 32-bit programs, SSSE3 and nothing newer. What compiles for it, and how.
# A toolchain file for programs that need no library of the robot's; nao-v4.cmake adds those.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
if(NOT CMAKE_CXX_COMPILER)
  set(CMAKE_CXX_COMPILER i686-linux-gnu-g++)
  if(NOT "$ENV{GAZED_CXX}" STREQUAL "")
    set(CMAKE_CXX_COMPILER $ENV{GAZED_CXX})
  endif()
endif()
set(CMAKE_CXX_FLAGS_INIT "-march=bonnell")  # doubles in SSE registers: GazedTargets.cmake, for every 32-bit build
