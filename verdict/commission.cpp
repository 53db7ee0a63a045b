#include "verdict/commission.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "analysis/speed_sweep.hpp"
#include "configuration/rig_file.hpp"
#include "plant_sim/rotor/torsion_line.hpp"
#include "session/session_reader.hpp"

namespace levitas::verdict {
namespace {

std::string FirstTripText(const std::vector<session::Event>& events) {
  for (const session::Event& event : events) {
    if (event.severity == session::Event::Severity::kTrip) return event.text;
  }
  return {};
}

/// What the caller knows better (a path of the user's) stays.
void Complete(Provenance& provenance, const session::SessionHeader& header,
              const std::string& within, const RigNumbers& rig) {
  if (provenance.port.empty()) provenance.port = header.source;
  if (provenance.scenario.empty() && !header.scenario_yaml.empty()) {
    provenance.scenario = config::ParseScenario(header.scenario_yaml, within, rig).name;
  }
  provenance.program_version = header.program_version;
  provenance.pace = header.pace;
  provenance.machine = header.machine;
  provenance.seed = header.seed;
  provenance.start_utc_ns = header.start_utc_ns;
}

/// Why the record itself shows that the scenario did not end; empty when it does not.
std::string BreaksOff(const session::Damage& damage, const std::vector<ModeSpan>& modes) {
  if (damage.truncated) return "the record breaks off: " + damage.Text();
  if (modes.empty()) return {};
  const Mode last = modes.back().mode;
  if (last == Mode::kOff || last == Mode::kTripped) return {};
  return fmt::format("the record ends while {}", Name(last));
}

bool Any(const AxisArray& signal) {
  return std::any_of(signal.begin(), signal.end(), [](double value) { return value != 0.0; });
}

/// From rest to the highest speed of the run if it was spun.
analysis::SpeedSweep Sensitivities(const config::RigFile& rig,
                                   const config::ControllerFile& controller,
                                   double top_speed_rad_per_s) {
  const bool spun = top_speed_rad_per_s > controller.supervisor.sequence.standstill_rad_per_s;
  return analysis::SensitivityOverSpeed(rig.plant, controller.law,
                                        spun ? top_speed_rad_per_s : 0.0);
}

}  // namespace

Verdict Commission(const CommissionOptions& options) {
  session::SessionReader reader(options.session_path);
  const session::SessionHeader& header = reader.header();
  const std::string within = options.session_path + " (header)";
  const config::RigFile rig = config::ParseRig(header.rig_yaml, within);
  const config::ControllerFile controller =
      config::ParseController(header.controller_yaml, within, rig.numbers);
  SessionStatistics statistics(rig.numbers, controller.supervisor.sequence.standstill_rad_per_s,
                               kSettleAfterLiftS);
  ProbeJumps jumps(rig, controller.supervisor.sequence.standstill_rad_per_s, kSettleAfterLiftS);
  TorsionLoads torsion(controller.supervisor.sequence.standstill_rad_per_s, kSettleAfterLiftS,
                       rig.numbers.period_s());
  const std::vector<std::string> couplings = rotor::GaugedCouplings(rig.plant.shafts);
  if (!couplings.empty()) reader.KeepTorsion();
  cycle::CycleRecord record;
  bool excited = false;
  std::uint64_t first_cycle = 0;
  while (reader.Next(record)) {
    if (first_cycle == 0) first_cycle = record.in.cycle;
    statistics.Add(record);
    jumps.Add(record);
    if (!couplings.empty()) torsion.Add(record);
    excited = excited || Any(record.in.op.excitation_a) || Any(record.in.op.excitation_m);
  }

  Inputs inputs;
  inputs.rig = rig.numbers;
  inputs.session = statistics.Figures();
  inputs.probe_jumps = jumps.Found();
  inputs.torsion = torsion.Of(reader.torsion(), couplings);
  inputs.broken_off_steps = jumps.BrokenOff();
  analysis::SpeedSweep sweep = Sensitivities(rig, controller, inputs.session.top_speed_rad_per_s);
  inputs.sensitivity = std::move(sweep.speeds);
  inputs.worst_sensitivity = sweep.worst;
  if (excited) {
    inputs.measured =
        MeasureSensitivity(options.session_path, rig, controller.law, inputs.sensitivity);
  }
  inputs.damping = DampingOver(inputs.sensitivity, rig.plant, controller.law);
  inputs.modes = DampingOfModes(rig.plant, controller.law, inputs.session.top_speed_rad_per_s);
  inputs.probe_noise_m = ProbeNoise(rig.plant);
  inputs.step_error =
      analysis::MeasureStepError(rig.plant, controller.law, inputs.session.top_speed_rad_per_s);
  inputs.timing = ReadControllerReport(options.controller_report, rig.numbers.period_s());
  inputs.rig_process = ReadRigReport(options.plant_report);
  inputs.provenance = options.provenance;
  Complete(inputs.provenance, header, within, rig.numbers);
  inputs.provenance.rig = rig.numbers.name;
  inputs.provenance.controller = controller.name;
  if (inputs.timing) inputs.provenance.trip_file = inputs.timing->trip_file;
  std::vector<std::string> blocks;
  for (const auto& block : controller.synchronous.blocks) blocks.push_back(block.name);
  inputs.blocks =
      BlocksOf(reader.events(), first_cycle, record.in.cycle, rig.numbers.period_s(), blocks);
  inputs.saves_bias = !controller.bias.empty();
  inputs.trip_text = FirstTripText(reader.events());
  inputs.incomplete_reason = options.incomplete_reason.empty()
                                 ? BreaksOff(reader.damage(), inputs.session.modes)
                                 : options.incomplete_reason;
  inputs.damage = reader.damage().Text();
  return Judge(std::move(inputs));
}

}  // namespace levitas::verdict
