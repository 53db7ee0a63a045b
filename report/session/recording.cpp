#include "report/session/recording.hpp"

#include <algorithm>
#include <cmath>

#include "common/levitated_modes.hpp"
#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "session/log/record_frame.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::report {
namespace {

/// Slower than any bearing is judged at; for records that name no controller.
constexpr double kSlow = 1.0;

void Add(Recording& recording, const cycle::CycleRecord& record,
         const session::RecordFrame& bearing) {
  ++recording.records;
  recording.missed_deadlines += record.in.missed_deadlines;
  if (!record.in.frame_present) {
    ++recording.without_frame;
    return;
  }
  const SensorFrame& frame = record.in.frame;
  const session::AxisSample sample = bearing.Bearing(record);
  recording.cycle.push_back(record.in.cycle);
  for (std::size_t axis = 0; axis < recording.position_m.size(); ++axis) {
    recording.position_m[axis].push_back(static_cast<float>(sample.position_m[axis]));
    recording.current_a[axis].push_back(static_cast<float>(sample.current_a[axis]));
  }
  recording.speed_rad_per_s.push_back(static_cast<float>(frame.speed_rad_per_s));
  recording.angle_rad.push_back(static_cast<float>(frame.angle_rad));
  recording.sample_time_ns.push_back(frame.sample_time_ns);
  const bool imported = recording.header.controller_yaml.empty();
  recording.levitated.push_back(imported || IsLevitated(record.out.mode));
  if (recording.levitated.back() && std::isfinite(frame.speed_rad_per_s)) {
    recording.top_speed_rad_per_s =
        std::max(recording.top_speed_rad_per_s, std::abs(frame.speed_rad_per_s));
  }
}

/// The signals of a channel begin with zeros for the rows before the first of any.
void AddExcitation(Recording& recording, const cycle::OperatorInput& op) {
  const std::size_t channels = recording.rig.channels.size();
  const auto acts = [channels](const AxisArray& signal) {
    return std::any_of(signal.begin(), signal.begin() + static_cast<std::ptrdiff_t>(channels),
                       [](double value) { return value != 0.0; });
  };
  if (recording.excitation.empty()) {
    recording.excitation_at_reading = acts(op.excitation_m);
    if (!recording.excitation_at_reading && !acts(op.excitation_a)) return;
    recording.excitation.assign(channels, std::vector<float>(recording.size() - 1, 0.0F));
  }
  const AxisArray& signal = recording.excitation_at_reading ? op.excitation_m : op.excitation_a;
  for (std::size_t i = 0; i < channels; ++i) {
    recording.excitation[i].push_back(static_cast<float>(signal[i]));
  }
}

void AddTorsion(Recording& recording, const SensorFrame& frame) {
  if (recording.torsion.couplings.empty()) return;
  const auto row = recording.torsion.RowOf(frame.rig_session, frame.cycle);
  recording.torsion_row.push_back(row ? static_cast<std::int64_t>(*row) : -1);
}

}  // namespace

double Recording::Radius(std::size_t bearing, std::size_t i) const {
  return std::hypot(static_cast<double>(position_m[2 * bearing][i]),
                    static_cast<double>(position_m[2 * bearing + 1][i]));
}

Recording Load(const std::string& path) {
  session::SessionReader reader(path);
  Recording recording;
  recording.header = reader.header();
  const std::string within = path + " (header)";
  const configuration::RigFile rig = configuration::ParseRig(recording.header.rig_yaml, within);
  recording.rig = rig.numbers;
  if (!rig.plant.shafts.empty()) {
    const std::vector<double> ratio = plant::SpeedRatios(rig.plant);
    for (const auto& bearing : rig.plant.bearings) {
      recording.shaft_ratio.push_back(ratio[bearing.shaft]);
    }
  }
  recording.standstill_rad_per_s = kSlow;
  if (!recording.header.controller_yaml.empty()) {
    recording.standstill_rad_per_s =
        configuration::ParseController(recording.header.controller_yaml, within, recording.rig)
            .supervisor.sequence.standstill_rad_per_s;
  }
  recording.position_m.resize(2 * recording.rig.bearings.size());
  recording.current_a.resize(2 * recording.rig.bearings.size());
  const session::RecordFrame bearing(recording.rig);
  recording.torsion = session::LoadTorsion(path);
  cycle::CycleRecord record;
  while (reader.Next(record)) {
    // Numbers that go back (files put together) would make times without meaning.
    const bool forward = recording.cycle.empty() || record.in.cycle > recording.cycle.back();
    if (!forward) continue;
    const std::size_t rows = recording.size();
    Add(recording, record, bearing);
    if (recording.size() == rows) continue;
    AddExcitation(recording, record.in.op);
    AddTorsion(recording, record.in.frame);
  }
  recording.events = reader.events();
  recording.damage = reader.damage().Text();
  if (recording.size() == 0) throw BadInput(path + ": holds no cycle with a sensor frame");
  return recording;
}

}  // namespace levitas::report
