# NAO V3.3 to V5: cross-built against a sysroot of 32-bit libraries, tested on an emulated Atom N270 (Bonnell).
include(${CMAKE_CURRENT_LIST_DIR}/bonnell.cmake)
set(GAZED_PRESET nao-v4)
# By day two shares of a long program, with the golden numbers and hashes, and all that parses, since its words are shorter; .ci/nightly runs the others.
set(GAZED_SHARES_BY_DAY 2)
set(GAZED_SYSROOT_TRIPLET i386-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/GazedSysroot.cmake)
gazed_emulator(qemu-i386 n270)
