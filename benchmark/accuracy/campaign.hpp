#pragma once
// Measured data of a rig with hidden parameters: only the signals that a technician would record.
//
// Records    standing with a test signal in one axis after the other, spinning with it, running up.
//            Rows as the importer would give them (analysis/records/recorded_rows.hpp), in the
//            bearing frame; the plant of the loop is in it too, and only a CSV file has the rig's
//            wiring.
// Loop       plant and axis law alone, one period at a time, from a levitated start that is not
//            recorded.
// Failure    `stable` is false if the rotor approached its touchdown bearings or was lost,
//            oscillated at rest, or kept an axis at its current limit.
// Thread     any; no shared state.

#include <string>
#include <vector>

#include "benchmark/accuracy/unmodelled_disturbance.hpp"
#include "controller/law/law_config.hpp"
#include "diagnosis/model/model_run.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::accuracy {

/// Frames that never arrive: the controller does nothing, the rig holds its currents, and the row
/// is missing from the record or repeats the one before.
struct FrameLoss {
  double probability{};  ///< that a burst begins
  std::size_t burst{1};
  bool missing{true};
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

[[nodiscard]] Campaign Record(const plant::PlantParameters& truth, const law::LawConfig& law,
                              const CampaignPlan& plan, Unmodelled outside, double outside_size,
                              std::uint64_t outside_seed);

/// `folder`/<name>.csv of the contract in docs/formats.md, readings and commands as on the wires.
void WriteCsv(const std::vector<diagnosis::Record>& records, const RigNumbers& rig,
              const std::string& folder);

}  // namespace levitas::accuracy
