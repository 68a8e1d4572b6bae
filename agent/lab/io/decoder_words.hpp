// What libraries say while they decode a picture.
//
// OpenCV 4.6 writes to std::cerr what its decoders throw, libpng and libjpeg write to the standard
// error, and none of them names the file. No setting of OpenCV's reaches them.
#pragma once

#include <string>

#include "agent/base/file_descriptor.hpp"

namespace gazed::lab::io {

/// Keeps what this process writes to the standard error, from construction to heard() or
/// destruction. One at a time; where the system has no memory for it, nothing is kept.
class DecoderWords {
 public:
  DecoderWords();
  ~DecoderWords() { stop(); }
  DecoderWords(const DecoderWords&) = delete;
  DecoderWords& operator=(const DecoderWords&) = delete;

  /// The first line, short and printable, without places in OpenCV's sources; empty when nothing
  /// was said. The standard error is as before from then on.
  [[nodiscard]] std::string heard();

 private:
  void stop();

  base::FileDescriptor kept_, standard_error_;
};

}  // namespace gazed::lab::io
