#include "drivers/log/log_reader.hpp"

#include <cstdint>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <vector>

#include "drivers/lcm/big_endian.hpp"

#include "log_files.hpp"
#include "tests/unit/drivers/lcm/messages.hpp"

namespace gazed::log::log_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Bytes one{1, 1, 1, 1, 1};
const Bytes two{2, 2, 2};
const Bytes three{3, 3, 3, 3};
constexpr std::size_t message_size_at = 24;  // in an event

std::vector<Bytes> all_messages(LogReader& reader) {
  std::vector<Bytes> messages;
  while (const auto message = reader.next_message()) {
    messages.emplace_back(message->begin(), message->end());
  }
  return messages;
}

class Reader : public ::testing::Test {
 protected:
  LogReader reader_of(const Bytes& bytes) {
    file_.write(bytes);
    return LogReader(file_.path(), "A");
  }
  TemporaryFile file_;
};

TEST(Event, HeaderBytes) {
  // lcm/eventlog.c, lcm_eventlog_write_event: the order and width of the fields.
  const LogHeaderBytes bytes = encode(LogEventHeader{
      .number = 2, .time_us = 0x0102030405060708, .channel_bytes = 11, .message_bytes = 0x010203});
  EXPECT_THAT(bytes, ElementsAre(0xED, 0xA1, 0xDA, 0x01, 0, 0, 0, 0, 0, 0, 0, 2, 1, 2, 3, 4, 5, 6,
                                 7, 8, 0, 0, 0, 11, 0, 1, 2, 3));
  const LogEventHeader header = decode(bytes);
  EXPECT_EQ(header.sync_word, log_sync_word);
  EXPECT_EQ(header.number, 2);
  EXPECT_EQ(header.time_us, 0x0102030405060708);
  EXPECT_EQ(header.channel_bytes, 11);
  EXPECT_EQ(header.message_bytes, 0x010203);
}

TEST_F(Reader, GivesTheMessagesOfItsChannelInOrder) {
  auto reader = reader_of(
      joined({event("A", one), event("B", two), event("A", three), event("LCM_SELF_TEST", two)}));
  EXPECT_THAT(all_messages(reader), ElementsAre(one, three));
  EXPECT_THAT(reader.channels(), ElementsAre("A", "B", "LCM_SELF_TEST"));
  EXPECT_EQ(reader.notes(), "");
  EXPECT_EQ(reader.fault(), "");
}

TEST_F(Reader, EmptyMessage) {
  auto reader = reader_of(joined({event("A", {}), event("A", two)}));
  EXPECT_THAT(all_messages(reader), ElementsAre(Bytes{}, two));
}

TEST_F(Reader, EmptyFile) {
  auto reader = reader_of({});
  EXPECT_THAT(all_messages(reader), IsEmpty());
  EXPECT_EQ(reader.notes(), "");
}

