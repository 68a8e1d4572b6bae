#include "agent/daemon/process.hpp"

#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gazed::daemon::process_test {
namespace {

/// In a process of its own, which a signal may end and whose priority is its own.
template <class Test>
bool holds_in_child(const Test& test) {
  const pid_t child = fork();
  if (child == 0) _exit(test() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Root may, but not without CAP_SYS_NICE, as in containers; others by their limit.
bool may_leave_a_low_priority() {
  return holds_in_child(
      [] { return setpriority(PRIO_PROCESS, 0, 19) == 0 && setpriority(PRIO_PROCESS, 0, 0) == 0; });
}

TEST(EndSignals, AreReceivedOnce) {
  for (const int signal : {SIGTERM, SIGINT}) {
    EXPECT_TRUE(holds_in_child([signal] {
      EndSignals signals;
      if (signals.received()) return false;
      std::raise(signal);
      return signals.received() && !signals.received();
    })) << signal;
  }
}

TEST(EndSignals, DoWhatTheyDidBeforeOnceItIsGone) {
  EXPECT_TRUE(holds_in_child([] {
    std::signal(SIGINT, SIG_IGN);
    { const EndSignals signals; }
    struct sigaction interrupt {
    }, terminate{};
    sigaction(SIGINT, nullptr, &interrupt);
    sigaction(SIGTERM, nullptr, &terminate);
    return interrupt.sa_handler == SIG_IGN && terminate.sa_handler == SIG_DFL;
  }));
}

TEST(EndSignals, EndALowPriorityWhereTheyMay) {
  EXPECT_TRUE(holds_in_child([] {
    setpriority(PRIO_PROCESS, 0, 19);
    EndSignals signals;
    std::raise(SIGTERM);
    const int priority = getpriority(PRIO_PROCESS, 0);
    return signals.received() && (priority == 0 || !may_leave_a_low_priority());
  }));
}

TEST(EndSignals, AHighPriorityStays) {
  EXPECT_TRUE(holds_in_child([] {
    const bool raised = setpriority(PRIO_PROCESS, 0, -5) == 0;
    const int before = getpriority(PRIO_PROCESS, 0);
    EndSignals signals;
    std::raise(SIGTERM);
    return signals.received() && (!raised || getpriority(PRIO_PROCESS, 0) == before);
  }));
}

}  // namespace
}  // namespace gazed::daemon::process_test
