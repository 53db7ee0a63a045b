// The shipped rig, controller and scenarios, in one process: the rig's objectives are met.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/scenario_player.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "plant_sim/plant/plant.hpp"
#include "verdict/report.hpp"
#include "verdict/verdict.hpp"

namespace levitas {
namespace {

struct Bench {
  explicit Bench(const std::string& scenario_name)
      : rig(configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"))),
        controller(configuration::LoadController(
            configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers)),
        scenario(configuration::LoadScenario(configuration::FindConfig(scenario_name, "scenarios"),
                                             rig.numbers)) {}

  /// Plays the scenario to its end, at most `limit_s` of the rig's time.
  verdict::Verdict Play(std::uint64_t seed, double limit_s = 60.0) {
    plant::Plant plant(rig.plant, seed);
    plant.RestInTouchdown();
    cycle::ControlCycle cycle({rig.numbers, controller.law, controller.supervisor,
                               controller.synchronous, controller.bias});
    const double standstill = controller.supervisor.sequence.standstill_rad_per_s;
    scenario::ScenarioPlayer player(scenario, rig.numbers.period_s(), standstill);
    verdict::SessionStatistics statistics(rig.numbers, standstill, 0.5);
    cycle::CycleRecord record;
    const auto limit = static_cast<std::uint64_t>(limit_s / rig.numbers.period_s());
    while (!player.finished() && !player.failed() && record.in.cycle < limit) {
      ++record.in.cycle;
      record.in.frame = plant.Sample();
      record.in.frame_present = true;
      const auto asked =
          player.Next(record.out.mode, record.in.frame.speed_rad_per_s, record.out.fault,
                      record.out.command_refused, 0.0, cycle.decision().standing);
      record.in.op = {asked.command, asked.speed_rad_per_s, asked.acceleration_rad_per_s2,
                      asked.excitation_a};
      record.out = cycle.Step(record.in);
      statistics.Add(record);
      const CurrentFrame& current = record.out.current;
      plant.Advance({.control_current_a = current.control_current_a,
                     .bias_current_a = current.bias_current_a,
                     .amplifiers_enabled = current.amplifiers_enabled,
                     .drive_enabled = current.drive_enabled,
                     .speed_set_point_rad_per_s = current.speed_set_point_rad_per_s,
                     .acceleration_limit_rad_per_s2 = current.acceleration_limit_rad_per_s2});
    }
    verdict::Inputs inputs;
    inputs.rig = rig.numbers;
    inputs.session = statistics.Figures();
    inputs.incomplete_reason = player.Text();
    return verdict::Judge(inputs);
  }

  configuration::RigFile rig;
  configuration::ControllerFile controller;
  scenario::ScenarioConfig scenario;
};

TEST(ShippedRig, MeetsItsObjectivesFromStandstillTo6000RpmWithNoise) {
  Bench bench("run_up_6000");
  const verdict::Verdict verdict = bench.Play(20261121);
  EXPECT_EQ(verdict.outcome, verdict::Outcome::kAccepted) << verdict::Table(verdict);
  EXPECT_GT(verdict.inputs.session.top_speed_rad_per_s, RpmToRadPerS(5990.0));
  for (const verdict::OrbitJudgement& at : verdict.orbits) {
    EXPECT_LT(at.orbit.max_m, at.spinning ? 36e-6 : 7e-6) << verdict::Table(verdict);
  }
}

// The other half of the pair: the same rig and scenario with a law that cannot hold it.
TEST(ShippedRig, IsNotAcceptedWithGainsBelowTheNegativeStiffness) {
  Bench bench("default");
  for (auto& axis : bench.controller.law.axes) {
    axis.kp_a_per_m *= 0.4;  // ki Kp = 0.72e5 N/m at the drive end, ks = 1.05e5 N/m
    axis.ki_a_per_m_s = 0.0;
  }
  const verdict::Verdict verdict = bench.Play(20261121);
  EXPECT_EQ(verdict.outcome, verdict::Outcome::kTripped) << verdict::Table(verdict);
}

}  // namespace
}  // namespace levitas
