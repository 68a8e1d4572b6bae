# NAO V6: cross-built against a sysroot of 64-bit libraries, tested on an emulated CPU with what a Silvermont has: QEMU has no
# model of it, but Westmere with these three is the same set of instructions for programs; its Denverton knows newer ones.
include(${CMAKE_CURRENT_LIST_DIR}/silvermont.cmake)
set(GAZED_PRESET nao-v6)
# Word size and compiler are this machine's, whose own tests do not take ten times as long. By day one share of a long program, with the golden
# numbers and hashes, shows that its newer instructions change no bit and that none is used that the CPU lacks; .ci/nightly runs the others.
set(GAZED_SHARES_BY_DAY 1)
set(GAZED_ANY_CPU_BY_NIGHT ON)
set(GAZED_SYSROOT_TRIPLET x86_64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/GazedSysroot.cmake)
gazed_emulator(qemu-x86_64 Westmere,+movbe,+rdrand,+rdtscp)
