#pragma once
// The gauges of a simulated rig's couplings: samples with their noise, gathered to batches.
//
// Noise   white and normal, of its own seed: a rig moves the same with and without gauges.
// Batch   kTorsionSamples consecutive instants; a skipped instant ends it early. What is not full
//         when the run ends is lost.
// Thread  one, the loop's; all but construction allocate nothing, lock nothing, throw nothing.
// Failure std::invalid_argument for more than kMaxCouplings.

#include <vector>

#include "common/random.hpp"
#include "common/torsion_batch.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/shaft_loads.hpp"

namespace levitas::plant_run {

class TorsionGauge {
 public:
  TorsionGauge(const plant::PlantModel& model, std::uint64_t seed);
  /// False: the rig has no gauge, and nothing is to be done.
  [[nodiscard]] bool fitted() const noexcept { return !noise_.empty(); }
  /// Takes the plant's present instant. A batch that is now complete, else nullptr; it is valid
  /// until the next call.
  [[nodiscard]] const TorsionBatch* Sample(const plant::Plant& plant, std::uint64_t cycle,
                                           std::uint32_t rig_session) noexcept;

 private:
  void Begin(std::uint64_t cycle, std::uint32_t rig_session) noexcept;

  plant::ShaftLoads loads_;
  std::vector<rotor::TorsionGauges> noise_;  ///< of each coupling
  Random random_;
  TorsionBatch filling_{}, complete_{};
};

}  // namespace levitas::plant_run
