#include "rt/real_time.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

namespace levitas::rt {

namespace {

constexpr std::size_t kStackPrefault = 256 * 1024;
constexpr std::size_t kPage = 4096;

std::string Why(int error) { return std::strerror(error); }

// Touches the stack below the present frame once, so that no later call faults it in.
[[gnu::noinline]] void PrefaultStack() noexcept {
  std::array<volatile std::uint8_t, kStackPrefault> stack{};
  for (std::size_t at = 0; at < stack.size(); at += kPage) stack[at] = 1;
}

RealTimeFact LockMemory() {
  // A locked limit would make every later allocation fail, so it is lifted where we may.
  const rlimit unlimited{RLIM_INFINITY, RLIM_INFINITY};
  setrlimit(RLIMIT_MEMLOCK, &unlimited);
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    return {"locked memory", false,
            fmt::format("mlockall: {}; run as root, or raise memlock in /etc/security/limits.conf",
                        Why(errno))};
  }
  // Freed heap stays with the process: returning it would fault again on the next use.
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  return {"locked memory", true, "all pages, present and future"};
}

RealTimeFact SetFifo(int priority) {
  sched_param parameter{};
  parameter.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameter) != 0) {
    return {"SCHED_FIFO", false,
            fmt::format("sched_setscheduler: {}; run as root, or give the user rtprio {} in "
                        "/etc/security/limits.conf",
                        Why(errno), priority)};
  }
  return {"SCHED_FIFO", true, fmt::format("priority {}", priority)};
}

RealTimeFact SetTimerSlack() {
  if (prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) != 0) {
    return {"timer slack", false, fmt::format("prctl: {}", Why(errno))};
  }
  return {"timer slack", true, "1 ns"};
}

RealTimeFact PinTo(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  if (sched_setaffinity(0, sizeof(set), &set) != 0) {
    return {"processor", false, fmt::format("no processor {}: {}", processor, Why(errno))};
  }
  return {"processor", true, fmt::format("{} only", processor)};
}

}  // namespace

std::vector<RealTimeFact> EnterThread(const RealTimeOptions& options) {
  PrefaultStack();
  std::vector<RealTimeFact> facts;
  if (options.processor >= 0) facts.push_back(PinTo(options.processor));
  facts.push_back(SetTimerSlack());
  facts.push_back(SetFifo(options.priority));
  return facts;
}

RealTimeGuard::RealTimeGuard(const RealTimeOptions& options) {
  facts_.push_back(LockMemory());
  latency_file_ = open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC);
  const std::int32_t wanted_us = 0;
  if (latency_file_ >= 0 && write(latency_file_, &wanted_us, sizeof(wanted_us)) > 0) {
    facts_.push_back({"cpu_dma_latency", true, "0 us"});
  } else {
    facts_.push_back({"cpu_dma_latency", false,
                      fmt::format("/dev/cpu_dma_latency: {}; run as root, or keep the processor "
                                  "awake with the kernel option idle=poll",
                                  Why(errno))});
  }
  std::thread([&] {
    for (auto& fact : EnterThread(options)) facts_.push_back(std::move(fact));
  }).join();
}

RealTimeGuard::~RealTimeGuard() {
  if (latency_file_ >= 0) close(latency_file_);
}

bool RealTimeGuard::complete() const noexcept {
  return std::all_of(facts_.begin(), facts_.end(), [](const auto& fact) { return fact.granted; });
}

std::string Text(const std::vector<RealTimeFact>& facts) {
  std::string text;
  for (const auto& fact : facts) {
    text += fmt::format("{}{}: {}\n", fact.granted ? "" : "no ", fact.name, fact.detail);
  }
  return text;
}

std::string MachineText() {
  utsname name{};
  uname(&name);
  std::string processor = "unknown processor";
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      processor = line.substr(colon + 2);
      break;
    }
  }
  return fmt::format("{} {} {}, {} x {}", name.sysname, name.release, name.machine,
                     std::thread::hardware_concurrency(), processor);
}

}  // namespace levitas::rt
