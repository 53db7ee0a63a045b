#include "verdict/commission.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "analysis/speed_sweep.hpp"
#include "configuration/rig_file.hpp"
#include "plant_sim/rotor/torsion_line.hpp"
#include "session/exchange/recording_builder.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::verdict {
namespace {

std::string FirstTripText(const std::vector<session::Event>& events) {
  for (const session::Event& event : events) {
    if (event.severity == session::Event::Severity::kTrip) return event.text;
  }
  return {};
}

/// Port and scenario stay where the caller knows them; the rest is the header's.
void Complete(Provenance& provenance, const session::SessionHeader& header,
              const std::string& within, const RigNumbers& rig) {
  if (provenance.port.empty()) provenance.port = header.source;
  if (provenance.scenario.empty() && !header.scenario_yaml.empty()) {
    provenance.scenario = configuration::ParseScenario(header.scenario_yaml, within, rig).name;
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

bool HasSignal(const AxisArray& signal) {
  return std::any_of(signal.begin(), signal.end(), [](double value) { return value != 0.0; });
}

/// What a session is read for, gathered record by record in one pass.
class OnePass {
 public:
  OnePass(const std::string& name, const configuration::RigFile& rig, double standstill_rad_per_s)
      : statistics_(rig.numbers, standstill_rad_per_s, kSettleAfterLiftS),
        jumps_(rig, standstill_rad_per_s, kSettleAfterLiftS),
        torsion_(standstill_rad_per_s, kSettleAfterLiftS, rig.numbers.period_s()),
        couplings_(rotor::GaugedCouplings(rig.plant.shafts)),
        test_signals_(name, rig.numbers) {}

  void Read(session::SessionReader& reader) {
    if (!couplings_.empty()) reader.KeepTorsion();
    cycle::CycleRecord record;
    while (reader.Next(record)) Add(record);
    last_cycle_ = record.in.cycle;
  }

  [[nodiscard]] std::uint64_t first_cycle() const { return first_cycle_.value_or(0); }
  [[nodiscard]] std::uint64_t last_cycle() const { return last_cycle_; }
  /// The first record, then all from the first test signal on; empty where none was given.
  [[nodiscard]] std::optional<session::Recording> TakeTestSignals() {
    if (!excited_) return {};
    return test_signals_.Finish();
  }
  void Fill(const session::SessionReader& reader, Inputs& inputs) const {
    inputs.session = statistics_.Figures();
    inputs.probe_jumps = jumps_.Found();
    inputs.broken_off_steps = jumps_.BrokenOff();
    inputs.torsion = torsion_.Of(reader.torsion(), couplings_);
  }

 private:
  void Add(const cycle::CycleRecord& record) {
    statistics_.Add(record);
    jumps_.Add(record);
    if (!couplings_.empty()) torsion_.Add(record);
    excited_ =
        excited_ || HasSignal(record.in.op.excitation_a) || HasSignal(record.in.op.excitation_m);
    // The record's time counts from its first row.
    if (excited_ || !first_cycle_) test_signals_.Take(record);
    if (!first_cycle_) first_cycle_ = record.in.cycle;
  }

  SessionStatistics statistics_;
  ProbeJumps jumps_;
  TorsionLoads torsion_;
  std::vector<std::string> couplings_;
  session::RecordingBuilder test_signals_;
  bool excited_{false};
  std::optional<std::uint64_t> first_cycle_;
  std::uint64_t last_cycle_{};
};

/// From rest to the highest speed of the run if it was spun.
analysis::SpeedSweep Sensitivities(const configuration::RigFile& rig,
                                   const configuration::ControllerFile& controller,
                                   double top_speed_rad_per_s) {
  const bool spun = top_speed_rad_per_s > controller.supervisor.sequence.standstill_rad_per_s;
  return analysis::SensitivityOverSpeed(rig.plant, controller.law,
                                        spun ? top_speed_rad_per_s : 0.0);
}

std::vector<std::string> BlockNames(const configuration::ControllerFile& controller) {
  std::vector<std::string> names;
  for (const auto& block : controller.synchronous.blocks) names.push_back(block.name);
  return names;
}

}  // namespace

Verdict Commission(const CommissionOptions& options) {
  session::SessionReader reader(options.session_path);
  const session::SessionHeader& header = reader.header();
  const std::string within = options.session_path + " (header)";
  const configuration::RigFile rig = configuration::ParseRig(header.rig_yaml, within);
  const configuration::ControllerFile controller =
      configuration::ParseController(header.controller_yaml, within, rig.numbers);
  OnePass pass(options.session_path, rig, controller.supervisor.sequence.standstill_rad_per_s);
  pass.Read(reader);

  Inputs inputs;
  inputs.rig = rig.numbers;
  pass.Fill(reader, inputs);
  analysis::SpeedSweep sweep = Sensitivities(rig, controller, inputs.session.top_speed_rad_per_s);
  inputs.sensitivity = std::move(sweep.speeds);
  inputs.worst_sensitivity = sweep.worst;
  if (const auto signals = pass.TakeTestSignals()) {
    inputs.measured = MeasureSensitivity(*signals, rig, controller.law, inputs.sensitivity);
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
  inputs.blocks = BlocksOf(reader.events(), pass.first_cycle(), pass.last_cycle(),
                           rig.numbers.period_s(), BlockNames(controller));
  inputs.saves_bias = !controller.bias.empty();
  inputs.trip_text = FirstTripText(reader.events());
  inputs.incomplete_reason = options.incomplete_reason.empty()
                                 ? BreaksOff(reader.damage(), inputs.session.modes)
                                 : options.incomplete_reason;
  inputs.damage = reader.damage().Text();
  return Judge(std::move(inputs));
}

}  // namespace levitas::verdict
