#include "drivers/naoqi/service.hpp"

#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <poll.h>

#include "tests/unit/naoqi/fake_naoqi.hpp"

namespace gazed::service_test {
namespace {

using ::testing::HasSubstr;

constexpr std::array<QiMethod, 3> methods{
    {{"ask", "(s)"}, {"tell", "(mf)"}, {"dance", "()", false}}};
enum : std::size_t { ask, tell, dance };

// The service's time is the test's, and goes on by 1 ms a turn. What really takes time is only the
// loopback, which is given all the turns it needs.
class QiServiceTest : public testing::Test {
 protected:
  QiServiceTest() {
    fake_.methods = {{"ask", "(s)", "[f]",
                      [](QiReader) {
                        return fake_numbers({0.5F, 0.25F});
                      }},
                     {"ask", "(i)", "v", [](QiReader) { return fake_error("the wrong one"); }},
                     {"tell", "(mf)", "v", [](QiReader) { return FakeAnswer{}; }}};
  }

  QiService& dut(const std::string& user = "", const std::string& token = "") {
    if (!dut_) dut_.emplace(wake_up_, QiRobot{fake_.endpoint(), user, token}, "ALMotion", methods);
    return *dut_;
  }

  void turn() {
    fake_.serve();
    dut().serve(now_us_ += 1'000);
  }

  template <typename Condition>
  bool turn_until(Condition condition, int turns = 5'000) {
    for (int i = 0; i < turns && !condition(); ++i) turn();
    return condition();
  }
  bool turn_until_ready() {
    return turn_until([this] { return dut().ready(); });
  }
  bool turn_until_fault(const std::string& text) {
    return turn_until([&] { return dut().fault().find(text) != std::string::npos; });
  }

  /// The error of a call; none when it is answered.
  std::string error_of_call(std::size_t method) {
    std::optional<std::string> error;
    dut().call(method, {}, [&](const QiResult& result) { error = result.error; });
    turn_until([&] { return error.has_value(); });
    return error.value_or("never answered");
  }

  FakeNaoqi fake_;
  WakeUp wake_up_;
  std::int64_t now_us_ = 1'000'000'000;
  std::optional<QiService> dut_;
};

TEST_F(QiServiceTest, FindsItsServiceAndItsMethodsByNameAndParameters) {
  EXPECT_FALSE(dut().ready());
  ASSERT_TRUE(turn_until_ready()) << dut().fault();
  EXPECT_EQ(dut().fault(), "");
  EXPECT_TRUE(dut().has(ask));
  EXPECT_FALSE(dut().has(dance));
  EXPECT_EQ(fake_.connections, 1);
  std::array<double, 2> answer{};
  dut().call(ask, {}, [&](const QiResult& result) {
    std::array<QiValue, 3> numbers;
    ASSERT_TRUE(result.value);
    ASSERT_EQ(result.value->elements(numbers), 2U);
    answer = {*numbers[0].number(), *numbers[1].number()};
  });
  EXPECT_TRUE(turn_until([this] { return !dut().busy(); }));
  EXPECT_EQ(answer, (std::array{0.5, 0.25}));
  EXPECT_EQ(error_of_call(tell), "");
  EXPECT_EQ(error_of_call(dance), "no such method");
}

TEST_F(QiServiceTest, ADynamicPayloadIsWhatItSaysItIs) {
  fake_.methods[0].handler = [](QiReader) {
    FakeAnswer answer;
    write_dynamic_list(answer.payload, std::vector<float>{0.5F});
    answer.flags = qi_dynamic_payload;
    return answer;
  };
  ASSERT_TRUE(turn_until_ready());
  std::array<QiValue, 3> numbers;
  double answer = 0.0;
  dut().call(ask, {}, [&](const QiResult& result) {
    if (result.value && result.value->elements(numbers) == 1) answer = *numbers[0].number();
  });
  EXPECT_TRUE(turn_until([&] { return answer == 0.5; }));
}

TEST_F(QiServiceTest, AnotherPortOfTheSameRobotIsGoneTo) {
  FakeNaoqi other;
  other.methods = fake_.methods;
  fake_.places = {"tcp://192.168.1.5:9559", "tcp://" + to_string(other.endpoint())};
  EXPECT_TRUE(turn_until([&] { return other.serve(), dut().ready(); })) << dut().fault();
  EXPECT_EQ(other.connections, 1);
}

TEST_F(QiServiceTest, PlacesThatCannotBeReachedAreAFault) {
  fake_.places = {"qi:somewhere", "tcp://:80", "tcps://127.0.0.1:1"};
  EXPECT_TRUE(turn_until_fault("lists no address that can be reached"));
}

TEST_F(QiServiceTest, UserAndTokenAreTold) {
  dut("nao", "secret");
  EXPECT_TRUE(turn_until_ready());
  EXPECT_EQ(fake_.user, "nao");
  EXPECT_EQ(fake_.token, "secret");
}

TEST_F(QiServiceTest, ARobotThatAsksForMoreIsAFaultThatSaysWhatToDo) {
  for (const std::uint32_t state : {1U, 2U}) {
    fake_.authentication_state = state;
    EXPECT_TRUE(turn_until_fault("naoqi.user and naoqi.token"));
  }
  EXPECT_EQ(fake_.user, "");
  fake_.authentication_state = 3;
  EXPECT_TRUE(turn_until_ready());
}

TEST_F(QiServiceTest, NaoqiBeforeAuthenticationIsToldTheCapabilitiesInstead) {
  fake_.knows_authentication = false;
  EXPECT_TRUE(turn_until_ready()) << dut().fault();
  EXPECT_THAT(fake_.received,
              ::testing::ElementsAre(QiType::call, QiType::capability, QiType::call, QiType::call));
}

TEST_F(QiServiceTest, UnaskedMessagesArePassedOver) {
  ASSERT_TRUE(turn_until_ready());
  QiHeader header;
  for (const std::uint8_t type : {4, 5, 6, 7, 8, 2, 3, 0, 255}) {
    header.type = static_cast<QiType>(type);
    header.id = 4711;
    QiWriter message;
    message.header(header);
    fake_.send_to_all(message.bytes());
  }
  EXPECT_EQ(error_of_call(ask), "");
  EXPECT_EQ(fake_.connections, 1);
}

TEST_F(QiServiceTest, AMissingMethodIsAFaultUntilItIsThere) {
  fake_.methods[0].parameters = "(l)";
  EXPECT_TRUE(turn_until_fault("no method ask(s)"));
  fake_.methods[0].parameters = "(s)";
  EXPECT_TRUE(turn_until_ready());
}

TEST_F(QiServiceTest, ErrorsAreTheRobotsWords) {
  fake_.methods[0].handler = [](QiReader) { return fake_error("no angles today"); };
  ASSERT_TRUE(turn_until_ready());
  EXPECT_EQ(error_of_call(ask), "no angles today");
  EXPECT_TRUE(dut().ready());
}

TEST_F(QiServiceTest, AnAnswerOfAnotherTypeIsAnError) {
  fake_.methods[0].handler = [](QiReader) {
    FakeAnswer answer;
    answer.payload.u32(77);
    return answer;
  };
  ASSERT_TRUE(turn_until_ready());
  EXPECT_THAT(error_of_call(ask), HasSubstr("not what it should be"));
  EXPECT_TRUE(dut().ready());
}

TEST_F(QiServiceTest, AnAnswerThatComesTooLateIsPassedOver) {
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

TEST_F(QiServiceTest, ARobotThatSaysNothingIsLostAndFoundAgain) {
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

TEST_F(QiServiceTest, ARobotWhoseAnswerComesSlowlyIsNotLost) {
  ASSERT_TRUE(turn_until_ready());
  fake_.methods[0].handler = [](QiReader) { return fake_silence(); };
  std::string error;
  dut().call(ask, {}, [&](const QiResult& result) { error = result.error; });
  QiWriter header;
  header.header({.id = 4711, .payload_bytes = 1'000'000, .type = QiType::reply});
  fake_.send_to_all(header.bytes());
  const std::vector<std::uint8_t> part(100);
  for (int i = 0; i < 20; ++i) {
    fake_.send_to_all(part);
    for (int turns = 0; turns < 100; ++turns) turn();
  }
  EXPECT_EQ(error, "no answer in time");
  EXPECT_TRUE(dut().ready());
}

TEST_F(QiServiceTest, AClosedConnectionIsOpenedAgainSlowerAndSlower) {
  ASSERT_TRUE(turn_until_ready());
  fake_.listens = false;
  fake_.close_all();
  EXPECT_TRUE(turn_until_fault("closed the connection"));
  std::int64_t longest_us = 0;
  for (int i = 0; i < 10'000; ++i, turn()) {
    if (!dut().ready()) longest_us = std::max(longest_us, dut().due_us() - now_us_);
  }
  EXPECT_LE(longest_us, 1'000'000);
  EXPECT_GE(longest_us, 900'000);
  fake_.listens = true;
  const std::int64_t back_us = now_us_;
  EXPECT_TRUE(turn_until_ready());
  EXPECT_LE(now_us_ - back_us, 2'000'000);
}

TEST_F(QiServiceTest, AnAnswerWakesWhoeverPolls) {
  ASSERT_TRUE(turn_until_ready());
  const auto wakes = [this](int timeout_ms) {
    pollfd awaited{wake_up_.descriptor(), POLLIN, 0};
    return poll(&awaited, 1, timeout_ms) == 1;
  };
  EXPECT_FALSE(wakes(0));
  dut().call(ask, {}, [](const QiResult&) {});
  EXPECT_FALSE(wakes(0));
  fake_.serve();
  EXPECT_TRUE(wakes(10'000));
  dut().serve(now_us_);
  EXPECT_FALSE(wakes(0));
  wake_up_.at(1);  // long past
  EXPECT_TRUE(wakes(10'000));
}

TEST_F(QiServiceTest, NobodyThereIsAFault) {
  const Endpoint nobody{0x7f000001, 1};  // port 1: nothing listens there
  dut_.emplace(wake_up_, QiRobot{nobody, "", ""}, "ALMotion", methods);
  EXPECT_TRUE(turn_until_fault("Connection refused")) << dut().fault();
  EXPECT_THAT(dut().fault(), HasSubstr("ALMotion at 127.0.0.1:1"));
}

TEST_F(QiServiceTest, WhoSpeaksAnotherLanguageIsLeft) {
  fake_.answers = false;
  turn_until([this] { return fake_.connections > 0; });
  const std::string http = "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n";
  fake_.send_to_all({reinterpret_cast<const std::uint8_t*>(http.data()), http.size()});
  EXPECT_TRUE(turn_until_fault("no qi messaging"));
}

TEST_F(QiServiceTest, EveryCallIsAnsweredOnceWhenTheConnectionIsLost) {
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
}  // namespace gazed::service_test
