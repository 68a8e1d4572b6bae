#include "drivers/naoqi/wake_up.hpp"

#include <algorithm>
#include <cerrno>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <system_error>

namespace gazed::naoqi {

WakeUp::WakeUp()
    : epoll_(epoll_create1(EPOLL_CLOEXEC)),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
  if (epoll_.get() < 0 || timer_.get() < 0)
    throw std::system_error(errno, std::generic_category(), "epoll and timerfd");
  watch(timer_.get(), false);
}

void WakeUp::watch(int socket, bool for_writing) {
  epoll_event event{};
  event.events = for_writing ? EPOLLIN | EPOLLOUT : EPOLLIN;
  if (epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, socket, &event) != 0)
    epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, socket, &event);
}

void WakeUp::at(std::int64_t monotonic_us) {
  const std::int64_t due_us = std::max<std::int64_t>(monotonic_us, 1);  // 0 would mean never
  itimerspec due{};
  due.it_value.tv_sec = static_cast<time_t>(due_us / 1'000'000);
  due.it_value.tv_nsec = static_cast<long>(due_us % 1'000'000 * 1000);
  timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &due, nullptr);
}

void await_answers(const WakeUp& wake_up, std::chrono::milliseconds longest,
                   const std::function<bool()>& serve) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + longest;
  while (!serve() && Clock::now() < end) {
    constexpr int look_again_ms = 10;
    pollfd awaited{wake_up.descriptor(), POLLIN, 0};
    poll(&awaited, 1, look_again_ms);
  }
}

}  // namespace gazed::naoqi
