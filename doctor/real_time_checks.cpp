#include <fmt/core.h>

#include "doctor/checks.hpp"

namespace levitas::doctor {
namespace {

constexpr Area kArea = Area::kRealTime;
constexpr int kLoopPriority = 80;
constexpr std::int64_t kPeriodNs = 100'000;
/// What the controller locks: its rings and the record of the last second, about 40 MB, with room.
constexpr std::size_t kLockedBytes = std::size_t{64} << 20U;
/// Half the period: computation and the rig's answer need the other half.
constexpr double kWakeUpP99Us = 50.0;
/// A trip follows several misses in a row; 1 in 1000 leaves that improbable.
constexpr double kSkippedShare = 0.001;
constexpr double kUnusableSkippedShare = 0.05;
/// The loop sleeps most of its period and spins the last 25 us: about a third of a core.
constexpr int kLeastRtRuntimeUs = 500'000;

Finding Kernel(const Probe& probe) {
  const std::string release = probe.KernelRelease();
  if (probe.ReadLine("/sys/kernel/realtime") == "1") {
    return {kArea, "kernel", State::kOk, fmt::format("{}, PREEMPT_RT", release), ""};
  }
  const std::string version = probe.ReadLine("/proc/version").value_or("");
  if (version.find("PREEMPT_RT") != std::string::npos) {
    return {kArea, "kernel", State::kOk, fmt::format("{}, PREEMPT_RT", release), ""};
  }
  const bool preemptible = version.find("PREEMPT") != std::string::npos;
  return {kArea, "kernel", State::kDegraded,
          fmt::format("{}, {}: the latest of a thousand wake-ups is tens of microseconds late",
                      release, preemptible ? "preemptible but not PREEMPT_RT" : "not preemptible"),
          "sudo apt-get install linux-image-rt-amd64, then restart into it"};
}

Finding Scheduler(const Probe& probe) {
  const Trial trial = probe.TakeFifo(kLoopPriority);
  if (trial.worked) {
    return {kArea, "scheduler", State::kOk,
            fmt::format("SCHED_FIFO priority {} is permitted", kLoopPriority), ""};
  }
  return {kArea, "scheduler", State::kMissing,
          fmt::format("SCHED_FIFO priority {} is refused: {}", kLoopPriority, trial.reason),
          "echo \"$USER - rtprio 90\" | sudo tee /etc/security/limits.d/levitas-rtprio.conf, "
          "then log in again; or run as root"};
}

Finding Memory(const Probe& probe) {
  const Trial trial = probe.LockMemory(kLockedBytes);
  if (trial.worked) {
    return {kArea, "memory lock", State::kOk,
            fmt::format("{} MB can be locked", kLockedBytes >> 20U), ""};
  }
  return {kArea, "memory lock", State::kMissing,
          fmt::format("{} MB cannot be locked: {}", kLockedBytes >> 20U, trial.reason),
          "echo \"$USER - memlock unlimited\" | sudo tee "
          "/etc/security/limits.d/levitas-memlock.conf, then log in again; or run as root"};
}

Finding Cores(const Probe& probe) {
  const unsigned cores = probe.Cores();
  if (cores >= 2) return {kArea, "cores", State::kOk, fmt::format("{}", cores), ""};
  return {kArea, "cores", State::kDegraded,
          "1: the loop shares it with recording and with the simulated rig",
          "give the machine a second core"};
}

Finding Governor(const Probe& probe) {
  const std::string folder = "/sys/devices/system/cpu";
  int visible = 0;
  std::string slow;
  for (const std::string& cpu : probe.List(folder, "cpu")) {
    const auto governor =
        probe.ReadLine(fmt::format("{}/{}/cpufreq/scaling_governor", folder, cpu));
    if (!governor) continue;
    ++visible;
    if (*governor != "performance") slow = *governor;
  }
  if (visible == 0) {
    return {kArea, "frequency", State::kOk, "no frequency scaling is visible here", ""};
  }
  if (slow.empty()) return {kArea, "frequency", State::kOk, "governor performance", ""};
  return {kArea, "frequency", State::kDegraded,
          fmt::format("governor {}: the clock is low when the loop wakes", slow),
          "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor"};
}

Finding IdleStates(const Probe& probe) {
  const std::string path = "/dev/cpu_dma_latency";
  if (probe.ReadableAndWritable(path)) {
    return {kArea, "idle states", State::kOk, "can be held shallow (/dev/cpu_dma_latency)", ""};
  }
  if (probe.Exists(path)) {
    return {kArea, "idle states", State::kDegraded, path + " may not be written by this user",
            "sudo chmod o+rw /dev/cpu_dma_latency (until the next start); or run as root"};
  }
  return {kArea, "idle states", State::kDegraded,
          path + " does not exist: cores may sleep deeply between two samples",
          "start the kernel with processor.max_cstate=1 intel_idle.max_cstate=0"};
}

Finding Throttling(const Probe& probe) {
  const auto text = probe.ReadLine("/proc/sys/kernel/sched_rt_runtime_us");
  if (!text) return {kArea, "throttling", State::kOk, "no limit is visible", ""};
  const int runtime_us = std::atoi(text->c_str());
  if (runtime_us < 0) return {kArea, "throttling", State::kOk, "off", ""};
  if (runtime_us >= kLeastRtRuntimeUs) {
    return {kArea, "throttling", State::kOk,
            fmt::format("real-time tasks may use {:.0f} ms of each second; the loop sleeps and "
                        "stays below",
                        runtime_us / 1000.0),
            ""};
  }
  return {kArea, "throttling", runtime_us == 0 ? State::kMissing : State::kDegraded,
          fmt::format("real-time tasks may use only {:.0f} ms of each second", runtime_us / 1000.0),
          "sudo sysctl -w kernel.sched_rt_runtime_us=950000"};
}

Finding TimerSlack(const Probe& probe) {
  const Trial trial = probe.SetTimerSlack();
  if (trial.worked) return {kArea, "timer slack", State::kOk, "can be set to 1 ns", ""};
  return {
      kArea, "timer slack", State::kDegraded,
      fmt::format("cannot be set ({}): without SCHED_FIFO a wake-up is 50 us late", trial.reason),
      "run outside the sandbox that refuses prctl"};
}

Finding WakeUps(const Probe& probe) {
  const WakeUpTrial trial = probe.WakeUps(kPeriodNs, kWakeUpTrialNs);
  const double all = static_cast<double>(trial.wake_ups + trial.skipped_periods);
  const double share = all > 0.0 ? static_cast<double>(trial.skipped_periods) / all : 1.0;
  const std::string found = fmt::format(
      "{} at 10 kHz{}: late by {:.1f} us (median), {:.1f} us (99 %), {:.0f} us (worst); {} periods "
      "skipped",
      trial.wake_ups, trial.real_time ? "" : " without SCHED_FIFO", trial.p50_us, trial.p99_us,
      trial.max_us, trial.skipped_periods);
  if (share > kUnusableSkippedShare) {
    return {kArea, "wake-ups", State::kMissing, found,
            "stop other load, or use a machine that is not shared"};
  }
  if (trial.p99_us > kWakeUpP99Us || share > kSkippedShare || !trial.real_time) {
    return {kArea, "wake-ups", State::kDegraded, found,
            trial.real_time ? "stop other load; then the remedies above"
                            : "permit SCHED_FIFO (see scheduler)"};
  }
  return {kArea, "wake-ups", State::kOk, found, ""};
}

}  // namespace

std::vector<Finding> CheckRealTime(const Probe& probe) {
  return {Kernel(probe),     Scheduler(probe),  Memory(probe),     Cores(probe),  Governor(probe),
          IdleStates(probe), Throttling(probe), TimerSlack(probe), WakeUps(probe)};
}

}  // namespace levitas::doctor
