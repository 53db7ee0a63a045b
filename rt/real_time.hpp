#pragma once
// Asks the kernel for what a periodic loop needs and states what it got.
//
// Asked     per process: memory locked and prefaulted, /dev/cpu_dma_latency held at 0 us so that
//           the processor leaves idle quickly. Per thread: SCHED_FIFO, timer slack 1 ns, stack
//           prefaulted, processor (only when asked for: beside a partner that spins, the
//           scheduler's own choice measured no worse).
// Failure   never throws. Each refusal is a fact with its remedy; the caller decides whether to go
//           on degraded (the default) or to stop (--require-realtime).
// Lifetime  the guard holds /dev/cpu_dma_latency open; the demand ends with it.

#include <string>
#include <vector>

namespace levitas::rt {

struct RealTimeFact {
  std::string name;    ///< "SCHED_FIFO"
  bool granted{};      ///< the kernel agreed
  std::string detail;  ///< "priority 80", or why not and what to do
};

struct RealTimeOptions {
  int priority{80};   ///< of SCHED_FIFO; kernel threads serving interrupts run at 50
  int processor{-1};  ///< pin the thread to it; -1 leaves the choice to the scheduler
};

/// Per-thread part, for the calling thread; returns what was granted.
std::vector<RealTimeFact> EnterThread(const RealTimeOptions& options);

class RealTimeGuard {
 public:
  /// Process-wide part; then tries the per-thread part in a thread of its own, so that the facts
  /// are known before the loop starts.
  explicit RealTimeGuard(const RealTimeOptions& options);
  ~RealTimeGuard();
  RealTimeGuard(const RealTimeGuard&) = delete;
  RealTimeGuard& operator=(const RealTimeGuard&) = delete;

  [[nodiscard]] const std::vector<RealTimeFact>& facts() const noexcept { return facts_; }
  [[nodiscard]] bool complete() const noexcept;

 private:
  std::vector<RealTimeFact> facts_;
  int latency_file_{-1};
};

/// One line per fact: "SCHED_FIFO: priority 80" or "no SCHED_FIFO: <why and remedy>".
[[nodiscard]] std::string Text(const std::vector<RealTimeFact>& facts);
/// Kernel, processor, count of processors, as one line.
[[nodiscard]] std::string MachineText();

}  // namespace levitas::rt
