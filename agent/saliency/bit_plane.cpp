#include "agent/saliency/bit_plane.hpp"

#include <algorithm>
#include <bit>

namespace gazed::saliency {

namespace {

using Word = BitPlane::Word;

constexpr int top = BitPlane::word_bits - 1;

}  // namespace

BitPlane::BitPlane(int width, int height)
    : width_(width),
      height_(height),
      row_words_((width + word_bits - 1) / word_bits),
      last_inside_(~Word{0} >> (row_words_ * word_bits - width)),
      words_(static_cast<std::size_t>(row_words_) * static_cast<std::size_t>(height)) {}

int BitPlane::count() const {
  int bits = 0;
  for (const Word word : words_) bits += std::popcount(word);
  return bits;
}

void dilate(const BitPlane& plane, BitPlane& dilated) {
  const int words = plane.row_words();
  // a word of a row, or'ed with those of the neighbouring rows
  const auto columns = [&](int i, int y) {
    Word word = plane.row(y)[i];
    if (y > 0) word |= plane.row(y - 1)[i];
    if (y + 1 < plane.height()) word |= plane.row(y + 1)[i];
    return word;
  };
  for (int y = 0; y < plane.height(); ++y) {
    Word before = 0, here = columns(0, y);
    for (int i = 0; i < words; ++i) {
      const Word after = i + 1 < words ? columns(i + 1, y) : 0;
      dilated.row(y)[i] =
          (here | here << 1 | here >> 1 | before >> top | after << top) & plane.inside(i);
      before = here;
      here = after;
    }
  }
}

}  // namespace gazed::saliency
