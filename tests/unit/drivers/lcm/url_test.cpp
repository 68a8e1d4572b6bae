#include "drivers/lcm/url.hpp"

#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace gazed::lcm::url_test {
namespace {

using ::testing::HasSubstr;

class EffectiveUrl : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("LCM_DEFAULT_URL"); }
  void TearDown() override { unsetenv("LCM_DEFAULT_URL"); }
};

TEST_F(EffectiveUrl, StaysOnThisMachineByDefault) {
  EXPECT_EQ(effective_lcm_url("", false), "udpm://239.255.76.67:7667?ttl=0");
}

TEST_F(EffectiveUrl, EnvironmentBeforeDefault) {
  setenv("LCM_DEFAULT_URL", "udpm://239.255.76.68:7700?ttl=1", 1);
  EXPECT_EQ(effective_lcm_url("", false), "udpm://239.255.76.68:7700?ttl=1");
}

TEST_F(EffectiveUrl, EmptyEnvironmentIsNone) {
  setenv("LCM_DEFAULT_URL", "", 1);
  EXPECT_EQ(effective_lcm_url("", false), "udpm://239.255.76.67:7667?ttl=0");
}

TEST_F(EffectiveUrl, ConfigurationBeforeEnvironment) {
  setenv("LCM_DEFAULT_URL", "udpm://239.255.76.68:7700?ttl=1", 1);
  EXPECT_EQ(effective_lcm_url("memq://", false), "memq://");
}

TEST_F(EffectiveUrl, ImagesAskForAReceiveBuffer) {
  EXPECT_EQ(effective_lcm_url("", true), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4000000");
  EXPECT_EQ(effective_lcm_url("udpm://239.1.1.1:80", true),
            "udpm://239.1.1.1:80?recv_buf_size=4000000");
  EXPECT_EQ(effective_lcm_url("udpm://", true), "udpm://?recv_buf_size=4000000");
}

TEST_F(EffectiveUrl, OwnReceiveBufferIsKept) {
  const std::string own = "udpm://239.255.76.67:7667?recv_buf_size=100000&ttl=1";
  EXPECT_EQ(effective_lcm_url(own, true), own);
}

TEST_F(EffectiveUrl, OtherProvidersHaveNoReceiveBuffer) {
  EXPECT_EQ(effective_lcm_url("memq://", true), "memq://");
}

/// What a URL is refused with.
std::string refusal(const std::string& url) {
  try {
    return "accepted: " + effective_lcm_url(url, false);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST_F(EffectiveUrl, WhatCannotBeIsRefusedWithWhatCan) {
  EXPECT_THAT(refusal("udp://239.255.76.67:7667"),
              HasSubstr("provider \"udp\" found; allowed: udpm"));
  EXPECT_THAT(refusal("239.255.76.67:7667"), HasSubstr("provider \"239.255.76.67:7667\" found"));
  EXPECT_THAT(refusal("udpm://127.0.0.1:7667"), HasSubstr("address \"127.0.0.1\" found"));
  EXPECT_THAT(refusal("udpm://robot:7667"), HasSubstr("address \"robot\" found"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:"), HasSubstr("port \"\" found; allowed: 1 to 65535"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:70000"), HasSubstr("port \"70000\" found"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:76x?ttl=0"), HasSubstr("port \"76x\" found"));
}

// liblcm says a word about the first, without gazed's name, and takes the others for something
// else.
TEST_F(EffectiveUrl, OptionsThatCannotBeAreRefused) {
  EXPECT_THAT(refusal("udpm://239.255.76.67:7667?tll=1"),
              HasSubstr("option \"tll=1\" found; allowed: ttl=0 to 255, recv_buf_size=BYTES"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:7667?ttl=abc"),
              HasSubstr("ttl \"abc\" found; allowed: 0 to 255"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:7667?ttl=300"), HasSubstr("ttl \"300\" found"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:7667?ttl=1 "), HasSubstr("ttl \"1 \" found"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:7667?recv_buf_size=0"),
              HasSubstr("recv_buf_size \"0\" found"));
  EXPECT_THAT(refusal("udpm://239.255.76.67:7667?ttl=1&&recv_buf_size=5"),
              HasSubstr("option \"\" found"));
}

TEST(UdpmUrl, IsTakenApart) {
  const auto url = parse_udpm_url("udpm://239.1.2.3:80?recv_buf_size=5000&ttl=2");
  ASSERT_TRUE(url);
  EXPECT_EQ(ntohl(url->group.sin_addr.s_addr), 0xEF010203U);
  EXPECT_EQ(ntohs(url->group.sin_port), 80);
  EXPECT_EQ(url->ttl, 2);
  EXPECT_EQ(url->receive_buffer_bytes, 5000);
}

TEST(UdpmUrl, WhatIsLeftOutIsLcmsDefault) {
  const auto url = parse_udpm_url("udpm://");
  ASSERT_TRUE(url);
  EXPECT_EQ(ntohl(url->group.sin_addr.s_addr), 0xEFFF4C43U);  // 239.255.76.67
  EXPECT_EQ(ntohs(url->group.sin_port), 7667);
  EXPECT_EQ(url->ttl, 0);
  EXPECT_FALSE(url->receive_buffer_bytes);
  EXPECT_FALSE(parse_udpm_url("memq://"));
}

class ReceiveBufferWarning : public ::testing::Test {
 protected:
  std::string limit_file(const std::string& content) {
    // Its tests run at the same time, as processes of their own.
    const std::string path = ::testing::TempDir() + "gazed_rmem_max." + std::to_string(::getpid());
    std::ofstream(path) << content;
    return path;
  }
  const std::string url_ = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4000000";
};

TEST_F(ReceiveBufferWarning, NamesTheSysctl) {
  EXPECT_THAT(receive_buffer_warning(url_, limit_file("212992\n")),
              ::testing::AllOf(HasSubstr("at most 212992 bytes"),
                               HasSubstr("sysctl -w net.core.rmem_max=4000000")));
}

TEST_F(ReceiveBufferWarning, SilentWhenTheKernelGivesIt) {
  EXPECT_EQ(receive_buffer_warning(url_, limit_file("4000000\n")), "");
}

TEST_F(ReceiveBufferWarning, SilentWhenNothingIsAskedFor) {
  EXPECT_EQ(receive_buffer_warning("udpm://239.255.76.67:7667?ttl=0", limit_file("1\n")), "");
}

TEST_F(ReceiveBufferWarning, SilentWhereTheKernelDoesNotSay) {
  EXPECT_EQ(receive_buffer_warning(url_, "/nowhere/rmem_max"), "");
}

}  // namespace
}  // namespace gazed::lcm::url_test
