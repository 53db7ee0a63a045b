#pragma once
// Where the loop's records go: the session's recorder and, thinned out, telemetry.
//
// Thread   Post: loop thread, wait-free. The others: any thread.

#include <atomic>

#include "controller/loop/control_loop.hpp"
#include "session/log/recorder.hpp"
#include "transport/telemetry.hpp"

namespace levitas::controller_program {

class LoopOutlet final : public loop::RecordSink {
 public:
  LoopOutlet(session::Recorder& recorder, transport::Telemetry& telemetry,
             std::int64_t period_ns) noexcept;

  void Post(const cycle::CycleRecord& record) noexcept override;
  void PostTorsion(const TorsionBatch& batch) noexcept override { recorder_.PostTorsion(batch); }
  void Post(const loop::LoopStatistics& statistics) noexcept override;

  /// First fault that was latched since the start, kNone if there was none.
  [[nodiscard]] Fault first_fault() const noexcept {
    return first_fault_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t trips() const noexcept {
    return trips_.load(std::memory_order_relaxed);
  }
  /// Number of the newest cycle.
  [[nodiscard]] std::uint64_t cycle() const noexcept {
    return cycle_.load(std::memory_order_relaxed);
  }

 private:
  session::Recorder& recorder_;
  transport::Telemetry& telemetry_;
  std::uint64_t state_every_;
  Fault previous_fault_{Fault::kNone};
  std::atomic<Fault> first_fault_{Fault::kNone};
  std::atomic<std::uint64_t> trips_{0};
  std::atomic<std::uint64_t> cycle_{0};
};

}  // namespace levitas::controller_program
