#include "agent/saliency/bit_plane.hpp"

#include <algorithm>
#include <bit>

namespace gazed::saliency {

namespace {

using Word = BitPlane::Word;

constexpr Word lowest_bit = 1;
constexpr int top = BitPlane::word_bits - 1;

// The whole runs of `mask` in which a seed lies; seeds lie in the mask. Upwards a carry runs
// through the run, downwards the runs are taken by doubling steps.
Word fill_runs(Word mask, Word seeds) {
  Word filled = (((mask + seeds) ^ mask) | seeds) & mask;
  for (int step = 1; step < BitPlane::word_bits; step *= 2) {
    filled |= mask & (filled >> step);
    mask &= mask >> step;
  }
  return filled;
}

// The same in a row of words: runs go on from one word to the next. False when nothing was added.
bool fill_row(const Word* mask, int words, Word* reached) {
  bool added = false;
  const auto fill = [&](int i, Word from_neighbour) {
    const Word seeds = reached[i] | (from_neighbour & mask[i]);
    const Word filled = fill_runs(mask[i], seeds);
    added |= filled != reached[i];
    reached[i] = filled;
  };
  fill(0, 0);
  for (int i = 1; i < words; ++i) fill(i, reached[i - 1] >> top);
  for (int i = words - 1; i-- > 0;) fill(i, reached[i + 1] << top);
  return added;
}

// Takes over what of the row beside is reached. False when nothing was added.
bool spread(const BitPlane& mask, int from, int to, BitPlane& reached) {
  const Word *mask_row = mask.row(to), *beside = reached.row(from);
  Word* row = reached.row(to);
  Word fresh = 0;
  for (int i = 0; i < mask.row_words(); ++i) {
    const Word seeds = beside[i] & mask_row[i] & ~row[i];
    row[i] |= seeds;
    fresh |= seeds;
  }
  if (fresh == 0) return false;
  fill_row(mask_row, mask.row_words(), row);
  return true;
}

void start_at_border(const BitPlane& mask, BitPlane& reached) {
  const int last_row = mask.height() - 1, last_word = mask.row_words() - 1;
  const Word last_column = lowest_bit << ((mask.width() - 1) % BitPlane::word_bits);
  for (int y = 0; y <= last_row; ++y) {
    const Word* from = mask.row(y);
    Word* to = reached.row(y);
    if (y == 0 || y == last_row) {
      std::copy_n(from, mask.row_words(), to);
      continue;
    }
    std::fill_n(to, mask.row_words(), 0);
    to[0] |= from[0] & lowest_bit;
    to[last_word] |= from[last_word] & last_column;
    fill_row(from, mask.row_words(), to);
  }
}

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

// Sweeps down and up until one adds nothing: two or three, but for spirals.
void flood_from_border(const BitPlane& mask, BitPlane& reached) {
  start_at_border(mask, reached);
  bool added = true;
  while (added) {
    added = false;
    for (int y = 1; y < mask.height(); ++y) added |= spread(mask, y - 1, y, reached);
    for (int y = mask.height() - 1; y-- > 0;) added |= spread(mask, y + 1, y, reached);
  }
}

void dilate(const BitPlane& plane, BitPlane& dilated) {
  const int words = plane.row_words();
  const auto columns = [&](int i, int y) {  // a word of a row or'ed with the rows beside it
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
