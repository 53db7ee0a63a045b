#pragma once
// What the couplings of a geared rig carried while it turned, from the gauges in its record.
//
// Torque   without the mean of the load (common/torsion_batch.hpp), gauge noise included.
// Judged   instants whose cycle is in the phase "spinning" (phase.hpp), against no limit.
// Units    SI. Thread: one; offline, allocates. Failure: none; a rig without gauges has no loads.

#include <cstdint>
#include <string>
#include <vector>

#include "common/torsion_batch.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "verdict/phase.hpp"

namespace levitas::verdict {

struct CouplingLoad {
  std::string coupling;  ///< "motor to pinion"
  double torque_rms_n_m{};
  double torque_peak_n_m{};  ///< largest magnitude
  double peak_time_s{};      ///< of the peak, since the first record
  double peak_speed_rad_per_s{};
  double twist_peak_rad{};  ///< largest magnitude
  std::uint64_t samples{};
};

class TorsionLoads {
 public:
  TorsionLoads(double standstill_rad_per_s, double settle_s, double period_s);

  /// Call once per record, in order.
  void Add(const cycle::CycleRecord& record);
  /// In the order of `couplings`; those of which nothing was measured while turning are left out.
  [[nodiscard]] std::vector<CouplingLoad> Of(const std::vector<TorsionBatch>& batches,
                                             const std::vector<std::string>& couplings) const;

 private:
  /// Consecutive instants of one rig session while it turned.
  struct Span {
    std::uint32_t rig_session{};
    std::uint64_t first{}, last{};  ///< SensorFrame::cycle
    double first_time_s{};
    std::vector<float> speed_rad_per_s;
  };

  void Count(const Span& span, std::uint64_t cycle, double torque_n_m, double twist_rad,
             CouplingLoad& load) const noexcept;
  [[nodiscard]] const Span* Find(std::uint32_t rig_session, std::uint64_t cycle) const noexcept;

  PhaseSplitter splitter_;
  double period_s_;
  std::vector<Span> spans_;
  std::uint64_t first_cycle_{};
  bool started_{false};
};

}  // namespace levitas::verdict
