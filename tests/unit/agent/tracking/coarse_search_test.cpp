#include "agent/tracking/coarse_search.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <vector>

#include "scene.hpp"

namespace gazed::tracking::coarse_search_test {
namespace {

constexpr int width = 160, height = 120;

LumaLevel textured(const Eigen::Vector2d& shift, std::uint64_t seed = 5) {
  LumaLevel level;
  level.resize(width, height, 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value =
          40 + 170 * value_noise(x - shift.x() + 200, y - shift.y() + 200, 3.0, seed);
      level.row(y)[x] =
          static_cast<std::uint16_t>(std::lround(static_cast<double>(luma_one) * value));
    }
  }
  return level;
}

// The patch whose first sample lies at (x, y).
CoarsePatch patch_at(const LumaLevel& level, int x, int y) {
  CoarsePatch patch;
  for (int j = 0; j < coarse_side; ++j) {
    for (int i = 0; i < coarse_side; ++i) {
      patch.value[static_cast<std::size_t>(j * coarse_side + i)] =
          static_cast<float>(level.row(y + j)[x + i]) / luma_one;
    }
  }
  return patch;
}

double correlation(const CoarsePatch& a, const CoarsePatch& b) {
  double mean_a = 0, mean_b = 0, aa = 0, ab = 0, bb = 0;
  for (std::size_t i = 0; i < coarse_area; ++i) {
    mean_a += static_cast<double>(a.value[i]) / static_cast<double>(coarse_area);
    mean_b += static_cast<double>(b.value[i]) / static_cast<double>(coarse_area);
  }
  for (std::size_t i = 0; i < coarse_area; ++i) {
    const double da = static_cast<double>(a.value[i]) - mean_a;
    const double db = static_cast<double>(b.value[i]) - mean_b;
    aa += da * da;
    ab += da * db;
    bb += db * db;
  }
  return ab / std::sqrt(aa * bb);
}

TEST(CoarseView, CorrelatesAsTheTextbookSays) {
  constexpr double tolerance = 1e-4;  // single precision
  const LumaLevel level = textured({0, 0});
  CoarseView view(width, height);
  view.set(level);
  CoarsePatch patch = patch_at(level, 60, 40);
  const CoarsePatch raw = patch;
  ASSERT_TRUE(normalise(patch));
  // 11 places: no multiple of 4.
  std::array<float, 16> scores;
  for (int y = 37; y < 44; ++y) {
    view.correlate(patch, 55, y, 11, scores.data());
    for (int i = 0; i < 11; ++i) {
      const double expected = correlation(raw, patch_at(level, 55 + i, y));
      EXPECT_NEAR(static_cast<double>(scores[static_cast<std::size_t>(i)]),
                  expected * std::abs(expected), tolerance);
    }
  }
}

TEST(CoarseView, OutsideIsZero) {
  const LumaLevel level = textured({0, 0});
  CoarseView view(width, height);
  view.set(level);
  CoarsePatch patch = patch_at(level, 0, 0);
  ASSERT_TRUE(normalise(patch));
  std::array<float, 24> scores;
  view.correlate(patch, -10, 0, 12, scores.data());
  EXPECT_EQ(scores[9], 0.0F);
  EXPECT_NEAR(scores[10], 1.0F, 1e-4F);
  for (const int y : {-1, view.places_y()}) {
    view.correlate(patch, 10, y, 12, scores.data());
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(scores[i], 0.0F);
  }
  for (const int x : {-100, view.places_x(), 1000}) {
    view.correlate(patch, x, 10, 12, scores.data());
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(scores[i], 0.0F);
  }
  view.correlate(patch, view.places_x() - 2, 10, 12, scores.data());
  EXPECT_NE(scores[1], 0.0F);
  EXPECT_EQ(scores[2], 0.0F);
}

TEST(CoarsePatch, BlankIsRefused) {
  CoarsePatch patch;
  patch.value.fill(100.0F);
  EXPECT_FALSE(normalise(patch));
}

struct CoarseSearchTest : testing::Test {
  // Patches of the unshifted texture, their lines `span` long.
  std::vector<CoarseQuery> queries(const Eigen::Vector2f& span) {
    std::vector<CoarseQuery> made;
    for (int y = 30; y < 90; y += 15) {
      for (int x = 40; x < 110; x += 12) {
        CoarseQuery query{
            patch_at(level_1, x, y), {static_cast<float>(x), static_cast<float>(y)}, span};
        EXPECT_TRUE(normalise(query.patch));
        made.push_back(query);
      }
    }
    return made;
  }

  LumaLevel level_1 = textured({0, 0});
  CoarseSearch search{width, height};
};

TEST_F(CoarseSearchTest, FindsTheCommonShift) {
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(-7, 11), Eigen::Vector2d(20, -3)}) {
    search.view().set(textured(shift));
    const auto all = queries(Eigen::Vector2f::Zero());
    EXPECT_EQ(search.common_shift(all, 24), shift.cast<float>());
  }
}

// Points at different depths lie at different places of their lines.
TEST_F(CoarseSearchTest, ShiftAcrossTheLines) {
  search.view().set(textured({6, 9}));
  const auto all = queries({20, 0});
  const Eigen::Vector2f shift = search.common_shift(all, 16);
  EXPECT_EQ(shift.y(), 9.0F);
  EXPECT_LE(shift.x(), 6.0F);  // what is missing looks like depth
  EXPECT_GE(shift.x(), -14.0F);
}

TEST_F(CoarseSearchTest, PeaksAreNearTheLineAndInOrder) {
  search.view().set(textured({5.4, 2.3}));
  for (const CoarseQuery& query : queries({14, 7})) {
    const auto peaks = search.peaks(query, Eigen::Vector2f::Zero(), 2.0F);
    ASSERT_FALSE(peaks.empty());
    EXPECT_LT((peaks[0].place - query.far - Eigen::Vector2f(5.4F, 2.3F)).norm(), 0.4F);
    for (std::size_t i = 1; i < peaks.size(); ++i) {
      EXPECT_LE(peaks[i].score, peaks[i - 1].score);
    }
  }
}

TEST_F(CoarseSearchTest, LinesOutsideTheView) {
  search.view().set(level_1);
  auto all = queries({30, 30});
  for (CoarseQuery& query : all) query.far += Eigen::Vector2f(-150, -130);
  EXPECT_EQ(search.common_shift(all, 28), Eigen::Vector2f::Zero());
  for (const CoarseQuery& query : all) {
    EXPECT_TRUE(search.peaks(query, Eigen::Vector2f(-28, -28), 2.0F).empty());
  }
}

}  // namespace
}  // namespace gazed::tracking::coarse_search_test
