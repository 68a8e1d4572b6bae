// An even selection: never more than twice as many as wanted, whatever the length.
#include "agent/lab/calibration/even_selection.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <vector>

namespace gazed::lab::calibration::even_selection_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(EvenSelection, Nothing) {
  EXPECT_THAT(EvenSelection<int>(3).take(), IsEmpty());
}

TEST(EvenSelection, FewAreAllKept) {
  EvenSelection<int> selection(3);
  for (int i = 0; i < 3; ++i) selection.add(i);
  EXPECT_THAT(selection.take(), ElementsAre(0, 1, 2));
}

TEST(EvenSelection, EverySecondGoesBeyondTwiceAsMany) {
  EvenSelection<int> selection(2);
  for (int i = 0; i < 5; ++i) selection.add(i);
  EXPECT_EQ(selection.held(), 3U);  // 0, 2, 4
  selection.add(5);
  EXPECT_EQ(selection.held(), 3U);
  selection.add(6);
  EXPECT_EQ(selection.held(), 4U);  // and 6
  EXPECT_THAT(selection.take(), ElementsAre(0, 4));
}

TEST(EvenSelection, AnyLengthIsHeldInBoundsAndEven) {
  constexpr int most = 5;
  for (int length = most; length < 300; ++length) {
    EvenSelection<int> selection(most);
    for (int i = 0; i < length; ++i) {
      selection.add(i);
      ASSERT_LE(selection.held(), 2U * most);
    }
    const std::vector<int> items = selection.take();
    ASSERT_THAT(items, SizeIs(most));
    EXPECT_EQ(items.front(), 0);
    int least = length, greatest = length - items.back();
    for (std::size_t i = 1; i < items.size(); ++i) {
      least = std::min(least, items[i] - items[i - 1]);
      greatest = std::max(greatest, items[i] - items[i - 1]);
    }
    EXPECT_GT(least, 0);
    EXPECT_LE(greatest, 2 * least) << "of " << length;
  }
}

TEST(EvenSelection, NewestIsReplacedWhereItIsHeld) {
  EvenSelection<int> selection(1);
  selection.add(0);
  selection.replace_newest(10);
  selection.add(1);
  selection.replace_newest(11);
  selection.add(2);  // the third: 1 goes
  selection.replace_newest(12);
  EXPECT_EQ(selection.held(), 2U);
  selection.add(3);  // one in two: not held
  selection.replace_newest(13);
  EXPECT_EQ(selection.held(), 2U);
  EXPECT_THAT(selection.take(), ElementsAre(10));
}

}  // namespace
}  // namespace gazed::lab::calibration::even_selection_test
