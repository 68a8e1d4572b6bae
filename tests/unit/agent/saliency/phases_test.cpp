// Down the columns and along the rows, pass by pass, against the filter's formula.
#include "agent/saliency/phases.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "agent/saliency/columns.hpp"
#include "agent/saliency/unzip.hpp"

namespace gazed::saliency::phases_test {
namespace {

constexpr std::array taps{1, 4, 6, 4, 1};

/// The filter at `centre` of `samples`, reflected at the ends, with its gain.
template <typename Sample>
int filtered_at(const std::vector<Sample>& samples, int centre) {
  int sum = 0;
  for (int k = 0; k < 5; ++k)
    sum +=
        taps[static_cast<std::size_t>(k)] * samples[static_cast<std::size_t>(reflect_101(
                                                centre + k - 2, static_cast<int>(samples.size())))];
  return sum;
}

std::vector<std::int16_t> random_row(int length, int low, int high, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::int16_t> row(static_cast<std::size_t>(length));
  for (std::int16_t& sample : row)
    sample = static_cast<std::int16_t>(
        low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1)));
  return row;
}

TEST(ByteColumns, EachOutputIsTheFilterOfFiveRows) {
  for (const int bytes : {1, 15, 16, 17, 96, 483}) {
    for (const int height : {3, 4, 7, 8}) {
      std::mt19937_64 random(1);
      std::vector<std::vector<std::uint8_t>> rows(static_cast<std::size_t>(height));
      for (auto& row : rows) {
        row.resize(static_cast<std::size_t>(bytes));
        for (std::uint8_t& b : row)
          b = random() % 3 == 0 ? 255 : static_cast<std::uint8_t>(random());
      }
      const auto row_at = [&](int y) {
        return rows[static_cast<std::size_t>(reflect_101(y, height))].data();
      };
      ByteColumns columns(bytes);
      AlignedSamples<std::int16_t> out(static_cast<std::size_t>(bytes) + 16);
      for (int y = -2; y <= 2 * halved(height); y += 2) {
        columns.push(row_at(y), row_at(y + 1), bytes, out.data());
        if (y < 2) continue;
        for (int x = 0; x < bytes; ++x) {
          std::vector<int> column;
          for (const auto& row : rows) column.push_back(row[static_cast<std::size_t>(x)]);
          ASSERT_EQ(out.data()[x], filtered_at(column, y - 2))
              << bytes << " bytes, " << height << " rows, at " << x << ',' << y - 2;
        }
      }
    }
  }
}

TEST(FilterColumns, RoundsSignedAndUnsigned) {
  constexpr int length = 40;
  const auto check = [&]<typename Sample>(Sample, int low, int high) {
    std::array<AlignedSamples<std::int16_t>, 5> rows{
        AlignedSamples<std::int16_t>(length), AlignedSamples<std::int16_t>(length),
        AlignedSamples<std::int16_t>(length), AlignedSamples<std::int16_t>(length),
        AlignedSamples<std::int16_t>(length)};
    for (std::size_t k = 0; k < 5; ++k) {
      const auto row = random_row(length, low, high, k + 1);
      std::copy(row.begin(), row.end(), rows[k].data());
    }
    AlignedSamples<std::int16_t> out(length);
    filter_columns<Sample>(
        {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data(), rows[4].data()}, length,
        out.data());
    for (int x = 0; x < length; ++x) {
      int sum = 0;
      for (std::size_t k = 0; k < 5; ++k) sum += taps[k] * rows[k].data()[x];
      EXPECT_EQ(out.data()[x], rounding_shift<4>(sum));
    }
  };
  check(std::int16_t{}, -largest_before_filter_signed, largest_before_filter_signed);
  check(std::uint16_t{}, 0, largest_before_filter_unsigned);
}

// Every width, so that rows end in each phase.
TEST(Phases, TwoStepsAreTheFilterTwice) {
  const auto check = [&]<typename Sample>(Sample, int low, int high) {
    for (int width = 30; width <= 100; ++width) {
      const auto row = random_row(width, low, high, static_cast<std::uint64_t>(width));
      const int length = phase_length(width);
      PhaseRow<4> level0(width, length);
      for (int x = 0; x < width; ++x) level0.phase(x % 4)[x / 4] = row[static_cast<std::size_t>(x)];
      level0.reflect_ends();
      PhaseRow<2> level1(halved(width), length);
      halve<Sample>(level0, length, level1);
      level1.reflect_ends();
      AlignedSamples<std::int16_t> level2(static_cast<std::size_t>(length));
      halve<Sample>(level1, length, level2.data());

      std::vector<int> half;
      for (int i = 0; i < halved(width); ++i) {
        half.push_back(rounding_shift<4>(filtered_at(row, 2 * i)));
        ASSERT_EQ(level1.phase(i % 2)[i / 2], half.back()) << i << " of " << width;
      }
      for (int i = 0; i < length_at_level(width, 2); ++i)
        ASSERT_EQ(static_cast<Sample>(level2.data()[i]),
                  rounding_shift<1>(filtered_at(half, 2 * i)))
            << i << " of " << width;
    }
  };
  check(std::int16_t{}, -largest_before_filter_signed, largest_before_filter_signed);
  check(std::uint16_t{}, 0, largest_before_filter_unsigned);
}

std::array<std::int16_t, lane_count> samples_of(lanes::I16x8 v) {
  alignas(16) std::array<std::int16_t, lane_count> out;
  store(out.data(), v);
  return out;
}

// Sample 100 c + x, channel c of column x.
TEST(Unzip, RgbOf16Bits) {
  AlignedSamples<std::int16_t> block(96);
  for (int n = 0; n < 96; ++n) block.data()[n] = static_cast<std::int16_t>(100 * (n % 3) + n / 3);
  const auto planes = unzip_rgb(block.data());
  for (int x = 0; x < 32; ++x)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(samples_of(planes[static_cast<std::size_t>(c)][static_cast<std::size_t>(
                    x % 4)])[static_cast<std::size_t>(x / 4)],
                100 * c + x);
}

TEST(Unzip, RgbOfBytes) {
  std::array<std::uint8_t, 96> block{};
  for (std::size_t n = 0; n < 96; ++n) block[n] = static_cast<std::uint8_t>(80 * (n % 3) + n / 3);
  const auto planes = unzip_rgb(block.data());
  for (std::size_t x = 0; x < 32; ++x)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(samples_of(planes[c][x % 4])[x / 4], static_cast<int>(80 * c + x));
}

TEST(Unzip, Yuyv) {
  AlignedSamples<std::int16_t> block(64);
  for (int x = 0; x < 32; ++x) {
    block.data()[2 * x] = static_cast<std::int16_t>(x);
    block.data()[2 * x + 1] = static_cast<std::int16_t>((x % 2 == 0 ? 100 : 200) + x / 2);
  }
  const YuvPhases is = unzip_yuyv(block.data());
  for (std::size_t x = 0; x < 32; ++x)
    EXPECT_EQ(samples_of(is.y[x % 4])[x / 4], static_cast<int>(x));
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(samples_of(is.u[i % 2])[i / 2], static_cast<int>(100 + i));
    EXPECT_EQ(samples_of(is.v[i % 2])[i / 2], static_cast<int>(200 + i));
  }
}

}  // namespace
}  // namespace gazed::saliency::phases_test
