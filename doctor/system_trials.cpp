// The two trials of SystemProbe that take time: wake-ups, and multicast round trips.

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <thread>

#include "common/file_descriptor.hpp"
#include "common/histogram.hpp"
#include "doctor/system_probe.hpp"

namespace levitas::doctor {
namespace {

constexpr int kFifoPriority = 80;
constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr double kNsPerUs = 1000.0;
constexpr const char* kGroup = "239.255.76.67";
constexpr int kAnswerTimeoutMs = 50;

std::int64_t NowNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNsPerSecond + now.tv_nsec;
}

void SleepUntil(std::int64_t at_ns) {
  const timespec at{at_ns / kNsPerSecond, at_ns % kNsPerSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

WakeUpTrial MeasureWakeUps(std::int64_t period_ns, std::int64_t duration_ns) {
  WakeUpTrial trial;
  sched_param wanted{};
  wanted.sched_priority = kFifoPriority;
  trial.real_time = sched_setscheduler(0, SCHED_FIFO, &wanted) == 0;
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  Histogram late;
  const std::int64_t start_ns = NowNs();
  std::int64_t due_ns = start_ns + period_ns;
  while (due_ns < start_ns + duration_ns) {
    SleepUntil(due_ns);
    const std::int64_t late_ns = NowNs() - due_ns;
    late.Add(late_ns);
    ++trial.wake_ups;
    const std::int64_t missed = late_ns / period_ns;
    trial.skipped_periods += static_cast<std::uint64_t>(missed);
    due_ns += (missed + 1) * period_ns;
  }
  trial.p50_us = late.Percentile(0.5) / kNsPerUs;
  trial.p99_us = late.Percentile(0.99) / kNsPerUs;
  trial.max_us = static_cast<double>(late.max_ns()) / kNsPerUs;
  return trial;
}

FileDescriptor UdpSocket() { return FileDescriptor(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)); }

/// The interface that the programs use with ttl 0, as the socket options want it.
ip_mreqn Loopback() {
  ip_mreqn request{};
  request.imr_address.s_addr = htonl(INADDR_LOOPBACK);
  request.imr_ifindex = static_cast<int>(if_nametoindex("lo"));
  return request;
}

/// Binds the receiver to a free port of the group; the port is written to `group`. False: see
/// errno.
bool JoinGroup(const FileDescriptor& receiver, sockaddr_in& group) {
  group.sin_family = AF_INET;
  inet_pton(AF_INET, kGroup, &group.sin_addr);
  ip_mreqn request = Loopback();
  request.imr_multiaddr = group.sin_addr;
  socklen_t size = sizeof group;
  return bind(receiver.handle(), reinterpret_cast<sockaddr*>(&group), size) == 0 &&
         getsockname(receiver.handle(), reinterpret_cast<sockaddr*>(&group), &size) == 0 &&
         setsockopt(receiver.handle(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) ==
             0;
}

}  // namespace

WakeUpTrial SystemProbe::WakeUps(std::int64_t period_ns, std::int64_t duration_ns) const {
  WakeUpTrial trial;
  std::thread([&] { trial = MeasureWakeUps(period_ns, duration_ns); }).join();
  return trial;
}

MulticastTrial SystemProbe::RoundTrips(int count) const {
  MulticastTrial trial;
  const FileDescriptor receiver = UdpSocket();
  const FileDescriptor sender = UdpSocket();
  sockaddr_in group{};
  if (receiver.handle() < 0 || sender.handle() < 0 || !JoinGroup(receiver, group)) {
    trial.reason = std::strerror(errno);
    return trial;
  }
  const unsigned char ttl = 0;
  setsockopt(sender.handle(), IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  const ip_mreqn loopback = Loopback();
  setsockopt(sender.handle(), IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
  std::vector<double> times_us;
  for (int i = 0; i < count; ++i) {
    const std::int64_t sent_ns = NowNs();
    ++trial.sent;
    if (sendto(sender.handle(), &i, sizeof i, 0, reinterpret_cast<sockaddr*>(&group),
               sizeof group) != sizeof i) {
      trial.reason = std::strerror(errno);
      return trial;
    }
    pollfd waiting{receiver.handle(), POLLIN, 0};
    int echoed = -1;
    if (poll(&waiting, 1, kAnswerTimeoutMs) == 1 &&
        recv(receiver.handle(), &echoed, sizeof echoed, 0) == sizeof echoed && echoed == i) {
      ++trial.received;
      times_us.push_back(static_cast<double>(NowNs() - sent_ns) / kNsPerUs);
    } else if (trial.received == 0) {
      trial.reason = "no answer";
      return trial;
    }
  }
  if (!times_us.empty()) {
    const auto middle = times_us.begin() + static_cast<std::ptrdiff_t>(times_us.size() / 2);
    std::nth_element(times_us.begin(), middle, times_us.end());
    trial.median_us = *middle;
  }
  return trial;
}

}  // namespace levitas::doctor
