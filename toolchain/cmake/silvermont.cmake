# The CPU of NAO V6: Atom E3845 (Silvermont), 64-bit programs, SSE4.2, no AVX. What compiles for it, and how.
# A toolchain file for programs that need no library of the robot's; nao-v6.cmake adds those.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
if(NOT CMAKE_CXX_COMPILER)
  set(CMAKE_CXX_COMPILER x86_64-linux-gnu-g++)
  if(NOT "$ENV{GAZED_CXX}" STREQUAL "")
    set(CMAKE_CXX_COMPILER $ENV{GAZED_CXX})
  endif()
endif()
set(CMAKE_CXX_FLAGS_INIT "-march=silvermont")
