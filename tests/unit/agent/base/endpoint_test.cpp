#include "agent/base/endpoint.hpp"

#include <cstdint>
#include <gtest/gtest.h>

namespace gazed::base::endpoint_test {
namespace {

constexpr std::uint16_t default_port = 9559;

TEST(Endpoint, IsAnAddressAndAPort) {
  const Endpoint robot{0xc0a80105, 9559};
  EXPECT_EQ(parse_endpoint("192.168.1.5", default_port), robot);
  EXPECT_EQ(parse_endpoint("192.168.1.5:9559", 1), robot);
  EXPECT_EQ(to_string(robot), "192.168.1.5:9559");
  EXPECT_FALSE(robot.is_this_computer());
}

TEST(Endpoint, LocalhostIsThisComputer) {
  const auto local = parse_endpoint("localhost:65535", default_port);
  ASSERT_TRUE(local);
  EXPECT_EQ(to_string(*local), "127.0.0.1:65535");
  EXPECT_TRUE(local->is_this_computer());
}

TEST(Endpoint, NamesAndWhatIsNoneAreRefused) {
  for (const char* text : {"", ":", ":9559", "nao.local", "nao", "1.2.3", "1.2.3.4.5", "1.2.3.256",
                           "::1", "[::1]:9559", "1.2.3.4:", "1.2.3.4:0", "1.2.3.4:65536",
                           "1.2.3.4:-1", "1.2.3.4: 80", "1.2.3.4:80 ", " 1.2.3.4"})
    EXPECT_FALSE(parse_endpoint(text, default_port)) << text;
}

}  // namespace
}  // namespace gazed::base::endpoint_test
