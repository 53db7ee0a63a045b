#include "benchmark/accuracy/identification/simulated_campaign.hpp"

#include <cmath>
#include <memory>
#include <string>

#include "benchmark/accuracy/simulated_rig.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/prbs.hpp"
#include "controller/scenario/signal.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "session/exchange/recording_builder.hpp"

namespace levitas::accuracy {
namespace {

/// The commissioned controller in the loop.
cycle::CycleConfig CycleOf(const configuration::RigFile& rig) {
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  return {rig.numbers, controller.law, controller.supervisor, controller.synchronous,
          controller.bias};
}

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

session::Recording SimulateCampaign(const configuration::RigFile& rig, const ExcitationPlan& plan) {
  return SimulateCampaign(rig, plant::Reduce(rig.plant), plan);
}

session::Recording SimulateCampaign(const configuration::RigFile& rig,
                                    const plant::PlantParameters& truth,
                                    const ExcitationPlan& plan) {
  SimulatedRig bench(CycleOf(rig),
                     plant::Plant(std::make_shared<const plant::PlantModel>(truth), plan.seed));
  session::RecordingBuilder rows("simulated campaign", rig.numbers);
  const double period_s = rig.numbers.period_s();
  bench.Levitate();
  for (const double rpm : plan.speeds_rpm) {
    if (rpm > 0.0) bench.SpinAt(rpm);
    for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis) {
      const scenario::Excitation test = TestSignal(plan);
      scenario::Signal signal(test, period_s);
      cycle::OperatorInput op;
      for (long n = SamplesOf(plan, period_s); n > 0; --n) {
        op.excitation_a[axis] = test.amplitude_a * signal.Next();
        rows.Take(bench.Step(op));
      }
      bench.Run(0.3);
    }
  }
  return rows.Finish();
}

}  // namespace levitas::accuracy
