#pragma once
// The commissioning verdict: figures of a run held against the rig's objectives.
//
// Accepted     the scenario was completed, the rotor was levitated, and every requirement is met:
//              largest orbit standing and spinning below the rig's objectives, the same orbit in
//              zone A or B of the clearance, every graded sensitivity peak in zone A or B. Where
//              a peak was measured it counts instead of the one computed for that axis and speed.
//              A run whose amplifiers went off while the rotor turned is never accepted, whatever
//              its exit status and orbits were, nor one in which a probe jumped: its orbits are
//              those of the readings.
// Warned       measured and computed peak more than 20 % apart; a measured delay other than the
//              files have.
// Range        the speed up to which the run was shown, beside the rig's rated speed
//              (speed_range.hpp): what is accepted is accepted up to there.
// Requirement  a limit itself is not met: orbit must be below its objective.
// Not judged   torque of couplings, timing and saturation are reported; what they spoil shows in
//              the orbit or as a trip.
// Units        SI; names say which. Thread: any, offline.
// Failure      none: what was not run is "not run", not a pass (the sentence says so).

#include <optional>
#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "analysis/step_error.hpp"
#include "common/rig_numbers.hpp"
#include "verdict/block_use.hpp"
#include "verdict/measure_sensitivity.hpp"
#include "verdict/probe_jumps.hpp"
#include "verdict/reserve.hpp"
#include "verdict/session_statistics.hpp"
#include "verdict/speed_range.hpp"
#include "verdict/timing.hpp"
#include "verdict/torsion_load.hpp"
#include "verdict/zones.hpp"

namespace levitas::verdict {

enum class Outcome : std::uint8_t { kAccepted, kNotAccepted, kTripped, kIncomplete };
[[nodiscard]] std::string_view Name(Outcome outcome) noexcept;  ///< "accepted", "not_accepted" ...

/// Where the figures come from; all of it is written to the JSON.
struct Provenance {
  std::string program_version;
  std::string rig, controller, scenario;                 ///< names
  std::string rig_file, controller_file, scenario_file;  ///< paths, empty when unknown
  std::string session_file;                              ///< empty when it was not kept
  std::string trip_file;                                 ///< empty when nothing tripped
  std::string pace;
  std::string port;
  std::string machine;
  std::int64_t seed{};
  std::int64_t start_utc_ns{};
};

/// One orbit held against one objective.
struct OrbitJudgement {
  std::string bearing;
  bool spinning{};
  OrbitFigures orbit;
  double objective_m{};
  double clearance_share{};  ///< [1] largest radius over clearance
  Zone zone{};
  bool met{};
};

struct Inputs {
  RigNumbers rig;
  SessionFigures session;
  /// Computed at 0, at the top speed of the run, and at the worst speed between if it is worse.
  std::vector<analysis::SensitivityResult> sensitivity;
  std::size_t worst_sensitivity{};  ///< which of them is the worst
  /// Empty without a test signal in the record.
  std::optional<MeasuredSensitivity> measured;
  std::vector<double> probe_noise_m;              ///< rms, per bearing; empty: not known
  std::optional<LeastDamping> damping;            ///< of the model over the speeds of the run
  std::vector<ModeDamping> modes;                 ///< the same, mode by mode
  std::optional<analysis::StepError> step_error;  ///< of the simulation's time step
  std::optional<TimingFigures> timing;
  std::optional<RigFigures> rig_process;
  std::vector<BlockUse> blocks;  ///< of synchronous control
  std::vector<ProbeJump> probe_jumps;
  std::vector<CouplingLoad> torsion;        ///< of geared rigs whose couplings are measured
  std::vector<ProbeJump> broken_off_steps;  ///< of readings, see ProbeJumps::BrokenOff
  bool saves_bias{};                        ///< the controller may lower the bias
  Provenance provenance;
  std::string trip_text;          ///< the recorded sentence of the first trip, may be empty
  std::string incomplete_reason;  ///< why the scenario did not end by itself; empty: it did
  std::string damage;             ///< of the session file, empty when undamaged
};

struct Verdict {
  Inputs inputs;
  Outcome outcome{};
  std::string sentence;                 ///< "ACCEPTED up to 300 of 600 rpm: ...", one line
  std::vector<std::string> objections;  ///< one per requirement not met
  std::vector<std::string> warnings;    ///< sentences; none of them costs the acceptance
  std::vector<OrbitJudgement> orbits;   ///< bearing by bearing, phases that were run
  SpeedRange range;
};

[[nodiscard]] Verdict Judge(Inputs inputs);

}  // namespace levitas::verdict
