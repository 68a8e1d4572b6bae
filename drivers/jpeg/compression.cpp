#include "drivers/jpeg/compression.hpp"

#include <algorithm>
#include <jerror.h>

namespace gazed::jpeg {

namespace {

[[noreturn]] void stop(j_common_ptr info) {
  auto* errors = reinterpret_cast<Errors*>(info->err);
  info->err->format_message(info, errors->words.data());
  std::longjmp(errors->jump, 1);
}

/// Warnings are damage, after which libjpeg goes on with grey pixels. These are none: a missing end
/// marker, bytes between image and marker, and zeros for a scan's parameters, of which only
/// progressive files have a use; many cameras send them.
constexpr std::array harmless{JWRN_JPEG_EOF, JWRN_EXTRANEOUS_DATA, JWRN_JFIF_MAJOR,
                              JWRN_NOT_SEQUENTIAL};

void warn(j_common_ptr info, int level) {
  const bool is_warning = level < 0;
  if (is_warning && std::ranges::find(harmless, info->err->msg_code) == harmless.end()) stop(info);
}

void say_nothing(j_common_ptr) {}

}  // namespace

jpeg_error_mgr* Errors::install() {
  jpeg_std_error(&manager);
  manager.error_exit = stop;
  manager.emit_message = warn;
  manager.output_message = say_nothing;
  return &manager;
}

}  // namespace gazed::jpeg
