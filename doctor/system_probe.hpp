#pragma once
// The machine this program runs on, seen through its files and system calls.
//
// WakeUps    on a thread of its own, under SCHED_FIFO when permitted, sleeping to absolute times
//            of CLOCK_MONOTONIC; the grid is kept and periods missed are skipped.
// RoundTrips to 239.255.76.67 on the loopback interface, as the programs do with ttl 0, on a port
//            the system chooses: never disturbs a running rig.

#include "doctor/probe.hpp"

namespace levitas::doctor {

class SystemProbe final : public Probe {
 public:
  /// `root` is put before every path; empty for the real machine.
  explicit SystemProbe(std::string root = "") : root_(std::move(root)) {}

  [[nodiscard]] std::optional<std::string> ReadLine(const std::string& path) const override;
  [[nodiscard]] std::vector<std::string> ReadLines(const std::string& path) const override;
  [[nodiscard]] std::vector<std::string> List(const std::string& folder,
                                              const std::string& prefix) const override;
  [[nodiscard]] bool Exists(const std::string& path) const override;
  [[nodiscard]] bool ReadableAndWritable(const std::string& path) const override;
  [[nodiscard]] unsigned Cores() const override;
  [[nodiscard]] std::string KernelRelease() const override;
  [[nodiscard]] std::optional<std::uint64_t> FreeBytes(const std::string& path) const override;
  [[nodiscard]] Trial TakeFifo(int priority) const override;
  [[nodiscard]] Trial LockMemory(std::size_t bytes) const override;
  [[nodiscard]] Trial SetTimerSlack() const override;
  [[nodiscard]] Trial OpenCanSocket() const override;
  [[nodiscard]] WakeUpTrial WakeUps(std::int64_t period_ns,
                                    std::int64_t duration_ns) const override;
  [[nodiscard]] MulticastTrial RoundTrips(int count) const override;

 private:
  std::string root_;
};

}  // namespace levitas::doctor
