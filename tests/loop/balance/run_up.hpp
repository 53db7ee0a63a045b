#pragma once
// A run-up of flexible_rotor in one process, as a record in memory: a drawn rig, the shipped
// controller, the nonlinear plant with noise, quantisation and gravity.

#include <memory>
#include <stdexcept>

#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "plant_sim/plant/plant.hpp"
#include "session/recording.hpp"

namespace levitas::balancing {

inline const config::RigFile& FlexibleRotor() {
  static const config::RigFile rig = config::LoadRig(config::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

inline const config::ControllerFile& ShippedController() {
  static const config::ControllerFile file = config::LoadController(
      config::FindConfig("flexible_rotor_commissioned", "controllers"), FlexibleRotor().numbers);
  return file;
}

/// The rig with probes that add no run-out and next to no noise (none at all counts as a probe that
/// hangs), to see what the rotor does.
inline config::RigFile WithQuietProbes(config::RigFile rig) {
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

class RunUp {
 public:
  RunUp(const config::RigFile& rig, const RunUpPlan& plan)
      : plant_(rig.plant, plan.seed),
        cycle_({rig.numbers, ShippedController().law, ShippedController().supervisor}) {
    record.name = "simulated run-up";
    record.period_ns = rig.numbers.period_ns;
    record.channels = rig.numbers.channels;
    record.sensor_range_m.assign(rig.numbers.axes(), rig.numbers.sensor_range_m);
    record.current_limit_a = rig.numbers.bias_current_a;
    for (auto* columns :
         {&record.position_m, &record.current_a, &record.excitation_a, &record.excitation_m}) {
      columns->resize(rig.numbers.axes());
    }
    plant_.RestInTouchdown();
    Mode mode = Step({OperatorCommand::kLift, 0.0, 0.0, {}}, false);
    for (int n = 0; n < 50'000 && mode != Mode::kLevitating; ++n) mode = Step({}, false);
    if (mode != Mode::kLevitating) throw std::runtime_error("the rig does not levitate");
    for (int n = 0; n < 3'000; ++n) (void)Step({}, false);
    (void)Step({OperatorCommand::kSpin,
                RpmToRadPerS(plan.top_rpm),
                RpmToRadPerS(plan.acceleration_rpm_per_s),
                {}});
    const auto rows =
        static_cast<long>((plan.top_rpm / plan.acceleration_rpm_per_s + 0.5) / record.period_s());
    for (long n = 0; n < rows; ++n) mode = Step({});
    if (mode != Mode::kSpinning) throw std::runtime_error("the rig does not spin");
  }

  session::Recording record;

 private:
  Mode Step(const cycle::OperatorInput& op, bool keep = true) {
    cycle::CycleInputs in;
    in.cycle = count_++;
    in.frame_present = true;
    in.frame = plant_.Sample();
    in.op = op;
    const cycle::CycleOutputs out = cycle_.Step(in);
    plant_.Advance({out.current.control_current_a, out.current.bias_current_a,
                    out.current.amplifiers_enabled, out.current.drive_enabled,
                    out.current.speed_set_point_rad_per_s,
                    out.current.acceleration_limit_rad_per_s2});
    if (keep) Keep(in, out);
    return out.mode;
  }
  void Keep(const cycle::CycleInputs& in, const cycle::CycleOutputs& out) {
    record.cycle.push_back(in.cycle);
    record.levitated.push_back(1);
    record.speed_rad_per_s.push_back(in.frame.speed_rad_per_s);
    record.angle_rad.push_back(in.frame.angle_rad);
    record.bias_current_a.push_back(out.current.bias_current_a);
    for (std::size_t axis = 0; axis < record.axes(); ++axis) {
      record.position_m[axis].push_back(in.frame.position_m[axis]);
      record.current_a[axis].push_back(out.current.control_current_a[axis]);
    }
  }

  plant::Plant plant_;
  cycle::ControlCycle cycle_;
  std::uint64_t count_{};
};

/// A rig as it may be behind flexible_rotor.yaml: ki and ks of every axis within 10 %, frequencies
/// of the modes within 3 %, damping within 50 %, unbalance of any direction at the three planes.
inline config::RigFile DrawRig(std::uint64_t seed) {
  Random draw(seed);
  std::vector<uncertainty::Parameter> parameters =
      uncertainty::Stated(FlexibleRotor(), {0.0, 0.5, 0.1, 0.1, 6});
  for (auto& one : parameters) {
    if (one.kind != uncertainty::Kind::kModeFrequency) continue;
    one.low = 0.97 * one.nominal;
    one.high = 1.03 * one.nominal;
  }
  config::RigFile rig =
      uncertainty::At(FlexibleRotor(), parameters, uncertainty::DrawPlace(draw, parameters.size()));
  for (plant::UnbalanceMass& mass : rig.plant.unbalance) {
    mass.moment_kg_m = (3.0 + 12.0 * draw.Uniform()) * 1e-6;
    mass.phase_rad = kTwoPi * (draw.Uniform() - 0.5);
  }
  return rig;
}

}  // namespace levitas::balancing
