#pragma once
// Measured data of a rig with hidden parameters: only the signals that a technician would record.
//
// Records    standing with a test signal in one axis after the other, spinning with it, running up.
//            Rows as a session of `amb run` would hold them and the importer would give them
//            (diagnosis/records/load.hpp): bearing frame, frames counted from switching on, the
//            current that was commanded. Only a CSV file has the rig's wiring.
// Loop       the control cycle of `amb run` (simulated_rig.hpp), from off: lifted, brought to the
//            speed by the drive at its greatest rate, half a second of rest, and recorded from then
//            on. The test signal is the cycle's own injected current.
// Run-up     as fast as its time asks, if need be by a drive that is faster than the file's.
// Failure    `stable` is false if the supervisor trips or the rotor is not levitated by the
//            recording's start, approaches its touchdown bearings, oscillates at rest, or has an
//            axis at its current limit in more than a tenth of the rows.
// Thread     any; no shared state.

#include <string>
#include <vector>

#include "benchmark/accuracy/unmodelled_disturbance.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "diagnosis/model/model_run.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::accuracy {

/// Frames that never arrive while it is recorded: the cycle holds its currents, and its row has no
/// frame and the count of the one before, as in a session; or, as in the log of a rig that writes
/// one row a period, it is the row before with the next count.
struct FrameLoss {
  double probability{};  ///< that a burst begins
  std::size_t burst{1};
  bool missing{true};  ///< as in a session
  std::uint64_t seed{};
};

struct CampaignPlan {
  double spinning_rpm{3000.0};
  double runup_from_rpm{480.0}, runup_to_rpm{5880.0};
  double runup_s{2.0};
  double quiet_s{0.3};  ///< before the test signals begin
  double excitation_a{0.08};
  int bits_per_axis{2047};  ///< of two periods each
  double limit_m{120e-6};   ///< a reading beyond is not a healthy run
  double resting_m{60e-6};  ///< nor beyond this with a shaft at rest: the loop swings by itself
  std::uint64_t seed{1};    ///< of noise and test signal
  FrameLoss loss;
};

struct Campaign {
  std::vector<diagnosis::Record> records;  ///< "standing", "spinning", "runup"
  bool stable{true};
};

/// `truth` is the rig that is simulated, `controller` what `amb run` makes of the nominal one's
/// files; both have the same wiring and period.
[[nodiscard]] Campaign Record(const plant::PlantParameters& truth,
                              const cycle::CycleConfig& controller, const CampaignPlan& plan,
                              Unmodelled outside, double outside_size, std::uint64_t outside_seed);

/// Whether this controller lifts this rig from its touchdown bearings, and holds it.
[[nodiscard]] bool Lifts(const plant::PlantParameters& truth, const cycle::CycleConfig& controller,
                         std::uint64_t seed);

/// `folder`/<name>.csv of the contract in docs/formats.md, readings and commands as on the wires,
/// times from the record's first row on. A cycle without a frame has no row.
void WriteCsv(const std::vector<diagnosis::Record>& records, const RigNumbers& rig,
              const std::string& folder);

}  // namespace levitas::accuracy