TEST_F(Reader, NoLogAtAll) {
  auto reader = reader_of(Bytes(300'000, 'x'));
  EXPECT_THAT(all_messages(reader), IsEmpty());
  EXPECT_THAT(reader.notes(), HasSubstr("300000 bytes passed over in 1 place "));
}

TEST_F(Reader, GarbageInFrontBetweenAndBehind) {
  const Bytes garbage{9, 0xED, 0xA1, 0xDA, 9, 9, 9};  // almost a sync word
  auto reader = reader_of(
      joined({garbage, event("A", one), garbage, event("A", two), event("A", three), garbage}));
  EXPECT_THAT(all_messages(reader), ElementsAre(one, two, three));
  EXPECT_THAT(reader.notes(), HasSubstr("in 3 places to find the next event, first at byte 0"));
}

TEST_F(Reader, ZerosBehindTheLastEventAreAllThatIsPassedOver) {
  const Bytes events = joined({event("A", one), event("A", Bytes(100'000, 4))});
  auto reader = reader_of(joined({events, Bytes(500, 0)}));
  EXPECT_THAT(all_messages(reader), ElementsAre(one, Bytes(100'000, 4)));
  EXPECT_THAT(reader.notes(), HasSubstr("500 bytes passed over in 1 place to find the next event, "
                                        "first at byte " +
                                        std::to_string(events.size())));
}

TEST_F(Reader, SyncWordAcrossThePiecesOfASearch) {
  for (const std::size_t length :
       {65'533U, 65'534U, 65'535U, 65'536U, 65'537U, 65'538U, 131'070U}) {
    auto reader = reader_of(joined({Bytes(length, 7), event("A", one)}));
    EXPECT_THAT(all_messages(reader), ElementsAre(one)) << length;
  }
}

TEST_F(Reader, BadSyncWordHidesOnlyItsEvent) {
  Bytes bad = event("A", two);
  bad[3] = 0x02;
  auto reader = reader_of(joined({event("A", one), bad, event("A", three)}));
  EXPECT_THAT(all_messages(reader), ElementsAre(one, three));
}

TEST_F(Reader, LastEventCutShortAnywhere) {
  const Bytes sound = joined({event("A", one), event("A", two)});
  const std::size_t first = event("A", one).size();
  for (std::size_t length = first; length < sound.size(); ++length) {
    auto reader = reader_of(Bytes(sound.begin(), sound.begin() + static_cast<long>(length)));
    EXPECT_THAT(all_messages(reader), ElementsAre(one)) << length;
    EXPECT_EQ(reader.notes().empty(), length == first) << length;
  }
}

TEST_F(Reader, SizesThatCannotBe) {
  for (const std::int32_t size : {-1, std::numeric_limits<std::int32_t>::min(),
                                  std::numeric_limits<std::int32_t>::max(), 100'000'001}) {
    for (const std::size_t at : {message_size_at, message_size_at - 4}) {
      Bytes lying = event("A", two);
      lcm::write_big_endian(size, std::span(lying).subspan(at));
      auto reader = reader_of(joined({event("A", one), lying, event("A", three)}));
      EXPECT_THAT(all_messages(reader), ElementsAre(one, three)) << size << " at " << at;
      EXPECT_THAT(reader.notes(), HasSubstr("1 event cut short or of impossible size"));
    }
  }
}

TEST_F(Reader, ASizeThatLiesHidesNoLaterEvent) {
  Bytes lying = event("B", two);
  lcm::write_big_endian<std::int32_t>(40, std::span(lying).subspan(message_size_at));
  auto reader = reader_of(joined({event("A", one), lying, event("A", two), event("A", three)}));
  EXPECT_THAT(all_messages(reader), ElementsAre(one, two, three));
  EXPECT_THAT(reader.notes(), HasSubstr("passed over"));
}

TEST_F(Reader, ChannelThatIsNoName) {
  auto reader = reader_of(joined({event(std::string("\x01\x02", 2), one), event("A", two)}));
  EXPECT_THAT(all_messages(reader), ElementsAre(two));
  EXPECT_THAT(reader.channels(), ElementsAre("A"));
}

TEST_F(Reader, ManyChannelsAreNotAllKept) {
  Bytes bytes;
  for (int i = 0; i < 1000; ++i) bytes = joined({bytes, event(std::to_string(i), two)});
  auto reader = reader_of(bytes);
  EXPECT_THAT(all_messages(reader), IsEmpty());
  EXPECT_EQ(reader.channels().size(), 20U);
}

TEST_F(Reader, AFileThatShrinksEndsWithAFault) {
  file_.write(joined({event("A", one), event("A", Bytes(100'000, 5)), event("A", two)}));
  LogReader reader(file_.path(), "A");
  ASSERT_TRUE(reader.next_message());
  file_.write(event("A", one));
  EXPECT_THAT(all_messages(reader), IsEmpty());
  EXPECT_THAT(reader.fault(), HasSubstr("cannot read the log " + file_.path() + " to its end"));
}

TEST_F(Reader, MissingFile) {
  try {
    LogReader("/nowhere/robot.lcm", "A");
    FAIL() << "opened";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "cannot read the log /nowhere/robot.lcm: No such file or directory");
  }
}

TEST_F(Reader, NoRegularFile) {
  EXPECT_THROW(LogReader(::testing::TempDir(), "A"), std::invalid_argument);
  EXPECT_THROW(LogReader("/dev/null", "A"), std::invalid_argument);
}

TEST_F(Reader, RandomDamageLosesOnlyWhatWasDamaged) {
  // A size that came to lie can lead to the beginning of a later event, or to the end, by chance:
  // in 6 of these 70,000.
  constexpr int most_unlucky_runs = 20;
  std::mt19937_64 random(4);
  const Bytes sound = joined({event("A", one), event("B", two), event("A", three),
                              event("A", Bytes(50, 4)), event("B", one)});
  const Bytes after = joined({event("A", Bytes(70, 6)), event("A", Bytes(80, 7))});
  int unlucky_runs = 0;
  for (int run = 0; run < 70'000; ++run) {
    Bytes damaged = sound;
    lcm::mutate(damaged, random);
    auto reader = reader_of(joined({damaged, after}));
    const auto messages = all_messages(reader);
    ASSERT_LE(messages.size(), 7U) << "more than there ever were, run " << run;
    const std::size_t count = messages.size();
    const bool found =
        count >= 2 && messages[count - 2] == Bytes(70, 6) && messages[count - 1] == Bytes(80, 7);
    if (!found) ++unlucky_runs;
  }
  EXPECT_LE(unlucky_runs, most_unlucky_runs);
}

// Opened as other files are, it would wait for a writer for ever.
TEST(LogReader, AFifoIsRefusedAtOnce) {
  const std::string fifo = ::testing::TempDir() + "fifo_of_reader";
  std::filesystem::remove(fifo);
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  try {
    LogReader(fifo, "IMAGE");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("a FIFO; a regular file is needed"));
  }
  std::filesystem::remove(fifo);
}

}  // namespace
}  // namespace gazed::log::log_reader_test
