#include "programs/controller/loop_outlet.hpp"

#include "transport/state_cadence.hpp"

namespace levitas::controller_program {

LoopOutlet::LoopOutlet(session::Recorder& recorder, transport::Telemetry& telemetry,
                       std::int64_t period_ns) noexcept
    : recorder_(recorder),
      telemetry_(telemetry),
      state_every_(transport::CyclesPerState(period_ns)) {}

void LoopOutlet::Post(const cycle::CycleRecord& record) noexcept {
  recorder_.Post(record);
  cycle_.store(record.in.cycle, std::memory_order_relaxed);
  const bool tripped = record.out.fault != Fault::kNone && previous_fault_ == Fault::kNone;
  previous_fault_ = record.out.fault;
  if (tripped) {
    if (trips_.fetch_add(1, std::memory_order_relaxed) == 0) {
      first_fault_.store(record.out.fault, std::memory_order_relaxed);
    }
  }
  if (record.in.cycle % state_every_ != 0 && !tripped) return;
  telemetry_.PostState({.cycle = record.in.cycle,
                        .time_ns = record.in.frame.sample_time_ns,
                        .mode = record.out.mode,
                        .fault = record.out.fault,
                        .fault_axis = record.out.fault_axis,
                        .axes = record.in.frame.axes,
                        .position_m = record.in.frame.position_m,
                        .reference_m = record.out.reference_m,
                        .control_current_a = record.out.current.control_current_a,
                        .bias_current_a = record.out.current.bias_current_a,
                        .speed_rad_per_s = record.in.frame.speed_rad_per_s,
                        .records_lost = recorder_.lost()});
}

void LoopOutlet::Post(const loop::LoopStatistics& statistics) noexcept {
  telemetry_.PostTiming({.cycle = statistics.cycles,
                         .skipped_periods = statistics.skipped_periods,
                         .missing_frames = statistics.missing_frames,
                         .wakeup_p50_ns = statistics.wakeup.Percentile(0.5),
                         .wakeup_p99_ns = statistics.wakeup.Percentile(0.99),
                         .wakeup_p999_ns = statistics.wakeup.Percentile(0.999),
                         .wakeup_max_ns = static_cast<double>(statistics.wakeup.max_ns()),
                         .compute_p50_ns = statistics.compute.Percentile(0.5),
                         .compute_p99_ns = statistics.compute.Percentile(0.99),
                         .compute_max_ns = static_cast<double>(statistics.compute.max_ns()),
                         .latency_p50_ns = statistics.latency.Percentile(0.5),
                         .latency_p99_ns = statistics.latency.Percentile(0.99),
                         .slowest_stage = static_cast<std::int8_t>(statistics.last_blamed),
                         .wakeup = statistics.wakeup,
                         .compute = statistics.compute,
                         .latency = statistics.latency});
}

}  // namespace levitas::controller_program
