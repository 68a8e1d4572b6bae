// Any bytes as what gazelab reads: the first one chooses the file's kind.
#include <array>
#include <cstddef>
#include <cstdint>

#include "agent/lab/calibration/marks_csv.hpp"
#include "agent/lab/correspondences.hpp"
#include "agent/lab/io/encoded_picture.hpp"
#include "agent/lab/io/frames_csv.hpp"
#include "agent/lab/pair_file.hpp"

#include "file_in_memory.hpp"

namespace {

using gazed::fuzz::FileInMemory;

void read_correspondences(const FileInMemory& file) {
  gazed::lab::CorrespondenceReader reader(file.path());
  while (reader.next()) {
  }
}

constexpr std::array<void (*)(const FileInMemory&), 5> kinds{
    [](const FileInMemory& file) { static_cast<void>(gazed::lab::read_pair_file(file.path())); },
    read_correspondences,
    [](const FileInMemory& file) {
      static_cast<void>(gazed::lab::io::read_frames_csv(file.path()));
    },
    [](const FileInMemory& file) {
      static_cast<void>(gazed::lab::calibration::read_marks_csv(file.path()));
    },
    [](const FileInMemory& file) {
      static_cast<void>(gazed::lab::io::read_encoded_picture(file.path()));
    },
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const FileInMemory file;
  if (size == 0) return 0;
  file.write({data + 1, size - 1});
  gazed::fuzz::refusing([&] { kinds[data[0] % kinds.size()](file); });
  return 0;
}
