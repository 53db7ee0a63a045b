#pragma once
// A run-up of flexible_rotor in one process, as a record in memory: a drawn rig, the shipped
// controller, the nonlinear plant with noise, quantisation and gravity.

#include <stdexcept>

#include "benchmark/accuracy/simulated_rig.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "plant_sim/plant/plant.hpp"
#include "session/exchange/recording.hpp"
#include "session/exchange/recording_builder.hpp"
#include "tests/support/modes_within.hpp"

namespace levitas::balancing {

inline const configuration::RigFile& FlexibleRotor() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

inline const configuration::ControllerFile& ShippedController() {
  static const configuration::ControllerFile file = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"),
      FlexibleRotor().numbers);
  return file;
}

/// The rig with probes that add no run-out and next to no noise (none at all counts as a probe that
/// hangs), to see what the rotor does.
inline configuration::RigFile WithQuietProbes(configuration::RigFile rig) {
  for (auto& bearing : rig.plant.bearings) bearing.sensor.noise_rms_m = 0.05e-6;
  std::erase_if(rig.plant.effects, [](const effect::EffectConfig& entry) {
    return entry.id == effect::Id::kSensorRunout;
  });
  return rig;
}

struct RunUpPlan {
  double top_rpm{6000.0};
  double acceleration_rpm_per_s{800.0};
  std::uint64_t seed{1};
};

/// The record of a run-up from standing to the top speed.
inline session::Recording RecordRunUp(const configuration::RigFile& rig, const RunUpPlan& plan) {
  const configuration::ControllerFile& controller = ShippedController();
  accuracy::SimulatedRig bench({rig.numbers, controller.law, controller.supervisor},
                               plant::Plant(rig.plant, plan.seed));
  session::RecordingBuilder record("simulated run-up", rig.numbers);
  bench.Levitate(0.3);
  bench.Step({OperatorCommand::kSpin,
              RpmToRadPerS(plan.top_rpm),
              RpmToRadPerS(plan.acceleration_rpm_per_s),
              {}});
  const double time_s = plan.top_rpm / plan.acceleration_rpm_per_s + 0.5;
  for (auto rows = static_cast<long>(time_s / rig.numbers.period_s()); rows > 0; --rows) {
    record.Take(bench.Step());
  }
  if (bench.record().out.mode != Mode::kSpinning) throw std::runtime_error("the rig does not spin");
  return record.Finish();
}

/// A rig as it may be behind flexible_rotor.yaml: ki and ks of every axis within 10 %, frequencies
/// of the modes within 3 %, damping within 50 %, unbalance of any direction at the three planes.
inline configuration::RigFile DrawRig(std::uint64_t seed) {
  Random draw(seed);
  const auto parameters =
      test::ModesWithin(0.03, uncertainty::Stated(FlexibleRotor(), {0.0, 0.5, 0.1, 0.1, 6}));
  configuration::RigFile rig =
      uncertainty::At(FlexibleRotor(), parameters, uncertainty::DrawPlace(draw, parameters.size()));
  for (plant::UnbalanceMass& mass : rig.plant.unbalance) {
    mass.moment_kg_m = (3.0 + 12.0 * draw.Uniform()) * 1e-6;
    mass.phase_rad = kTwoPi * (draw.Uniform() - 0.5);
  }
  return rig;
}

}  // namespace levitas::balancing
