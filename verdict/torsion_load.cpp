#include "verdict/torsion_load.hpp"

#include <algorithm>
#include <cmath>

#include "session/log/torsion_instants.hpp"

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

void TorsionLoads::Count(const Span& span, std::uint64_t cycle, double torque_n_m, double twist_rad,
                         CouplingLoad& load) const noexcept {
  load.torque_rms_n_m += torque_n_m * torque_n_m;  // a sum of squares until all are counted
  load.twist_peak_rad = std::max(load.twist_peak_rad, std::abs(twist_rad));
  ++load.samples;
  if (std::abs(torque_n_m) <= load.torque_peak_n_m) return;
  load.torque_peak_n_m = std::abs(torque_n_m);
  load.peak_time_s = span.first_time_s + static_cast<double>(cycle - span.first) * period_s_;
  load.peak_speed_rad_per_s = span.speed_rad_per_s[cycle - span.first];
}

std::vector<CouplingLoad> TorsionLoads::Of(const std::vector<TorsionBatch>& batches,
                                           const std::vector<std::string>& couplings) const {
  std::vector<CouplingLoad> loads;
  for (const std::string& name : couplings) loads.push_back({.coupling = name});
  session::ForEachInstant(
      batches, couplings.size(),
      [&](std::uint32_t rig_session, std::uint64_t cycle, auto torque_n_m, auto twist_rad) {
        const Span* span = Find(rig_session, cycle);
        if (span == nullptr) return;
        for (std::size_t c = 0; c < loads.size(); ++c) {
          Count(*span, cycle, torque_n_m[c], twist_rad[c], loads[c]);
        }
      });
  std::erase_if(loads, [](const CouplingLoad& load) { return load.samples == 0; });
  for (CouplingLoad& load : loads) {
    load.torque_rms_n_m = std::sqrt(load.torque_rms_n_m / static_cast<double>(load.samples));
  }
  return loads;
}

}  // namespace levitas::verdict
