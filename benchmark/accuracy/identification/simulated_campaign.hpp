#pragma once
// An identification campaign on the simulated rig within one process: plant, cycle, PRBS or
// another test signal on each axis in turn, as a record in memory. Noise, quantisation, nonlinear
// magnets, gravity and unbalance are on; flexible_rotor's commissioned controller levitates.
//
// Failure  std::runtime_error when the rig does not levitate. Thread any; no shared state.

#include <optional>
#include <vector>

#include "configuration/rig_file.hpp"
#include "controller/scenario/scenario_config.hpp"
#include "plant_sim/plant/plant_parameters.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::accuracy {

struct ExcitationPlan {
  std::vector<double> speeds_rpm{0.0};
  double amplitude_a{0.15};
  int order{12};
  std::uint32_t divisor{2};
  int periods{4};
  std::uint64_t seed{1};
  /// Instead of the PRBS: this signal, with its own amplitude, on each axis for `hold_s`.
  std::optional<scenario::Excitation> signal{};
  double hold_s{};
};

/// The record holds the excited rows only.
[[nodiscard]] session::Recording SimulateCampaign(const configuration::RigFile& rig,
                                                  const ExcitationPlan& plan);
/// `truth` is what is simulated; `rig` only gives channels and limits.
[[nodiscard]] session::Recording SimulateCampaign(const configuration::RigFile& rig,
                                                  const plant::PlantParameters& truth,
                                                  const ExcitationPlan& plan);

}  // namespace levitas::accuracy
