# How every target of this project is built: language, warnings, sanitizers, output folder.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(CMAKE_SIZEOF_VOID_P EQUAL 4)
  # Doubles belong in SSE registers: the old floating-point unit keeps more bits in some places than in others.
  add_compile_options(-msse2 -mfpmath=sse)
endif()
# What goes onto a robot is hardened: a mistake is to be an end, and not a way in. -fcf-protection is NOPs on the robots' CPUs. 32-bit x86 has
# no addresses relative to the program counter: position independence takes one of seven registers, and a call to fill it. All of it costs
# 0.1 to 0.2 M instructions a look there (tests/benchmarks/README.md).
option(GAZED_HARDENED "stack protector, FORTIFY 3, CET, all symbols bound at the start, position independent" ${CMAKE_CROSSCOMPILING})
if(GAZED_HARDENED)
  add_compile_options(-fPIE -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -fcf-protection=full -ffunction-sections -fdata-sections)
  add_link_options(-pie -Wl,-z,relro,-z,now -Wl,--gc-sections)
elseif(CMAKE_SIZEOF_VOID_P EQUAL 4)
  add_compile_options(-fno-pie)
  add_link_options(-no-pie)
else()
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
# Named one by one: all would be others in each release of Java, and lcm-gen's sources do not meet all of them.
set(CMAKE_JAVA_COMPILE_FLAGS -encoding UTF-8 -Xlint:divzero,empty,fallthrough,finally,overrides,rawtypes,static,try,unchecked,varargs -Werror)
# gcc collects its garbage from 128 MB on, again and again where a source takes 1.5 GB: 5 to 15 % of the time of such a source.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)

