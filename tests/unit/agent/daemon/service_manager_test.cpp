#include "agent/daemon/service_manager.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <string>
#include <unistd.h>

#include "tests/notify_receiver.hpp"

namespace gazed::daemon::service_manager_test {
namespace {

using namespace std::chrono_literals;
using test::NotifyReceiver;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Clock = ServiceManager::Clock;

constexpr int own_pid = 4711;

std::string own_path() {
  return (std::filesystem::temp_directory_path() / ("gazed_notify_" + std::to_string(getpid())))
      .string();
}

std::string own_abstract_name() {
  return "@gazed_notify_" + std::to_string(getpid());
}

// A socket's name of so many bytes.
std::string long_name(char first, std::size_t bytes) {
  std::string name(bytes, 'x');
  name[0] = first;
  return name;
}

TEST(ServiceManager, SaysWhatHappensOnAPathAndOnAnAbstractName) {
  for (const std::string& name : {own_path(), own_abstract_name()}) {
    const NotifyReceiver receiver(name);
    ASSERT_TRUE(receiver.bound()) << name;
    ServiceManager manager({name, {}, {}}, own_pid);
    EXPECT_THAT(manager.problems(), IsEmpty());
    EXPECT_THAT(receiver.received(), IsEmpty()) << "not ready before the first turn";
    manager.set_status("no camera");
    const Clock::time_point start;
    manager.turned(start);
    EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n", "STATUS=no camera\n"));
    manager.turned(start + 10s);
    EXPECT_THAT(receiver.received(), IsEmpty()) << "nothing has changed";
    manager.set_status("looking");
    manager.turned(start + 20s);
    EXPECT_THAT(receiver.received(), ElementsAre("STATUS=looking\n"));
    manager.stopping();
    EXPECT_THAT(receiver.received(), ElementsAre("STOPPING=1\n"));
  }
}

TEST(ServiceManager, WithoutAManagerNothingHappens) {
  ServiceManager manager({{}, "abc", "abc"}, own_pid);
  manager.set_status("looking");
  manager.turned();
  manager.stopping();
  EXPECT_THAT(manager.problems(), IsEmpty());
  EXPECT_EQ(manager.longest_wait(), Clock::duration::max());
}

TEST(ServiceManager, FeedsTheWatchdogAtLeastTwiceInItsTime) {
  const NotifyReceiver receiver(own_abstract_name());
  ServiceManager manager({own_abstract_name(), "2000000", std::to_string(own_pid)}, own_pid);
  EXPECT_EQ(manager.longest_wait(), 500ms);
  Clock::time_point now, fed;
  manager.turned(now);
  EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n", "WATCHDOG=1\n"));
  int times = 0;
  for (; now < Clock::time_point(20s); now += 100ms) {
    manager.turned(now);
    for (const std::string& line : receiver.received()) {
      EXPECT_EQ(line, "WATCHDOG=1\n");
      EXPECT_LE(now - fed, 1s);
      fed = now;
      ++times;
    }
  }
  EXPECT_GE(times, 20);
  EXPECT_LE(times, 40) << "and not at every turn";
}

TEST(ServiceManager, SomebodyElsesWatchdogIsNotFed) {
  const NotifyReceiver receiver(own_abstract_name());
  ServiceManager manager({own_abstract_name(), "2000000", std::to_string(own_pid + 1)}, own_pid);
  manager.turned();
  EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n"));
  EXPECT_THAT(manager.problems(), IsEmpty());
}

TEST(ServiceManager, AStatusThatChangesAllTheTimeIsSentOnceASecond) {
  const NotifyReceiver receiver(own_abstract_name());
  ServiceManager manager({own_abstract_name(), {}, {}}, own_pid);
  int i = 0;
  for (Clock::time_point now; now < Clock::time_point(10s); now += 10ms) {
    manager.set_status(std::to_string(++i));
    manager.turned(now);
  }
  EXPECT_EQ(receiver.received().size(), 1U + 10U);  // READY
}

TEST(ServiceManager, AStatusIsOneLineOfText) {
  const NotifyReceiver receiver(own_abstract_name());
  ServiceManager manager({own_abstract_name(), {}, {}}, own_pid);
  manager.set_status("no camera\nERRNO=5\x01\xff 12 \xc2\xb5s");
  manager.turned();
  EXPECT_THAT(receiver.received(),
              ElementsAre("READY=1\n", "STATUS=no camera?ERRNO=5?? 12 \xc2\xb5s\n"));
  manager.set_status(std::string(100'000, 'x'));
  manager.turned(Clock::now() + 10s);
  const auto received = receiver.received();
  ASSERT_EQ(received.size(), 1U);
  EXPECT_LT(received[0].size(), 4096U);
}

TEST(ServiceManager, AReceiverThatComesLateIsToldAll) {
  ServiceManager manager({own_path(), "2000000", {}}, own_pid);
  manager.set_status("looking");
  manager.turned(Clock::time_point(1s));
  {
    const NotifyReceiver receiver(own_path());
    manager.turned(Clock::time_point(2s));
    EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n", "STATUS=looking\n", "WATCHDOG=1\n"));
  }
  // It goes away, and another one comes under the same name.
  manager.turned(Clock::time_point(3s));
  const NotifyReceiver receiver(own_path());
  manager.turned(Clock::time_point(4s));
  EXPECT_THAT(receiver.received(), ElementsAre("WATCHDOG=1\n"));
}

TEST(ServiceManager, AFullQueueDoesNotBlockAndNothingIsForgotten) {
  const NotifyReceiver receiver(own_abstract_name());
  ServiceManager manager({own_abstract_name(), "4000", {}}, own_pid);
  Clock::time_point now;
  // Nobody reads: the kernel's queue (net.unix.max_dgram_qlen) holds few of these.
  for (int i = 0; i < 5000; ++i) manager.turned(now += 1ms);
  manager.set_status("after the flood");
  manager.turned(now += 1ms);
  EXPECT_THAT(receiver.received(), testing::Not(testing::Contains("STATUS=after the flood\n")));
  manager.turned(now += 1ms);
  EXPECT_THAT(receiver.received(), ElementsAre("STATUS=after the flood\n", "WATCHDOG=1\n"));
}

TEST(ServiceManager, SocketNamesThatCannotBe) {
  for (const std::string& name :
       {std::string(), std::string("/"), std::string("@"), std::string("notify"),
        std::string("vsock:2:1234"), long_name('/', 108), long_name('@', 109),
        std::string(100'000, '/')}) {
    ServiceManager manager({name, "2000000", {}}, own_pid);
    ASSERT_EQ(manager.problems().size(), 1U) << name;
    EXPECT_THAT(manager.problems()[0], HasSubstr("NOTIFY_SOCKET: \"" + name.substr(0, 80)));
    EXPECT_LT(manager.problems()[0].size(), 200U);
    manager.set_status("looking");
    manager.turned();
    manager.stopping();
    EXPECT_EQ(manager.longest_wait(), Clock::duration::max());
  }
}

TEST(ServiceManager, TheLongestSocketNames) {
  const std::string name = long_name('@', 108);
  const NotifyReceiver receiver(name);
  ASSERT_TRUE(receiver.bound());
  ServiceManager manager({name, {}, {}}, own_pid);
  EXPECT_THAT(manager.problems(), IsEmpty());
  manager.turned();
  EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n"));
}

TEST(ServiceManager, WatchdogTimesThatCannotBe) {
  const NotifyReceiver receiver(own_abstract_name());
  for (const std::string time : {"", "abc", "0", "-1", "1.5", "2000000 ", "+5", "0x10",
                                 "18446744073709551616", "99999999999999999999999999"}) {
    ServiceManager manager({own_abstract_name(), time, {}}, own_pid);
    ASSERT_EQ(manager.problems().size(), 1U) << time;
    EXPECT_THAT(manager.problems()[0], HasSubstr("WATCHDOG_USEC: \"" + time + "\" found"));
    manager.turned();
    EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n"));
  }
  ServiceManager manager({own_abstract_name(), "2000000", "me"}, own_pid);
  ASSERT_EQ(manager.problems().size(), 1U);
  EXPECT_THAT(manager.problems()[0], HasSubstr("WATCHDOG_PID: \"me\" found"));
  manager.turned();
  EXPECT_THAT(receiver.received(), ElementsAre("READY=1\n"));
}

TEST(ServiceManager, TheLongestAndTheShortestWatchdog) {
  EXPECT_EQ(
      ServiceManager({own_abstract_name(), "18446744073709551615", {}}, own_pid).longest_wait(),
      1h);
  EXPECT_EQ(ServiceManager({own_abstract_name(), "1", {}}, own_pid).longest_wait(), 1ms);
}

TEST(ServiceManager, AnyValuesAreHarmless) {
  std::mt19937_64 random(1);
  const auto value = [&random]() -> std::optional<std::string> {
    if (random() % 5 == 0) return std::nullopt;
    std::string bytes(random() % 150, '\0');
    for (char& byte : bytes) byte = static_cast<char>(1 + random() % 255);
    if (random() % 2 == 0) return "@gazed_nobody_" + bytes;
    return bytes;
  };
  for (int i = 0; i < 1000; ++i) {
    ServiceManager manager({value(), value(), value()}, own_pid);
    EXPECT_LE(manager.problems().size(), 2U);
    if (const auto status = value()) manager.set_status(*status);
    manager.turned();
    manager.stopping();
  }
}

}  // namespace
}  // namespace gazed::daemon::service_manager_test
