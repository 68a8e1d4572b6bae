// Services that are not there, go away, come back, or answer late.
#include <algorithm>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/unit/drivers/naoqi/message_bytes.hpp"
#include "tests/unit/drivers/naoqi/service_rig.hpp"

namespace gazed::naoqi::lost_service_test {
namespace {

using ::testing::HasSubstr;
using LostQiService = QiServiceRig;

TEST_F(LostQiService, AnAnswerThatComesTooLateIsPassedOver) {
  int asked = 0;
  fake_.methods[0].handler = [&](QiReader) {
    return ++asked == 1 ? fake_silence() : fake_numbers({1.0F});
  };
  ASSERT_TRUE(turn_until_ready());
  int answers = 0;
  std::string first;
  dut().call(ask, {}, [&](const QiResult& result) { ++answers, first = result.error; });
  // Other calls are answered meanwhile: this one is late, and the robot not gone.
  for (int i = 0; answers == 0 && i < 3'000; ++i) EXPECT_EQ(error_of_call(tell), "");
  EXPECT_EQ(first, "no answer in time");
  EXPECT_EQ(error_of_call(ask), "");
  EXPECT_EQ(answers, 1);
  EXPECT_EQ(fake_.connections, 1);
}

TEST_F(LostQiService, ARobotThatSaysNothingIsLostAndFoundAgain) {
  ASSERT_TRUE(turn_until_ready());
  fake_.answers = false;
  const std::int64_t asked_us = now_us_;
  EXPECT_THAT(error_of_call(ask), HasSubstr("no answer for 1.0 s"));
  EXPECT_LE(now_us_ - asked_us, 1'100'000);
  EXPECT_FALSE(dut().ready());
  EXPECT_TRUE(turn_until_fault("no answer for 1.0 s"));
  fake_.answers = true;
  const std::int64_t back_us = now_us_;
  EXPECT_TRUE(turn_until_ready());
  EXPECT_LE(now_us_ - back_us, 2'000'000);
}

TEST_F(LostQiService, ARobotThatLetsNobodyInIsFoundWhenItDoes) {
  ASSERT_TRUE(turn_until_ready());
  for (int i = 0; i < 7; ++i) {
    fake_.answers = false;
    fake_.close_all();
    EXPECT_TRUE(turn_until_fault("authentication: no answer in time"));
    for (int turns = 0; turns < 2'000 + 157 * i; ++turns) turn();
    fake_.answers = true;
    const std::int64_t back_us = now_us_;
    EXPECT_TRUE(turn_until_ready());
    EXPECT_LE(now_us_ - back_us, 2'000'000);
  }
}

TEST_F(LostQiService, AnswersThatWaitForTheLoopAreNotTooLate) {
  fake_.methods[0].handler = [](QiReader) {
    FakeAnswer answer;
    answer.payload.u32(12'000);
    for (int i = 0; i < 12'000; ++i) answer.payload.f32(0.5F);
    return answer;
  };
  ASSERT_TRUE(turn_until_ready());
  int answers = 0;
  std::string errors;
  for (int i = 0; i < 2; ++i)
    dut().call(ask, {}, [&](const QiResult& result) { ++answers, errors += result.error; });
  while (fake_.calls_of("ask") < 2) fake_.serve();
  now_us_ += 3'000'000;  // the loop was away
  EXPECT_TRUE(turn_until([&] { return answers == 2; }));
  EXPECT_EQ(errors, "");
  EXPECT_EQ(fake_.connections, 1);
}

TEST_F(LostQiService, ARobotWhoseAnswerComesSlowlyIsNotLost) {
  ASSERT_TRUE(turn_until_ready());
  fake_.methods[0].handler = [](QiReader) { return fake_silence(); };
  std::string error;
  dut().call(ask, {}, [&](const QiResult& result) { error = result.error; });
  fake_.send_to_all(header_bytes({.id = 4711, .payload_bytes = 1'000'000, .type = QiType::reply}));
  const std::string part(100, '\0');
  for (int i = 0; i < 20; ++i) {
    fake_.send_to_all(part);
    for (int turns = 0; turns < 100; ++turns) turn();
  }
  EXPECT_EQ(error, "no answer in time");
  EXPECT_TRUE(dut().ready());
}

TEST_F(LostQiService, AClosedConnectionIsOpenedAgainSlowerAndSlower) {
  ASSERT_TRUE(turn_until_ready());
  fake_.listens = false;
  fake_.close_all();
  EXPECT_TRUE(turn_until_fault("closed the connection"));
  std::int64_t longest_us = 0;
  for (int i = 0; i < 10'000; ++i, turn()) {
    if (!dut().ready()) longest_us = std::max(longest_us, dut().due_us() - now_us_);
  }
  EXPECT_LE(longest_us, 500'000);
  EXPECT_GE(longest_us, 450'000);
  fake_.listens = true;
  const std::int64_t back_us = now_us_;
  EXPECT_TRUE(turn_until_ready());
  EXPECT_LE(now_us_ - back_us, 2'000'000);
}

TEST_F(LostQiService, NobodyThereIsAFault) {
  const base::Endpoint nobody{0x7f000001, 1};  // port 1: nothing listens there
  dut_.emplace(wake_up_, QiRobot{nobody, "", ""}, "ALMotion", methods);
  EXPECT_TRUE(turn_until_fault("Connection refused")) << dut().fault();
  EXPECT_THAT(dut().fault(), HasSubstr("ALMotion at 127.0.0.1:1"));
}

TEST_F(LostQiService, WhoSpeaksAnotherLanguageIsLeft) {
  fake_.answers = false;
  turn_until([this] { return fake_.connections > 0; });
  const std::string http = "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n";
  fake_.send_to_all(http);
  EXPECT_TRUE(turn_until_fault("no qi messaging"));
}

TEST_F(LostQiService, EveryCallIsAnsweredOnceWhenTheConnectionIsLost) {
  fake_.methods[0].handler = [](QiReader) { return fake_silence(); };
  ASSERT_TRUE(turn_until_ready());
  int answers = 0;
  for (int i = 0; i < 5; ++i) dut().call(ask, {}, [&](const QiResult&) { ++answers; });
  turn();
  fake_.close_all();
  EXPECT_TRUE(turn_until([&] { return answers == 5; }));
  EXPECT_TRUE(turn_until_ready());
  EXPECT_EQ(answers, 5);
  EXPECT_EQ(fake_.calls_of("ask"), 5);  // and none is repeated
}

}  // namespace
}  // namespace gazed::naoqi::lost_service_test
