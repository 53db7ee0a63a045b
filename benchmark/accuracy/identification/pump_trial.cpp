#include "benchmark/accuracy/identification/pump_trial.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/scenario_player.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "identification/nonlinear/known_loop.hpp"
#include "identification/nonlinear/lagged_model.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::accuracy {
namespace {

using identification::SensorCharacteristic;
using Index = Eigen::Index;

constexpr double kLongestS = 10.0;  ///< lift and excitation last 6 s

effect::EffectConfig Saturation(const PumpPlan& plan) {
  effect::EffectConfig iron{.id = effect::Id::kMagneticSaturation};
  iron.values[0] = plan.knee_a;
  iron.values[1] = plan.knee_exponent;
  return iron;
}

configuration::RigFile RigOf(const configuration::RigFile& nominal, const PumpPlan& plan) {
  configuration::RigFile rig = nominal;
  if (plan.knee_a > 0.0) rig.plant.effects.push_back(Saturation(plan));
  for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis) {
    const SensorCharacteristic curve = CharacteristicOf(plan, axis);
    if (curve.a2 == 0.0 && curve.a3 == 0.0) continue;
    effect::EffectConfig sensor{.id = effect::Id::kSensorNonlinearity, .axes = 1U << axis};
    sensor.values[0] = curve.a2;
    sensor.values[1] = curve.a3;
    rig.plant.effects.push_back(sensor);
  }
  return rig;
}

scenario::ScenarioConfig ScenarioOf(const configuration::RigFile& rig, const PumpPlan& plan) {
  auto scenario = configuration::LoadScenario(
      configuration::FindConfig("turbomolecular_pump_identify", "scenarios"), rig.numbers);
  for (scenario::Step& step : scenario.steps) {
    for (scenario::Excitation& excitation : step.excitation) {
      excitation.amplitude_m *= plan.amplitude;
      excitation.seed += plan.excitation_seed;
    }
  }
  return scenario;
}

void Silence(plant::PlantConfig& rig) {
  for (plant::BearingConfig& bearing : rig.bearings) bearing.sensor.noise_rms_m = 0.0;
}

/// Of commanded currents and readings, to be filled.
identification::Series SeriesOf(const RigNumbers& rig, Index rows) {
  const auto axes = static_cast<Index>(rig.axes());
  return {rig.period_s(), rig.channels, rig.channels, Eigen::MatrixXd(rows, axes),
          Eigen::MatrixXd(rows, axes)};
}

plant::PlantCommand CurrentsOf(const cycle::CycleOutputs& out) {
  return {.control_current_a = out.current.control_current_a,
          .bias_current_a = out.current.bias_current_a,
          .amplifiers_enabled = out.current.amplifiers_enabled};
}

void ReadRow(const Eigen::MatrixXd& rows, Index row, AxisArray& axes) {
  for (Index i = 0; i < rows.cols(); ++i) axes[static_cast<std::size_t>(i)] = rows(row, i);
}

void WriteRow(const AxisArray& axes, Index row, Eigen::MatrixXd& rows) {
  for (Index i = 0; i < rows.cols(); ++i) rows(row, i) = axes[static_cast<std::size_t>(i)];
}

double LargestRadius(const SensorFrame& frame) {
  double largest_m = 0.0;
  for (std::size_t x = 0; x + 1 < frame.axes; x += 2) {
    largest_m = std::max(largest_m, std::hypot(frame.position_m[x], frame.position_m[x + 1]));
  }
  return largest_m;
}

}  // namespace

SensorCharacteristic CharacteristicOf(const PumpPlan& plan, std::size_t axis) {
  return {(axis % 2 == 0 ? 1.0 : -1.0) * plan.a2_1_per_m, plan.a3_1_per_m2};
}