option(GAZED_SIMD "build the saliency kernels with SSSE3 where the target is x86; off: plain C++, the same bits" ON)
# All are compiled for it, the saliency or not, so that all can share their headers.
set(GAZED_SIMD_OPTIONS)
if(GAZED_SIMD AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|i[3-6]86")
  set(GAZED_SIMD_OPTIONS -mssse3)
endif()

add_library(gazed_options INTERFACE)
target_include_directories(gazed_options INTERFACE ${PROJECT_SOURCE_DIR})
# Eigen's matrices of fixed room live on the stack: the unknowns of sixteen looks, 176, need 248 kB.
add_compile_definitions(EIGEN_STACK_ALLOCATION_LIMIT=262144)

# -ffp-contract=off: a fused multiply-add on one CPU and not on another would change the last bits.
target_compile_options(gazed_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
  -Wfloat-conversion -Werror -ffp-contract=off
  $<$<CXX_COMPILER_ID:Clang>:-Wno-invalid-constexpr>)  # clang 16 does not evaluate elements of vectors at compile time, as gcc does
# Joined sources take half the time, but no file proves that it includes what it needs, and a change of one compiles them all. OFF is for who
# works on one library, keeps the warnings below, and is tried by the preset debug.
option(GAZED_JOINED "compile each library's sources as one" ON)
option(GAZED_JOINED_TESTS "compile each test program's sources as one, and the headers that all tests need once")
option(GAZED_THIRD_PARTY_ONCE "compile the headers of libraries that all sources need once (clang)")
option(GAZED_TEST_SHARE "run an eighth of each test program, for what would take minutes without an optimiser")
# What gcc 12 says about std::string once it sees more at a time (its bugs 105651 and 105562); sources compiled one by one keep these warnings.
set(mistaken_warnings)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(mistaken_warnings -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-maybe-uninitialized)
else()
  set(mistaken_warnings -Wno-shadow)  # clang's counts the other sources' constants
endif()
if(GAZED_JOINED)
  target_compile_options(gazed_options INTERFACE ${mistaken_warnings})
endif()
if(GAZED_THIRD_PARTY_ONCE)
  # Precompiled headers are for one instruction set. Nothing of this project is among them, and that a file includes those that it needs
  # is told by their names (toolchain/check).
  target_compile_options(gazed_options INTERFACE ${GAZED_SIMD_OPTIONS})
endif()
if(GAZED_SANITIZE)
  target_compile_options(gazed_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(gazed_options INTERFACE -fsanitize=address,undefined)
endif()

if(GAZED_FUZZ)
  target_compile_options(gazed_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -Wno-error)
endif()

set(standard_headers <algorithm> <array> <cmath> <functional> <memory> <optional> <random> <span> <string> <variant> <vector>)

# gazed_library_headers(): from here on, libraries read the headers that most of them need ready compiled. After find_package(Eigen3).
function(gazed_library_headers)
  if(NOT GAZED_JOINED AND NOT GAZED_THIRD_PARTY_ONCE)
    return()
  endif()
  file(CONFIGURE OUTPUT library_headers.cpp CONTENT "// Its headers are all there is.\n")
  add_library(gazed_headers STATIC ${CMAKE_CURRENT_BINARY_DIR}/library_headers.cpp)
  target_link_libraries(gazed_headers PRIVATE gazed_options Eigen3::Eigen)
  target_compile_options(gazed_headers PRIVATE ${GAZED_SIMD_OPTIONS})
  target_precompile_headers(gazed_headers PRIVATE <Eigen/Core> <Eigen/Geometry> ${standard_headers})
endfunction()

# gazed_library(NAME SOURCES a.cpp ... LINK target ...): one folder, one library `gazed_NAME`, which others link as gazed::NAME. PLAIN: without
# SSSE3. COLD: hardly optimised, because compiling it takes longer than running it: it parses arguments and files, and computes nothing.
function(gazed_library name)
  cmake_parse_arguments(ARG "PLAIN;COLD" "" "SOURCES;LINK" ${ARGN})
  add_library(gazed_${name} STATIC ${ARG_SOURCES})
  add_library(gazed::${name} ALIAS gazed_${name})
  set_target_properties(gazed_${name} PROPERTIES UNITY_BUILD ${GAZED_JOINED} EXPORT_NAME ${name})
  target_link_libraries(gazed_${name} PUBLIC $<BUILD_INTERFACE:gazed_options> ${ARG_LINK})
  if(ARG_PLAIN)
    return()
  endif()
  target_compile_options(gazed_${name} PRIVATE ${GAZED_SIMD_OPTIONS})
  if(ARG_COLD)
    target_compile_options(gazed_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  elseif(TARGET gazed_headers)
    target_precompile_headers(gazed_${name} REUSE_FROM gazed_headers)
  endif()
endfunction()

# Where a trial takes 10 to 60 times as long, instrumented or on an emulated CPU, tests do fewer of them: tests/unit/trials.hpp, or
# $<IF:$<BOOL:${GAZED_FEW_TRIALS}>,few,many> in a CMakeLists.txt.
set(GAZED_FEW_TRIALS OFF)
if(GAZED_SANITIZE OR CMAKE_CROSSCOMPILING OR GAZED_TEST_SHARE)
  set(GAZED_FEW_TRIALS ON)
endif()

# What all tests are compiled with.
add_library(gazed_test_options INTERFACE)
target_link_libraries(gazed_test_options INTERFACE gazed_options)
target_compile_definitions(gazed_test_options INTERFACE GAZED_FEW_TRIALS=$<BOOL:${GAZED_FEW_TRIALS}>)
# Not optimised, since compiling them takes longer than running them; on an emulated CPU it does not.
set(GAZED_TEST_LEVEL -O0)
if(CMAKE_CROSSCOMPILING)
  set(GAZED_TEST_LEVEL -O1)
endif()
if(GAZED_JOINED_TESTS)
  target_compile_options(gazed_test_options INTERFACE ${mistaken_warnings} ${GAZED_SIMD_OPTIONS})
endif()

# gazed_compile_as_test(TARGET OPTIMISED): compiles it at the tests' level, or at -O1 where OPTIMISED is true, with the tests' precompiled
# headers and all its sources as one.
function(gazed_compile_as_test target optimised)
  target_link_libraries(${target} PRIVATE gazed_test_options GTest::gmock)
  target_compile_definitions(${target} PRIVATE
    GAZED_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data" GAZED_SHARED="${PROJECT_SOURCE_DIR}/../shared")
  set(level ${GAZED_TEST_LEVEL})
  if(optimised AND NOT GAZED_TEST_SHARE)
    set(level -O1)
  endif()
  target_compile_options(${target} PRIVATE ${level})
  if(TARGET gazed_test_headers AND level STREQUAL GAZED_TEST_LEVEL)
    target_precompile_headers(${target} REUSE_FROM gazed_test_headers)
  endif()
  if(GAZED_JOINED_TESTS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
endfunction()

# gazed_test_library(NAME [OPTIMISED] SOURCES a.cpp ... LINK target ...): what several tests, or benchmarks, have in common.
function(gazed_test_library name)
  cmake_parse_arguments(ARG "OPTIMISED" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ${ARG_LINK})
  gazed_compile_as_test(${name} "${ARG_OPTIMISED}")
  if(CMAKE_POSITION_INDEPENDENT_CODE)
    # Precompiled headers are for one kind of code: that of programs.
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${name} PRIVATE -fPIE)
  endif()
endfunction()

# gazed_test(NAME SOURCES a_test.cpp ... LINK target ...): the test program NAME_test, its cases known to ctest. Where a program takes as long to
# start as most cases to run, instrumented or emulated, ctest knows SHARDS shares of the cases (1), which are to end at about the same time; with
# SLOW_START everywhere, for programs with OpenCV's hundred libraries. With TOGETHER they are one test everywhere, for suites that prepare for
# longer than their cases take; with OPTIMISED they are compiled at -O1 in all presets, for what would compute for minutes at -O0.
# NIGHTLY: patterns of GoogleTest's, of cases that are left to .ci/nightly where trials are few: statistics that are the same on every target.
# DAILY: patterns of cases that run every day where a preset leaves all shares but the first GAZED_SHARES_BY_DAY to the night.
# ANY_CPU: what it finds does not depend on the CPU: texts, files, packets. A preset whose word size is this machine's leaves all of it to the
# night, its building too (GAZED_ANY_CPU_BY_NIGHT).
function(gazed_test name)
  cmake_parse_arguments(ARG "TOGETHER;OPTIMISED;SLOW_START;ANY_CPU" "SHARDS;NIGHTLY;DAILY" "SOURCES;LINK;PROPERTIES" ${ARGN})
  add_executable(${name}_test ${ARG_SOURCES})
  target_link_libraries(${name}_test PRIVATE ${ARG_LINK} GTest::gmock_main)
  gazed_compile_as_test(${name}_test "${ARG_OPTIMISED}")
  if(GAZED_TEST_SHARE)
    add_test(NAME ${name}.share COMMAND ${name}_test)
    set_tests_properties(${name}.share PROPERTIES TIMEOUT 600 ENVIRONMENT "GTEST_TOTAL_SHARDS=8;GTEST_SHARD_INDEX=0" ${ARG_PROPERTIES})
    return()
  endif()
  if(ARG_TOGETHER)
    add_test(NAME ${name} COMMAND ${name}_test)
    set_tests_properties(${name} PROPERTIES TIMEOUT 600 COST 50 ${ARG_PROPERTIES})  # begun first: others run beside it
    return()
  endif()
  if(GAZED_FEW_TRIALS OR ARG_SLOW_START)
    if(NOT ARG_SHARDS)
      set(ARG_SHARDS 1)
    endif()
    set(by_day)
    if(GAZED_FEW_TRIALS AND ARG_NIGHTLY)
      set(by_day "GTEST_FILTER=-${ARG_NIGHTLY}")
      add_test(NAME ${name}.night COMMAND ${name}_test)
      set_tests_properties(${name}.night PROPERTIES TIMEOUT 1800 LABELS night ENVIRONMENT "GTEST_FILTER=${ARG_NIGHTLY}" ${ARG_PROPERTIES})
    endif()
    if(GAZED_SHARES_BY_DAY AND ARG_DAILY)
      add_test(NAME ${name}.daily COMMAND ${name}_test)
      set_tests_properties(${name}.daily PROPERTIES TIMEOUT 600 ENVIRONMENT "GTEST_FILTER=${ARG_DAILY}" ${ARG_PROPERTIES})
    endif()
    set(label)
    if(GAZED_ANY_CPU_BY_NIGHT AND ARG_ANY_CPU)
      set(label LABELS night)
      set_target_properties(${name}_test PROPERTIES EXCLUDE_FROM_ALL ON)
      add_dependencies(night_tests ${name}_test)
    endif()
    foreach(shard RANGE 1 ${ARG_SHARDS})
      math(EXPR index "${shard} - 1")
      if(GAZED_SHARES_BY_DAY AND shard GREATER GAZED_SHARES_BY_DAY)
        set(label LABELS night)
      endif()
      set(test ${name}.${shard}_of_${ARG_SHARDS})
      add_test(NAME ${test} COMMAND ${name}_test)
      set_tests_properties(${test} PROPERTIES TIMEOUT 600 COST ${ARG_SHARDS}  # the longest first
        ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${index};${by_day}" ${label} ${ARG_PROPERTIES})
    endforeach()
    return()
  endif()
  gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 600 ${ARG_PROPERTIES})
endfunction()
