#include "agent/saliency/columns.hpp"

#include <algorithm>
#include <array>

namespace gazed::saliency {

using namespace lanes;

namespace {

constexpr int block_bytes = 16;

constexpr std::size_t padded_bytes(int bytes) {
  return static_cast<std::size_t>((bytes + block_bytes - 1) / block_bytes * block_bytes);
}

}  // namespace

ByteColumns::ByteColumns(int most_bytes_a_row)
    : unfinished_(padded_bytes(most_bytes_a_row)), begun_(padded_bytes(most_bytes_a_row)) {}

// Output row j is r[2j-2] + 4 r[2j-1] + 6 r[2j] + 4 r[2j+1] + r[2j+2]: the pair (a, b) = (r[2j],
// r[2j+1]) gives it 6 a + 4 b, the output row after it a + 4 b, and the one before it a.
void ByteColumns::push(const std::uint8_t* first, const std::uint8_t* second, int bytes,
                       std::int16_t* out) {
  std::int16_t *unfinished = unfinished_.data(), *begun = begun_.data();
  const auto push_half = [=](int x, I16x8 a, I16x8 sixes_and_fours, I16x8 ones_and_fours) {
    store(out + x, load(unfinished + x) + a);
    store(unfinished + x, load(begun + x) + sixes_and_fours);
    store(begun + x, ones_and_fours);
  };
  const auto push_block = [=](U8x16 a, U8x16 b, int x) {
    push_half(x, widened_low(a), weighted_low<6, 4>(a, b), weighted_low<1, 4>(a, b));
    push_half(x + lane_count, widened_high(a), weighted_high<6, 4>(a, b),
              weighted_high<1, 4>(a, b));
  };
  const int whole = bytes / block_bytes * block_bytes;
  for (int x = 0; x < whole; x += block_bytes)
    push_block(load_unaligned(first + x), load_unaligned(second + x), x);
  if (whole == bytes) return;
  std::array<std::uint8_t, block_bytes> last_first{}, last_second{};
  std::copy(first + whole, first + bytes, last_first.begin());
  std::copy(second + whole, second + bytes, last_second.begin());
  push_block(load_unaligned(last_first.data()), load_unaligned(last_second.data()), whole);
}

}  // namespace gazed::saliency
