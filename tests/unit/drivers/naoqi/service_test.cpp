#include "drivers/naoqi/service.hpp"

#include <array>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <poll.h>
#include <vector>

#include "tests/unit/drivers/naoqi/message_bytes.hpp"
#include "tests/unit/drivers/naoqi/service_rig.hpp"

namespace gazed::naoqi::service_test {
namespace {

using ::testing::HasSubstr;

using QiServiceTest = QiServiceRig;

TEST_F(QiServiceTest, FindsItsServiceAndItsMethodsByNameAndParameters) {
  EXPECT_FALSE(dut().ready());
  ASSERT_TRUE(turn_until_ready()) << dut().fault();
  EXPECT_EQ(dut().fault(), "");
  EXPECT_TRUE(dut().has(ask));
  EXPECT_FALSE(dut().has(dance));
  EXPECT_EQ(fake_.connections, 1);
  std::array<double, 2> answer{};
  dut().call(ask, {}, [&](const QiResult& result) {
    ASSERT_TRUE(result.value);
    EXPECT_FALSE(result.value.element(2));
    answer = {result.value.element(0).number().value(), result.value.element(1).number().value()};
  });
  EXPECT_TRUE(turn_until([this] { return !dut().busy(); }));
  EXPECT_EQ(answer, (std::array{0.5, 0.25}));
  EXPECT_EQ(error_of_call(tell), "");
  EXPECT_EQ(error_of_call(dance), "no such method");
}

TEST_F(QiServiceTest, ADynamicPayloadIsWhatItSaysItIs) {
  fake_.methods[0].handler = [](QiReader) {
    FakeAnswer answer;
    answer.payload.dynamic_list(std::vector<float>{0.5F});
    answer.flags = qi_dynamic_payload;
    return answer;
  };
  ASSERT_TRUE(turn_until_ready());
  double answer = 0.0;
  dut().call(ask, {}, [&](const QiResult& result) {
    if (!result.value.element(1)) answer = result.value.element(0).number().value_or(0.0);
  });
  EXPECT_TRUE(turn_until([&] { return answer == 0.5; }));
}

TEST_F(QiServiceTest, AnotherPortOfTheSameRobotIsGoneTo) {
  FakeNaoqi other;
  other.methods = fake_.methods;
  fake_.places = {"tcp://192.168.1.5:9559", "tcp://" + base::to_string(other.endpoint())};
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
    fake_.send_to_all(header_bytes(header));
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

}  // namespace
}  // namespace gazed::naoqi::service_test
