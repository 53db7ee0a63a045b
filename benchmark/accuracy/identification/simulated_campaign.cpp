#include "benchmark/accuracy/identification/simulated_campaign.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "common/rotational_speed.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/prbs.hpp"
#include "controller/scenario/signal.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

class Rig {
 public:
  Rig(const config::RigFile& rig, const std::shared_ptr<const plant::PlantModel>& model,
      std::uint64_t seed)
      : plant_(model, seed), cycle_(Cycle(rig)) {
    plant_.RestInTouchdown();
    record.name = "simulated campaign";
    record.period_ns = rig.numbers.period_ns;
    record.channels = rig.numbers.channels;
    record.sensor_range_m.assign(rig.numbers.axes(), rig.numbers.sensor_range_m);
    record.current_limit_a = rig.numbers.bias_current_a;
    for (auto* columns :
         {&record.position_m, &record.current_a, &record.excitation_a, &record.excitation_m}) {
      columns->resize(rig.numbers.axes());
    }
  }

  Mode Step(const cycle::OperatorInput& op, bool keep = false) {
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
  void Run(double time_s) {
    for (long n = std::lround(time_s / record.period_s()); n > 0; --n) (void)Step({});
  }
  void Levitate() {
    Mode mode = Step({OperatorCommand::kLift, 0.0, 0.0, {}});
    for (int n = 0; n < 50'000 && mode != Mode::kLevitating; ++n) mode = Step({});
    if (mode != Mode::kLevitating) throw std::runtime_error("the rig does not levitate");
    Run(0.5);
  }
  /// At speed without the time of a run-up: the drive holds it.
  void SpinAt(double rpm) {
    plant_.SetSpeed(RpmToRadPerS(rpm), 0.0);
    (void)Step({OperatorCommand::kSpin, RpmToRadPerS(rpm), RpmToRadPerS(800.0), {}});
    Run(0.5);
  }

  session::Recording record;

 private:
  static cycle::CycleConfig Cycle(const config::RigFile& rig) {
    const auto controller = config::LoadController(
        config::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
    return {rig.numbers, controller.law, controller.supervisor, controller.synchronous};
  }
  void Keep(const cycle::CycleInputs& in, const cycle::CycleOutputs& out) {
    record.cycle.push_back(in.cycle);
    record.levitated.push_back(1);
    record.speed_rad_per_s.push_back(in.frame.speed_rad_per_s);
    record.angle_rad.push_back(in.frame.angle_rad);
    for (std::size_t axis = 0; axis < record.axes(); ++axis) {
      record.position_m[axis].push_back(in.frame.position_m[axis]);
      record.current_a[axis].push_back(out.current.control_current_a[axis]);
      record.excitation_a[axis].push_back(in.op.excitation_a[axis]);
    }
  }

  plant::Plant plant_;
  cycle::ControlCycle cycle_;
  std::uint64_t count_{};
};

scenario::Excitation TestSignal(const ExcitationPlan& plan) {
  if (plan.signal) return *plan.signal;
  scenario::Excitation prbs;
  prbs.amplitude_a = plan.amplitude_a;
  prbs.order = plan.order;
  prbs.divisor = plan.divisor;
  return prbs;
}

long SamplesOf(const ExcitationPlan& plan, double period_s) {
  if (plan.signal) return std::lround(plan.hold_s / period_s);
  const auto bits = static_cast<long>(scenario::Prbs(plan.order).period());
  return plan.periods * bits * static_cast<long>(plan.divisor);
}

}  // namespace

session::Recording SimulateCampaign(const config::RigFile& rig, const ExcitationPlan& plan) {
  return SimulateCampaign(rig, plant::Reduce(rig.plant), plan);
}

session::Recording SimulateCampaign(const config::RigFile& rig, const plant::PlantParameters& truth,
                                    const ExcitationPlan& plan) {
  Rig bench(rig, std::make_shared<const plant::PlantModel>(truth), plan.seed);
  bench.Levitate();
  for (const double rpm : plan.speeds_rpm) {
    if (rpm > 0.0) bench.SpinAt(rpm);
    for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis) {
      const scenario::Excitation test = TestSignal(plan);
      scenario::Signal signal(test, bench.record.period_s());
      cycle::OperatorInput op;
      for (long n = SamplesOf(plan, bench.record.period_s()); n > 0; --n) {
        op.excitation_a[axis] = test.amplitude_a * signal.Next();
        (void)bench.Step(op, true);
      }
      bench.Run(0.3);
    }
  }
  return bench.record;
}

}  // namespace levitas::accuracy
