// What decoder and encoder have in common: libjpeg reports errors by a jump.
#pragma once

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs it
#include <jpeglib.h>

namespace gazed::jpeg {

/// Where libjpeg goes on after an error, and what it was. The functions that setjmp(errors.jump)
/// guards hold nothing that has a destructor.
struct Errors {
  jpeg_error_mgr manager{};  // the first member: libjpeg gives back a pointer to it
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> words{};

  /// What jpeg_decompress_struct::err and jpeg_compress_struct::err are to be.
  [[nodiscard]] jpeg_error_mgr* install();
};

}  // namespace gazed::jpeg
