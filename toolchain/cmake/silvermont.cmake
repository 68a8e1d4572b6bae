# The CPU of NAO V6: Atom E3845 (Silvermont), 64-bit programs, SSE4.2, no AVX. What compiles for it, and how.
# A toolchain file for programs that need no library of the robot's; nao-v6.cmake adds those.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
if(NOT CMAKE_CXX_COMPILER)
  # gcc 12, as in the sysroot's release, whatever this machine's own is.
  find_program(GAZED_GCC NAMES x86_64-linux-gnu-g++-12 x86_64-linux-gnu-g++ NO_CACHE)
  set(CMAKE_CXX_COMPILER ${GAZED_GCC})
  if(NOT "$ENV{GAZED_CXX}" STREQUAL "")
    set(CMAKE_CXX_COMPILER $ENV{GAZED_CXX})
  endif()
endif()
set(CMAKE_CXX_FLAGS_INIT "-march=silvermont")
