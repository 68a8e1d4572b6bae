// The camera's subscription: had once, given back at the end, and had anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/unit/drivers/naoqi/camera_rig.hpp"

namespace gazed::naoqi::subscription_test {
namespace {

using ::testing::ElementsAre;
using NaoqiSubscription = NaoqiCameraRig;

TEST_F(NaoqiSubscription, ItIsUnsubscribedAtTheEnd) {
  ASSERT_TRUE(turn_until_frame());
  unsubscribed_.clear();
  end();
  EXPECT_THAT(unsubscribed_, ElementsAre(handle_));
}

TEST_F(NaoqiSubscription, AnEndBeforeItIsSubscribedSubscribesNothing) {
  while (robot_.calls_of("unsubscribeAllInstances") == 0) {
    static_cast<void>(dut().next_frame());
    now_us_ += 1'000;
    robot_.serve();
  }
  end();
  EXPECT_EQ(robot_.calls_of("subscribeCamera"), 0);
}

TEST_F(NaoqiSubscription, AnEndWhileItIsSubscribedTakesItBack) {
  while (robot_.calls_of("subscribeCamera") == 0) {
    static_cast<void>(dut().next_frame());
    now_us_ += 1'000;
    robot_.serve();
  }
  unsubscribed_.clear();
  end();
  EXPECT_THAT(unsubscribed_, ElementsAre(handle_));
}

TEST_F(NaoqiSubscription, AConnectionThatIsLostAtTheEndIsWaitedFor) {
  ASSERT_TRUE(turn_until_frame());
  robot_.close_all();
  EXPECT_TRUE(turn_until_fault("ALVideoDevice at 127.0.0.1"));
  unsubscribed_.clear();
  end();
  EXPECT_THAT(unsubscribed_, ElementsAre(handle_));
}

TEST_F(NaoqiSubscription, WhatAnEarlierOneLeftIsUnsubscribedFirst) {
  ASSERT_TRUE(turn_until_frame());
  EXPECT_THAT(unsubscribed_, ElementsAre("all of " + name_));
}

TEST_F(NaoqiSubscription, WithoutTheMethodForItTheyAreUnsubscribedOneByOne) {
  ASSERT_TRUE(turn_until_frame());
  const std::string own = name_;
  end();
  unsubscribed_.clear();
  robot_.methods.pop_back();
  robot_.methods.push_back(
      {"getSubscribers", "()", "[s]", [own](QiReader) {
         FakeAnswer answer;
         answer.payload.u32(3).text(own + "_0").text("other_0").text(own + "_3");
         return answer;
       }});
  ASSERT_TRUE(turn_until_frame());
  EXPECT_THAT(unsubscribed_, ElementsAre(own + "_0", own + "_3"));
}

TEST_F(NaoqiSubscription, AVideoDeviceThatForgotUsIsSubscribedAnew) {
  ASSERT_TRUE(turn_until_frame());
  handle_ = "somebody else";
  EXPECT_TRUE(turn_until_fault("unknown handle"));
  EXPECT_TRUE(turn_until_frame());
}

TEST_F(NaoqiSubscription, ARobotThatComesBackIsSubscribedAnew) {
  ASSERT_TRUE(turn_until_frame());
  robot_.close_all();
  EXPECT_TRUE(turn_until_fault("ALVideoDevice at 127.0.0.1"));
  EXPECT_TRUE(turn_until_frame());
  EXPECT_EQ(robot_.calls_of("subscribeCamera"), 2);
}

}  // namespace
}  // namespace gazed::naoqi::subscription_test
