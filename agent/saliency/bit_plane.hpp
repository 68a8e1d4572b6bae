// One-bit pictures, packed into words.
//
// Bit x of a row is bit x mod b of word x / b, with b bits to a word. Bits beyond the width are 0.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace gazed::saliency {

class BitPlane {
 public:
  /// The CPU's own word; results do not depend on its size.
  using Word = std::size_t;
  static constexpr int word_bits = std::numeric_limits<Word>::digits;

  BitPlane(int width, int height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int row_words() const { return row_words_; }
  [[nodiscard]] Word* row(int y) { return words_.data() + std::ptrdiff_t{row_words_} * y; }
  [[nodiscard]] const Word* row(int y) const {
    return words_.data() + std::ptrdiff_t{row_words_} * y;
  }
  [[nodiscard]] bool at(int x, int y) const {
    return (row(y)[x / word_bits] >> (x % word_bits) & 1) != 0;
  }
  void set(int x, int y) { row(y)[x / word_bits] |= Word{1} << (x % word_bits); }

  /// All words, row by row.
  [[nodiscard]] std::span<Word> words() { return words_; }
  [[nodiscard]] std::span<const Word> words() const { return words_; }
  /// Mask of the bits of a word (in any row) that are inside the picture.
  [[nodiscard]] Word inside(int word) const {
    return word + 1 < row_words_ ? ~Word{0} : last_inside_;
  }

  [[nodiscard]] int count() const;  // number of set bits

 private:
  int width_;
  int height_;
  int row_words_;
  Word last_inside_;
  std::vector<Word> words_;
};

/// Sets every set bit's 8 neighbours too.
void dilate(const BitPlane& plane, BitPlane& dilated);

}  // namespace gazed::saliency
