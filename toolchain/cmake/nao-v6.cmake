# NAO V6: cross-built against a sysroot of 64-bit libraries, tested on an emulated CPU with what a Silvermont has: QEMU has no
# model of it, but Westmere with these three is the same set of instructions for programs; its Denverton knows newer ones.
include(${CMAKE_CURRENT_LIST_DIR}/silvermont.cmake)
set(GAZED_PRESET nao-v6)
set(GAZED_SYSROOT_TRIPLET x86_64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/GazedSysroot.cmake)
gazed_emulator(qemu-x86_64 Westmere,+movbe,+rdrand,+rdtscp)
