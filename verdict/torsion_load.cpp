#include "verdict/torsion_load.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::verdict {

TorsionLoads::TorsionLoads(double standstill_rad_per_s, double settle_s, double period_s)
    : splitter_(standstill_rad_per_s,
                static_cast<std::uint64_t>(std::llround(settle_s / period_s))),
      period_s_(period_s) {}

void TorsionLoads::Add(const cycle::CycleRecord& record) {
  if (!started_) first_cycle_ = record.in.cycle;
  started_ = true;
  const SensorFrame& frame = record.in.frame;
  const Phase phase = splitter_.Next(record.in.cycle, record.out.mode, frame.speed_rad_per_s);
  if (!record.in.frame_present || phase != Phase::kSpinning) return;
  const bool follows = !spans_.empty() && spans_.back().rig_session == frame.rig_session &&
                       spans_.back().last + 1 == frame.cycle;
  if (!follows) {
    const double time_s = static_cast<double>(record.in.cycle - first_cycle_) * period_s_;
    spans_.push_back({frame.rig_session, frame.cycle, frame.cycle, time_s, {}});
  }
  spans_.back().last = frame.cycle;
  spans_.back().speed_rad_per_s.push_back(static_cast<float>(frame.speed_rad_per_s));
}

const TorsionLoads::Span* TorsionLoads::Find(std::uint32_t rig_session,
                                             std::uint64_t cycle) const noexcept {
  for (const Span& span : spans_) {
    if (span.rig_session == rig_session && cycle >= span.first && cycle <= span.last) return &span;
  }
  return nullptr;
}

std::vector<CouplingLoad> TorsionLoads::Of(const std::vector<TorsionBatch>& batches,
                                           const std::vector<std::string>& couplings) const {
  std::vector<CouplingLoad> loads;
  for (const std::string& name : couplings) loads.push_back({.coupling = name});
  for (const TorsionBatch& batch : batches) {
    if (batch.couplings != couplings.size()) continue;
    for (std::uint32_t s = 0; s < batch.samples; ++s) {
      const std::uint64_t cycle = batch.first_cycle + s;
      const Span* span = Find(batch.rig_session, cycle);
      if (span == nullptr) continue;
      for (std::size_t c = 0; c < loads.size(); ++c) {
        CouplingLoad& load = loads[c];
        const double torque = batch.torque_n_m[s * loads.size() + c];
        load.torque_rms_n_m += torque * torque;
        load.twist_peak_rad =
            std::max(load.twist_peak_rad, std::abs(batch.twist_rad[s * loads.size() + c]));
        ++load.samples;
        if (std::abs(torque) <= load.torque_peak_n_m) continue;
        load.torque_peak_n_m = std::abs(torque);
        load.peak_time_s =
            span->first_time_s + static_cast<double>(cycle - span->first) * period_s_;
        load.peak_speed_rad_per_s = span->speed_rad_per_s[cycle - span->first];
      }
    }
  }
  std::erase_if(loads, [](const CouplingLoad& load) { return load.samples == 0; });
  for (CouplingLoad& load : loads) {
    load.torque_rms_n_m = std::sqrt(load.torque_rms_n_m / static_cast<double>(load.samples));
  }
  return loads;
}

}  // namespace levitas::verdict
