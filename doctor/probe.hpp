#pragma once
// How the checks look at a machine: files of /proc, /sys and /dev, and a few trials. An interface,
// so that tests put an invented machine in its place.
//
// Thread   any one thread; WakeUps and RoundTrips block for as long as the trial takes.
// Failure  never throws: what cannot be read or tried is a value.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace levitas::doctor {

/// Result of something that either works or fails with a reason of the system.
struct Trial {
  bool worked{};
  std::string reason;  ///< e.g. "Operation not permitted"; empty when it worked
};

/// Wake-ups on an absolute grid. Late by a period or more: the periods missed are skipped.
struct WakeUpTrial {
  bool real_time{};  ///< under SCHED_FIFO
  std::uint64_t wake_ups{};
  std::uint64_t skipped_periods{};
  double p50_us{};
  double p99_us{};
  double max_us{};
};

/// Messages sent to a multicast group and received on the same machine.
struct MulticastTrial {
  int sent{};
  int received{};
  double median_us{};
  std::string reason;  ///< of the first failure
};

class Probe {
 public:
  virtual ~Probe() = default;
  /// First line of a file, without the line end.
  [[nodiscard]] virtual std::optional<std::string> ReadLine(const std::string& path) const = 0;
  /// All lines; empty when there is no such file.
  [[nodiscard]] virtual std::vector<std::string> ReadLines(const std::string& path) const = 0;
  /// Names in a folder that begin with `prefix`, sorted.
  [[nodiscard]] virtual std::vector<std::string> List(const std::string& folder,
                                                      const std::string& prefix) const = 0;
  [[nodiscard]] virtual bool Exists(const std::string& path) const = 0;
  [[nodiscard]] virtual bool ReadableAndWritable(const std::string& path) const = 0;

  [[nodiscard]] virtual unsigned Cores() const = 0;
  [[nodiscard]] virtual std::string KernelRelease() const = 0;
  [[nodiscard]] virtual std::optional<std::uint64_t> FreeBytes(const std::string& path) const = 0;
  /// Takes SCHED_FIFO at this priority and gives it back.
  [[nodiscard]] virtual Trial TakeFifo(int priority) const = 0;
  /// Locks this much memory and unlocks it.
  [[nodiscard]] virtual Trial LockMemory(std::size_t bytes) const = 0;
  /// Asks for the finest timer slack and gives the old one back.
  [[nodiscard]] virtual Trial SetTimerSlack() const = 0;
  [[nodiscard]] virtual Trial OpenCanSocket() const = 0;
  [[nodiscard]] virtual WakeUpTrial WakeUps(std::int64_t period_ns,
                                            std::int64_t duration_ns) const = 0;
  [[nodiscard]] virtual MulticastTrial RoundTrips(int count) const = 0;
};

}  // namespace levitas::doctor
