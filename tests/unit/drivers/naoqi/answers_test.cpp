// What a robot answers before its services can be used.

#include <cstdint>
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>

#include "drivers/naoqi/service.hpp"

namespace gazed::naoqi::answers_test {
namespace {

constexpr std::uint16_t port = 9559;
constexpr base::Endpoint loopback{0x7f000001, port}, cable{0xa9fe0105, port},
    wireless{0xc0a80105, port};

/// The address chosen out of those; empty when there is none.
std::string choice(std::initializer_list<std::string_view> urls, const base::Endpoint& reached) {
  QiWriter info;
  info.text("ALMotion").u32(7).text("machine").u32(1).u32(static_cast<std::uint32_t>(urls.size()));
  for (const std::string_view url : urls) info.text(url);
  info.text("session");
  const QiValue answer = QiReader(info.bytes(), qi_service.returns).next();
  if (!answer) return "not understood";
  const auto place = address_in(answer, reached);
  return place ? base::to_string(*place) : "";
}

TEST(PlaceOfAService, IsTheAddressThatWasReachedWhateverItsPort) {
  const auto robots = {std::string_view("tcp://127.0.0.1:33000"),
                       std::string_view("tcp://169.254.1.5:33000"),
                       std::string_view("tcp://192.168.1.5:33000")};
  EXPECT_EQ(choice(robots, loopback), "127.0.0.1:33000");
  EXPECT_EQ(choice(robots, cable), "169.254.1.5:33000");
  EXPECT_EQ(choice(robots, wireless), "192.168.1.5:33000");
}

TEST(PlaceOfAService, IsNotAnotherComputersLoopback) {
  EXPECT_EQ(choice({"tcp://127.0.0.1:9559"}, wireless), "");
  EXPECT_EQ(choice({"tcp://127.0.0.1:9559", "tcp://169.254.1.5:9559"}, wireless),
            "169.254.1.5:9559");
  EXPECT_EQ(choice({"tcp://169.254.1.5:9559"}, loopback), "169.254.1.5:9559");
}

TEST(PlaceOfAService, IsNothingButPlainTcp) {
  EXPECT_EQ(choice({}, loopback), "");
  EXPECT_EQ(choice({"", "qi:ALMotion", "tcps://127.0.0.1:9559", "tcp://", "tcp://nao.local:9559"},
                   loopback),
            "");
}

bool is_done(std::string_view key, std::string_view signature, std::uint32_t state) {
  QiWriter map;
  map.u32(1).text(key).text(signature).u32(state);
  return authentication_is_done(QiReader(map.bytes(), qi_authenticate.returns).next());
}

TEST(Authentication, IsDoneInStateThreeOfEitherType) {
  EXPECT_TRUE(is_done("__qi_auth_state", "I", 3));
  EXPECT_TRUE(is_done("__qi_auth_state", "i", 3));
  EXPECT_FALSE(is_done("__qi_auth_state", "I", 1));
  EXPECT_FALSE(is_done("__qi_auth_state", "I", 2));
  EXPECT_FALSE(is_done("something else", "I", 3));
  EXPECT_FALSE(authentication_is_done({}));
}

TEST(Methods, AreNotFoundInAnObjectThatEndsEarly) {
  QiWriter object;
  object.u32(1).u32(100).u32(100).text("v").text("ask").text("()").text("").u32(0).text("");
  constexpr QiMethod method{"ask", "()"};
  const QiBytes whole = object.bytes();
  const auto found = find_method(QiReader(whole, qi_methods.returns).next(), method);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->action, 100U);
  EXPECT_EQ(found->returns, "v");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(find_method(QiReader(whole.substr(0, size), qi_methods.returns).next(), method));
}

}  // namespace
}  // namespace gazed::naoqi::answers_test
