#include "agent/lab/io/jpeg_scan.hpp"

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs it and does not say so
#include <jerror.h>
#include <jpeglib.h>
#include <vector>

namespace gazed::lab::io {

namespace {

/// What libjpeg says while it decodes. It wants the error manager first in the struct.
struct Complaints {
  jpeg_error_mgr manager{};
  std::jmp_buf out_of_libjpeg{};
  bool data_missing = false;
};

Complaints& complaints_of(j_common_ptr jpeg) {
  return *reinterpret_cast<Complaints*>(jpeg->err);
}

void note(j_common_ptr jpeg, int level) {
  // Blocks were asked for after the data had ended. That the end marker is missing is another one.
  if (level < 0 && jpeg->err->msg_code == JWRN_HIT_MARKER) complaints_of(jpeg).data_missing = true;
}

void give_up(j_common_ptr jpeg) {
  std::longjmp(complaints_of(jpeg).out_of_libjpeg, 1);
}

/// Whether a progressive picture has every coefficient to its last bit.
bool is_refined(const jpeg_decompress_struct& jpeg) {
  if (jpeg.progressive_mode == FALSE || jpeg.coef_bits == nullptr) return true;
  for (int component = 0; component < jpeg.num_components; ++component) {
    if (!std::all_of(jpeg.coef_bits[component], jpeg.coef_bits[component] + DCTSIZE2,
                     [](int missing_bits) { return missing_bits == 0; })) {
      return false;
    }
  }
  return true;
}

/// False also for what libjpeg cannot decode at all. No object with a destructor may live between
/// setjmp and longjmp, so that the row is the caller's.
bool decode(std::span<const std::uint8_t> bytes, jpeg_decompress_struct& jpeg,
            Complaints& complaints, std::vector<std::uint8_t>& row) {
  if (setjmp(complaints.out_of_libjpeg) != 0) return false;
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  jpeg_start_decompress(&jpeg);
  row.resize(static_cast<std::size_t>(jpeg.output_width) *
             static_cast<std::size_t>(jpeg.output_components));
  JSAMPROW rows[] = {row.data()};
  while (jpeg.output_scanline < jpeg.output_height) jpeg_read_scanlines(&jpeg, rows, 1);
  return !complaints.data_missing && is_refined(jpeg);
}

}  // namespace

bool has_all_blocks(std::span<const std::uint8_t> bytes) {
  Complaints complaints;
  jpeg_decompress_struct jpeg{};
  jpeg.err = jpeg_std_error(&complaints.manager);
  complaints.manager.error_exit = give_up;
  complaints.manager.emit_message = note;
  jpeg_create_decompress(&jpeg);
  std::vector<std::uint8_t> row;
  const bool all = decode(bytes, jpeg, complaints, row);
  jpeg_destroy_decompress(&jpeg);
  return all;
}

}  // namespace gazed::lab::io
