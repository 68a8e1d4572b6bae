// gazed as a service manager starts it, and what it says when something is missing.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include "tests/integration/program.hpp"
#include "tests/integration/report_tests.hpp"
#include "tests/network_namespace.hpp"
#include "tests/notify_receiver.hpp"

namespace gazed::integration {
namespace {

using namespace std::chrono_literals;
using test::NotifyReceiver;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Clock = std::chrono::steady_clock;

// What a starting gazed may take: under an emulator, with sanitizers, beside other work.
constexpr auto patience = 120s;
constexpr double fault_repeat_s = 10.0;  // a fault that lasts is published again after this long

// As the service manager sets them, for programs started from here.
class Environment {
 public:
  Environment(const std::string& notify_socket, const std::string& watchdog_usec) {
    setenv("NOTIFY_SOCKET", notify_socket.c_str(), 1);
    setenv("WATCHDOG_USEC", watchdog_usec.c_str(), 1);
  }
  ~Environment() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

using Datagrams = std::vector<std::string>;

// Collects until `enough`.
template <class Condition>
Datagrams collect_until(const NotifyReceiver& receiver, Condition enough) {
  Datagrams all;
  const Clock::time_point end = Clock::now() + patience;
  while (!enough(all) && Clock::now() < end) {
    for (std::string& datagram : receiver.received()) {
      all.push_back(std::move(datagram));
      if (enough(all)) return all;
    }
    std::this_thread::sleep_for(5ms);
  }
  return all;
}

// Collects until a datagram holds `text`.
Datagrams collect(const NotifyReceiver& receiver, const std::string& text) {
  return collect_until(receiver, [&](const Datagrams& all) {
    return !all.empty() && all.back().find(text) != std::string::npos;
  });
}

std::string socket_path() {
  return temporary_file("notify");
}

std::vector<std::string> gazed_with(std::vector<std::string> options) {
  options.insert(options.begin(), {GAZED_PROGRAM, "--print", "json"});
  return options;
}

TEST(Service, WithoutCameraAndHeadItIsReadySaysSoAndStaysAlive) {
  const NotifyReceiver receiver(socket_path());
  ASSERT_TRUE(receiver.bound());
  const Environment environment(socket_path(), "1000000");
  RunningProgram running(gazed_with({"--lcm-url", "memq://", "--camera", "lcm", "--head", "lcm"}));
  const Clock::time_point started = Clock::now();
  const auto start = collect(receiver, "STATUS=");
  ASSERT_EQ(start.size(), 2U);
  EXPECT_EQ(start[0], "READY=1\n");
  EXPECT_EQ(start[1],
            "STATUS=no camera: no frame comes from lcm; no head: no state comes from lcm; "
            "0 points, 0 located\n");
  // Until after the camera's timeout of 2 s the fault is published.
  const auto later = collect_until(receiver, [&](const Datagrams& all) {
    return std::count(all.begin(), all.end(), "WATCHDOG=1\n") >= 4 &&
           running.prints("CAMERA_FAULT", 0.0);
  });
  EXPECT_GE(std::count(later.begin(), later.end(), "WATCHDOG=1\n"), 4);
  EXPECT_THAT(later, testing::Not(Contains(StartsWith("STATUS=")))) << "nothing has changed";
  running.send_signal(SIGTERM);
  EXPECT_THAT(collect(receiver, "STOPPING=1\n"), Contains("STOPPING=1\n"));
  const ProgramResult result = running.finish();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto points = points_in(result.out);
  ASSERT_GE(points.size(), 1U);
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - started).count();
  EXPECT_LE(static_cast<double>(points.size()), 1.0 + elapsed_s / fault_repeat_s);
  EXPECT_EQ(points[0]["status"], "CAMERA_FAULT");
}

// What does not turn feeds no watchdog: the loop does it, no thread or timer beside it.
TEST(Service, ALoopThatStandsStillFeedsNoWatchdog) {
  const NotifyReceiver receiver(socket_path());
  ASSERT_TRUE(receiver.bound());
  const Environment environment(socket_path(), "200000");
  RunningProgram running(gazed_with({"--lcm-url", "memq://", "--camera", "lcm", "--head", "lcm"}));
  EXPECT_THAT(collect(receiver, "WATCHDOG=1\n"), Contains("WATCHDOG=1\n"));
  running.stop();
  (void)receiver.received();  // what was sent before
  std::this_thread::sleep_for(400ms);
  EXPECT_THAT(receiver.received(), testing::IsEmpty());
  running.send_signal(SIGCONT);
  EXPECT_THAT(collect(receiver, "WATCHDOG=1\n"), Contains("WATCHDOG=1\n"));
  running.send_signal(SIGTERM);
  EXPECT_EQ(running.finish().exit_code, 0);
}

TEST(Service, TheStatusSaysWhatCameOfIt) {
  const std::string name = "@gazed_service_test_" + std::to_string(getpid());
  const NotifyReceiver receiver(name);
  ASSERT_TRUE(receiver.bound());
  const Environment environment(name, "10000000");
  RunningProgram running(gazed_with({"--lcm-url", "memq://"}));
  EXPECT_THAT(collect(receiver, " 1 located"),
              Contains(AllOf(StartsWith("STATUS=looking; "), HasSubstr(" 1 located"))));
  running.send_signal(SIGTERM);
  EXPECT_EQ(running.finish().exit_code, 0);
}

TEST(Service, VariablesThatCannotBeAreToldOnceAndHarmless) {
  const NotifyReceiver receiver(socket_path());
  const std::string too_long = "/" + std::string(200, 'x');
  for (const std::string& socket : {too_long, socket_path()}) {
    const Environment environment(socket, "abc");
    const ProgramResult result =
        run_program(gazed_with({"--lcm-url", "memq://", "--fixations", "1"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string name = socket == socket_path() ? "WATCHDOG_USEC: " : "NOTIFY_SOCKET: ";
    const auto first = result.err.find(name);
    EXPECT_NE(first, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find(name, first + 1), std::string::npos) << result.err;
  }
}

// systemd's network.target says little about routes: gazed that is started too early gets one
// later.
TEST(Service, ANetworkThatComesLate) {
  const std::string path = socket_path();
  const int result = test::in_empty_network([&path](test::Network& network) {
    const NotifyReceiver receiver(path);
    const Environment environment(path, "10000000");
    RunningProgram running(gazed_with({"--lcm-url", "udpm://239.255.76.67:7667?ttl=0"}));
    const std::string no_route =
        "no route: LCM cannot send to udpm://239.255.76.67:7667?ttl=0 (no network, or no "
        "multicast route)";
    const auto before = collect(receiver, no_route);
    test::require(!before.empty() && before.front() == "READY=1\n");
    test::require(before.back().find(no_route) != std::string::npos);
    test::require(network.set_loopback_up() && network.add_multicast_route());
    test::require(!collect(receiver, "STATUS=looking; ").empty());
    running.send_signal(SIGTERM);
    const ProgramResult ended = running.finish();
    test::require(ended.exit_code == 0);
    test::require(ended.err.find("ip route add 224.0.0.0/4 dev lo") != std::string::npos);
  });
  if (result == test::no_namespace)
    GTEST_SKIP() << "this needs the right to make a network namespace";
  EXPECT_EQ(result, test::passed);
}

class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST(Service, ARecordingThatHasNoRoomStopsAndLocatingGoesOn) {
  const std::string log = temporary_file("cut_short.lcm");
  ProgramResult limited;
  {
    const FileSizeLimit limit(3'000'000);  // less than five frames of 640x480 YUYV
    limited =
        run_program(gazed_with({"--lcm-url", "memq://", "--fixations", "1", "--record", log}));
  }
  EXPECT_EQ(limited.exit_code, 0) << limited.err;
  EXPECT_THAT(limited.err, HasSubstr(log + " has stopped: File too large; it holds "));
  const auto points = points_in(limited.out);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0]["status"], "LOCATED");
  // What it holds is whole: nothing is passed over when it is played.
  const ProgramResult played = run_program(
      gazed_with({"--lcm-url", "memq://", "--camera", "log:" + log, "--head", "log:" + log}));
  EXPECT_EQ(played.exit_code, 0) << played.err;
  EXPECT_THAT(played.err, testing::Not(HasSubstr("passed over")));
  // Two lines: what became of the few frames, and the sum.
  EXPECT_THAT(played.err, StartsWith("gazed: nothing was located: of "));
  EXPECT_EQ(std::count(played.err.begin(), played.err.end(), '\n'), 2) << played.err;
}

TEST(Service, AConfigurationThatCannotBeReadIsNamed) {
  const std::string folder = temporary_file("x").substr(0, temporary_file("x").size() - 2);
  const ProgramResult result = run_program({GAZED_PROGRAM, "--config", folder});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "gazed: " + folder + ": cannot be read: a folder; a regular file is needed\n");
}

}  // namespace
}  // namespace gazed::integration