PumpTrial::PumpTrial(const PumpPlan& plan)
    : plan_(plan),
      nominal_(configuration::LoadRig(configuration::FindConfig("turbomolecular_pump", "rigs"))),
      rig_(RigOf(nominal_, plan)),
      controller_(configuration::LoadController(
          configuration::FindConfig(rig_.run.controller, "controllers"), rig_.numbers)),
      scenario_(ScenarioOf(rig_, plan)),
      record_(Record(plan.noise_seed, {})) {
  if (plan.inputs == PumpInputs::kCommanded) return;
  const identification::KnownLoop loop(controller_.law, rig_.numbers, {record_.excitation_m, {}});
  const identification::Feedback controllers = loop.AtRest();
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(record_.series.outputs());
  Eigen::VectorXd current_a(record_.series.inputs());
  for (Index row = 0; row < record_.series.rows(); ++row) {
    controllers(row, at_rest, current_a);
    record_.series.input.row(row) = current_a.transpose();
  }
}

PumpTrial::PumpRecord PumpTrial::Record(std::uint64_t seed, const Twin& twin) const {
  plant::PlantConfig config = rig_.plant;
  auto supervisor = controller_.supervisor;
  if (!twin.noise) {
    Silence(config);
    supervisor.protection.sensor_frozen_cycles = 1'000'000;  // a reading without noise repeats
  }
  const Index rows = plan_.fitted + kBetween + kJudged;
  PumpRecord kept{SeriesOf(rig_.numbers, rows),
                  Eigen::MatrixXd(rows, static_cast<Index>(rig_.numbers.axes()))};
  plant::Plant plant(config, seed);
  plant.RestInTouchdown();
  cycle::ControlCycle cycle({rig_.numbers, controller_.law, supervisor});
  scenario::ScenarioPlayer player(scenario_, rig_.numbers.period_s(),
                                  supervisor.sequence.standstill_rad_per_s);
  cycle::CycleInputs in;
  cycle::CycleOutputs out;
  const auto limit = static_cast<std::uint64_t>(kLongestS / rig_.numbers.period_s());
  Index row = -1;
  while (row < rows && !player.finished() && !player.failed() && in.cycle < limit) {
    ++in.cycle;
    in.frame = plant.Sample();
    in.frame_present = true;
    auto asked = player.Next(out.mode, 0.0, out.fault, out.command_refused, LargestRadius(in.frame),
                             cycle.decision().standing);
    if (row < 0 && asked.excitation_m[0] != 0.0) row = 0;
    if (row >= 0 && row < rows && twin.excitation_m != nullptr) {
      ReadRow(*twin.excitation_m, row, asked.excitation_m);
    }
    in.op = {asked.command, 0.0, 0.0, asked.excitation_a, asked.excitation_m};
    out = cycle.Step(in);
    if (row >= 0 && row < rows) {
      WriteRow(out.current.control_current_a, row, kept.series.input);
      WriteRow(in.frame.position_m, row, kept.series.output);
      WriteRow(asked.excitation_m, row, kept.excitation_m);
      ++row;
    }
    plant.Advance(CurrentsOf(out));
  }
  if (row < rows) throw std::runtime_error("the pump's scenario ended early: " + player.Text());
  return kept;
}

Eigen::VectorXd PumpTrial::deviation_m() const {
  const Eigen::MatrixXd judged = record_.series.output.bottomRows(kJudged);
  const Eigen::MatrixXd centred = judged.rowwise() - judged.colwise().mean();
  return centred.colwise().norm().transpose() / std::sqrt(static_cast<double>(kJudged));
}

Eigen::VectorXd PumpTrial::Fit(const Eigen::MatrixXd& predicted) const {
  return identification::FitPercent(record_.series.output, predicted,
                                    record_.series.rows() - kJudged);
}

Eigen::VectorXd PumpTrial::CeilingOfReadings() const {
  Eigen::VectorXd ceiling = deviation_m();
  for (Index i = 0; i < ceiling.size(); ++i) {
    const auto& bearing = rig_.plant.bearings[static_cast<std::size_t>(i) / 2];
    ceiling[i] = 100.0 * (1.0 - bearing.sensor.noise_rms_m / ceiling[i]);
  }
  return ceiling;
}

Eigen::VectorXd PumpTrial::Ceiling() const {
  return Fit(Record(plan_.noise_seed, {false, &record_.excitation_m}).series.output);
}

Eigen::VectorXd PumpTrial::Repeated(std::uint64_t noise_seed) const {
  return Fit(Record(noise_seed, {true, &record_.excitation_m}).series.output);
}

}  // namespace levitas::accuracy
