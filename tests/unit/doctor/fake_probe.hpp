#pragma once
// An invented machine for the checks: everything as it should be, until a test spoils one thing.

#include <algorithm>
#include <map>

#include "doctor/probe.hpp"

namespace levitas::doctor {

class FakeProbe : public Probe {
 public:
  FakeProbe() {
    files["/sys/kernel/realtime"] = {"1"};
    files["/proc/version"] = {"Linux version 6.1.0-rt SMP PREEMPT_RT"};
    files["/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor"] = {"performance"};
    files["/dev/cpu_dma_latency"] = {};
    files["/proc/sys/kernel/sched_rt_runtime_us"] = {"950000"};
    // Columns of the kernel: interface, destination, gateway, flags, counters, mask.
    files["/proc/net/route"] = {
        "Iface Destination Gateway Flags RefCnt Use Metric Mask MTU Window IRTT",
        "eth0 00000000 010200C0 0003 0 0 0 00000000 0 0 0",
        "lo 000000E0 00000000 0001 0 0 0 000000F0 0 0 0"};
    files["/proc/sys/net/core/rmem_max"] = {"4194304"};
    files["/sys/class/net/can0/type"] = {"280"};
    files["/sys/class/net/can0/mtu"] = {"72"};
    files["/dev/gpiochip0"] = {};
  }

  [[nodiscard]] std::optional<std::string> ReadLine(const std::string& path) const override {
    const auto found = files.find(path);
    if (found == files.end() || found->second.empty()) return std::nullopt;
    return found->second.front();
  }
  [[nodiscard]] std::vector<std::string> ReadLines(const std::string& path) const override {
    const auto found = files.find(path);
    return found == files.end() ? std::vector<std::string>{} : found->second;
  }
  [[nodiscard]] std::vector<std::string> List(const std::string& folder,
                                              const std::string& prefix) const override {
    std::vector<std::string> names;
    for (const auto& [path, lines] : files) {
      if (!path.starts_with(folder + "/" + prefix)) continue;
      const std::string rest = path.substr(folder.size() + 1);
      const std::string name = rest.substr(0, rest.find('/'));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
  }
  [[nodiscard]] bool Exists(const std::string& path) const override { return files.contains(path); }
  [[nodiscard]] bool ReadableAndWritable(const std::string& path) const override {
    return files.contains(path) && path != not_permitted;
  }
  [[nodiscard]] unsigned Cores() const override { return cores; }
  [[nodiscard]] std::string KernelRelease() const override { return "6.1.0-rt"; }
  [[nodiscard]] std::optional<std::uint64_t> FreeBytes(const std::string&) const override {
    return free_bytes;
  }
  [[nodiscard]] Trial TakeFifo(int) const override { return fifo; }
  [[nodiscard]] Trial LockMemory(std::size_t) const override { return memory; }
  [[nodiscard]] Trial SetTimerSlack() const override { return slack; }
  [[nodiscard]] Trial OpenCanSocket() const override { return can; }
  [[nodiscard]] WakeUpTrial WakeUps(std::int64_t, std::int64_t) const override { return wake_ups; }
  [[nodiscard]] MulticastTrial RoundTrips(int) const override { return multicast; }

  std::map<std::string, std::vector<std::string>> files;
  std::string not_permitted;
  unsigned cores{4};
  std::optional<std::uint64_t> free_bytes{100'000'000'000};
  Trial fifo{true, ""};
  Trial memory{true, ""};
  Trial slack{true, ""};
  Trial can{true, ""};
  WakeUpTrial wake_ups{true, 5000, 0, 5.0, 20.0, 60.0};
  MulticastTrial multicast{100, 100, 20.0, ""};
};

}  // namespace levitas::doctor
