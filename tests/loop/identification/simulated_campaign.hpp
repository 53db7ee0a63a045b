#pragma once
// An identification campaign on the simulated rig within one process: plant, cycle, PRBS on each
// axis in turn, as a record in memory. Noise, quantisation, nonlinear magnets, gravity and
// unbalance are on.

#include <vector>

#include "config/rig_file.hpp"
#include "identification/record/record.hpp"

namespace levitas::test {

struct CampaignPlan {
  std::vector<double> speeds_rpm{0.0};
  double amplitude_a{0.15};
  int order{12};
  std::uint32_t divisor{2};
  int periods{4};
  std::uint64_t seed{1};
};

[[nodiscard]] const config::RigFile& FlexibleRotor();

/// The commissioned controller levitates `rig`; the record holds the excited rows only.
[[nodiscard]] identification::Record SimulateCampaign(const config::RigFile& rig,
                                                      const CampaignPlan& plan);

}  // namespace levitas::test
