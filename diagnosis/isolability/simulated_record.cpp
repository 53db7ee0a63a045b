#include "diagnosis/isolability/simulated_record.hpp"

#include <fmt/core.h>

#include "analysis/records/recorded_rows.hpp"
#include "common/problem.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/scenario_player.hpp"
#include "controller/supervisor/radius.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "plant_sim/plant/plant.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::diagnosis {
namespace {

analysis::RecordedRow RowOf(const cycle::CycleRecord& record, const session::RecordFrame& frame,
                            std::size_t axes) {
  const session::AxisSample sample = frame.Bearing(record);
  analysis::RecordedRow row;
  row.cycle = record.in.frame.cycle;
  row.levitated = session::IsLevitated(record, axes);
  row.sample.position_m = sample.position_m;
  row.sample.command = plant::CommandOf(record.out.current);
  row.sample.command.control_current_a = sample.current_a;
  row.sample.speed_rad_per_s = record.in.frame.speed_rad_per_s;
  row.sample.angle_rad = record.in.frame.angle_rad;
  row.excitation_a = record.in.op.excitation_a;
  return row;
}

}  // namespace

Record SimulatedRecord(const configuration::RigFile& rig,
                       const configuration::ControllerFile& controller,
                       const scenario::ScenarioConfig& scenario, std::uint64_t seed) {
  const double period_s = rig.numbers.period_s();
  plant::Plant plant(rig.plant, seed);
  plant.RestInTouchdown();
  cycle::ControlCycle cycle({rig.numbers, controller.law, controller.supervisor,
                             controller.synchronous, controller.bias});
  scenario::ScenarioPlayer player(scenario, period_s,
                                  controller.supervisor.sequence.standstill_rad_per_s);
  const session::RecordFrame frame(rig.numbers);
  Record record;
  record.name = scenario.name;
  cycle::CycleRecord now;
  const auto limit = static_cast<std::uint64_t>(kLongestS / period_s);
  while (!player.finished()) {
    if (player.failed()) {
      throw BadInput(fmt::format("scenario {} on the simulated rig {}: {}", scenario.name,
                                 rig.numbers.name, player.Text()));
    }
    if (++now.in.cycle > limit) {
      throw BadInput(
          fmt::format("scenario {} takes longer than {:.0f} s: --plan simulates none "
                      "that long",
                      scenario.name, kLongestS));
    }
    now.in.frame = plant.Sample();
    now.in.frame_present = true;
    const scenario::PlayerOutput asked = player.Next(
        now.out.mode, now.in.frame.speed_rad_per_s, now.out.fault, now.out.command_refused,
        supervisor::LargestRadius(now.in.frame), cycle.decision().standing);
    now.in.op = {asked.command, asked.speed_rad_per_s, asked.acceleration_rad_per_s2,
                 asked.excitation_a, asked.excitation_m};
    now.out = cycle.Step(now.in);
    analysis::RecordedRow row = RowOf(now, frame, rig.numbers.axes());
    if (row.levitated) record.rows.push_back(row);
    plant.Advance(plant::CommandOf(now.out.current));
  }
  analysis::FindAccelerations(period_s, record.rows);
  record.mean_speed_rad_per_s = analysis::MeanSpeed(record.rows);
  return record;
}

}  // namespace levitas::diagnosis
