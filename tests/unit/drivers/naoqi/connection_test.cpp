#include "drivers/naoqi/connection.hpp"

#include <array>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <vector>

#include "tests/unit/drivers/naoqi/golden.hpp"
#include "tests/unit/drivers/naoqi/message_bytes.hpp"

namespace gazed::naoqi::connection_test {
namespace {

using ::testing::HasSubstr;

/// A connection, and the other end of its socket.
class QiConnectionTest : public testing::Test {
 protected:
  QiConnectionTest() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0);
    peer_ = base::FileDescriptor(ends[0]);
    dut_.emplace(wake_up_, base::FileDescriptor(ends[1]));
  }

  void send(QiBytes bytes) {
    ASSERT_EQ(write(peer_.get(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  /// As much as is there.
  std::string sent_by_dut() {
    std::string all(1 << 16, '\0');
    const ssize_t count = read(peer_.get(), all.data(), all.size());
    all.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return all;
  }

  base::FileDescriptor peer_{-1};
  WakeUp wake_up_;
  std::optional<QiConnection> dut_;
};

TEST_F(QiConnectionTest, ACallIsWhatTheOfficialClientSends) {
  QiWriter arguments;
  arguments.dynamic_list(std::vector<std::string_view>{"HeadYaw", "HeadPitch"}).integer(1, 1);
  dut_->send({.id = 10, .service = 2, .object = 1, .action = 100}, arguments.bytes());
  EXPECT_EQ(sent_by_dut(), from_hex(golden_get_angles_call));
}

TEST_F(QiConnectionTest, WhatTheSocketDoesNotTakeIsSentLaterAndInOrder) {
  const std::string payload(200'000, 'x');
  std::string expected, sent;
  for (std::uint32_t id = 1; id <= 3; ++id) {
    dut_->send({.id = id}, payload);
    expected += message_bytes({.id = id}, payload);
  }
  for (int i = 0; i < 1'000 && sent.size() < expected.size(); ++i) {
    EXPECT_FALSE(dut_->receive());
    sent += sent_by_dut();
  }
  EXPECT_TRUE(sent == expected);
  EXPECT_EQ(dut_->problem(), "");
}

TEST_F(QiConnectionTest, AHeaderIsReadAsItWasWritten) {
  const std::string bytes = from_hex(golden_get_angles_call);
  send(bytes);
  const auto message = dut_->receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.id, 10U);
  EXPECT_EQ(message->header.payload_bytes, bytes.size() - sizeof(QiHeader));
  EXPECT_EQ(message->header.type, QiType::call);
  EXPECT_EQ(message->header.flags, 0);
  EXPECT_EQ(message->header.service, 2U);
  EXPECT_EQ(message->header.object, 1U);
  EXPECT_EQ(message->header.action, 100U);
}

TEST_F(QiConnectionTest, MessagesComeOutHoweverTheyAreCut) {
  const std::string one = from_hex(golden_get_angles_call);
  std::string stream, payloads;
  for (int i = 0; i < 5; ++i) {
    stream += one + header_bytes({});  // and a message without a payload
    payloads += one.substr(sizeof(QiHeader));
  }
  for (const std::size_t piece : {1, 3, 27, 28, 29, 100, 1000}) {
    int messages = 0;
    std::string received;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      send(QiBytes(stream).substr(at, piece));
      while (const auto message = dut_->receive()) {
        received += message->payload;
        ++messages;
      }
    }
    EXPECT_EQ(messages, 10) << "in pieces of " << piece;
    EXPECT_EQ(received, payloads) << "in pieces of " << piece;
    EXPECT_EQ(dut_->problem(), "");
  }
}

TEST_F(QiConnectionTest, OneMessageIsReceivedAtATime) {
  EXPECT_FALSE(dut_->has_more());
  send(message_bytes({}, "one") + message_bytes({}, "two"));
  const auto one = dut_->receive();
  ASSERT_TRUE(one);
  EXPECT_TRUE(dut_->has_more());
  EXPECT_EQ(one->payload, "one");
  EXPECT_EQ(dut_->receive().value().payload, "two");
  EXPECT_FALSE(dut_->has_more());
  EXPECT_FALSE(dut_->receive());
}

TEST_F(QiConnectionTest, APartOfAMessageIsHeard) {
  EXPECT_TRUE(dut_->heard());  // opened
  EXPECT_FALSE(dut_->receive());
  EXPECT_FALSE(dut_->heard());
  send("B");
  EXPECT_FALSE(dut_->receive());
  EXPECT_TRUE(dut_->heard());
  EXPECT_FALSE(dut_->heard());
}

TEST_F(QiConnectionTest, TheLargestMessageIsWaitedFor) {
  const std::string part(1 << 14, 'x');
  send(header_bytes({.payload_bytes = qi_payload_max}));
  for (std::size_t sent = 0; sent < qi_payload_max; sent += part.size()) {
    EXPECT_FALSE(dut_->receive());
    send(part);
  }
  const auto message = dut_->receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->payload.size(), qi_payload_max);
}

TEST_F(QiConnectionTest, APayloadOverTheLimitIsRefused) {
  send(header_bytes({.payload_bytes = qi_payload_max + 1}));
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(dut_->receive());
    EXPECT_THAT(dut_->problem(), HasSubstr("no qi messaging"));
  }
}

TEST_F(QiConnectionTest, WhatIsNoMessageIsRefusedAsSoonAsItsHeaderIsThere) {
  std::string bytes = from_hex(golden_get_angles_call);
  bytes[2] = 0;
  send(bytes.substr(0, sizeof(QiHeader) - 1));
  EXPECT_FALSE(dut_->receive());
  EXPECT_EQ(dut_->problem(), "");
  send(bytes.substr(sizeof(QiHeader) - 1, 1));
  EXPECT_FALSE(dut_->receive());
  EXPECT_THAT(dut_->problem(), HasSubstr("no qi messaging"));
}

TEST_F(QiConnectionTest, APortForTlsAloneIsCalledSo) {
  const std::string alert("\x15\x03\x03\x00\x02\x02\x46", 7);
  send(alert);
  peer_ = base::FileDescriptor(-1);
  EXPECT_FALSE(dut_->receive());
  EXPECT_THAT(dut_->problem(), HasSubstr("tcps (TLS), which is not supported"));
}

TEST_F(QiConnectionTest, APortForTlsAloneThatReadsNothingIsCalledSoToo) {
  dut_->send({.id = 1}, "not TLS");
  peer_ = base::FileDescriptor(-1);  // with that unread, which resets the connection
  EXPECT_FALSE(dut_->receive());
  EXPECT_THAT(dut_->problem(), HasSubstr("tcps (TLS), which is not supported"));
}

TEST_F(QiConnectionTest, WhatCameBeforeTheEndIsReceivedFirst) {
  send(message_bytes({}, "last words"));
  peer_ = base::FileDescriptor(-1);
  EXPECT_EQ(dut_->receive().value().payload, "last words");
  EXPECT_EQ(dut_->problem(), "");
  EXPECT_FALSE(dut_->receive());
  EXPECT_EQ(dut_->problem(), "the robot closed the connection");
}

}  // namespace
}  // namespace gazed::naoqi::connection_test
