// gazelab triangulate takes the same memory for any number of rows.

#include <algorithm>
#include <cstdlib>
#include <gmock/gmock.h>
#include <malloc.h>
#include <new>
#include <random>
#include <string>

#include "agent/lab/triangulate_rows.hpp"

#include "scratch.hpp"

namespace {

std::size_t held_bytes = 0;
std::size_t most_held_bytes = 0;

}  // namespace

// Not inlined, so that the compiler sees new and delete as a pair. The throwless one too, which
// std::stable_sort asks for its buffer: a sanitizer's own would not pair with the delete here.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* memory = std::malloc(size);
  if (memory == nullptr) return nullptr;
  held_bytes += malloc_usable_size(memory);
  most_held_bytes = std::max(most_held_bytes, held_bytes);
  return memory;
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = ::operator new(size, std::nothrow);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  if (memory != nullptr) held_bytes -= malloc_usable_size(memory);
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  ::operator delete(memory);
}

namespace gazed::lab::streaming_test {
namespace {

/// The most that is held at once while `rows` rows are triangulated, beyond what was held before.
std::size_t bytes_for(std::size_t rows) {
  const ScratchFolder folder;
  std::string text = "id,x1,y1,x2,y2\n";
  std::mt19937_64 random(1);
  const auto pixel = [&random] { return std::to_string(random() % 640) + ".25"; };
  for (std::size_t i = 0; i < rows; ++i) {
    text.append("point ").append(std::to_string(i));
    for (int k = 0; k < 4; ++k) text.append(",").append(pixel());
    text += '\n';
  }
  write_text(folder / "matches.csv", text);
  const CameraPair pair = parse_pair(R"(K1 = [[752, 0, 331], [0, 752, 253], [0, 0, 1]]
K2 = [[752, 0, 331], [0, 752, 253], [0, 0, 1]]
R = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
t = [-0.1, 0, 0]
pixel_sigma_px = 100
)",
                                     "pair.toml");
  const std::size_t held_before = held_bytes;
  most_held_bytes = held_bytes;
  CorrespondenceReader reader(folder / "matches.csv");
  PointTable table(folder / "points.csv");
  triangulate(pair, triangulation::methods::Method::optimal, reader, table);
  table.finish();
  EXPECT_EQ(table.rows(), rows);
  return most_held_bytes - held_before;
}

TEST(Streaming, TakesTheSameMemoryForAnyNumberOfRows) {
  const std::size_t for_few = bytes_for(100);
  const std::size_t for_many = bytes_for(20000);
  constexpr std::size_t longer_ids = 512;  // and the strings that hold them
  constexpr std::size_t bound = 16384;     // one row, its fields and its messages
  EXPECT_LE(for_many, for_few + longer_ids);
  EXPECT_LE(for_many, bound);
}

}  // namespace
}  // namespace gazed::lab::streaming_test
