// Cost and error of the time steps considered for the plant: the reference responses are repeated
// with each, one sample of delay, first-order amplifier and sensor, no noise. Counters: the largest
// difference of a position from the reference, in percent of the peak, standing (large release) and
// spinning (3000 rpm). Time: one period of the rotor alone, spinning.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "benchmark/speed/candidate_steps.hpp"
#include "common/rotational_speed.hpp"
#include "plant_sim/plant/rest.hpp"
#include "tests/loop/reference/textbook_law.hpp"
#include "tests/support/reference_csv.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::bench {
namespace {

enum Scheme : int { kRungeKutta4, kKickDriftKick, kExponentialTrapezoid };

struct Rig {
  Rig(int substeps, std::size_t modes) : model(Config(substeps, modes)), step(model) {
    const std::size_t count = 2 * model.layout().modes;
    modal = {std::vector<double>(count), std::vector<double>(count)};
    currents.bias_a = {1.0, 1.0, 1.0, 1.0};
  }

  static plant::PlantConfig Config(int substeps, std::size_t modes) {
    auto config = test::QuietFlexibleRotor();
    config.substeps = substeps;
    config.rotor.modes_per_plane = modes;
    return config;
  }

  void Place(const AxisArray& actuator_position_m) {
    std::vector<double> state(model.layout().size);
    plant::PlaceRigidly(model, actuator_position_m, state);
    std::copy_n(state.begin(), modal.position.size(), modal.position.begin());
    for (std::size_t a = 0; a < 4; ++a) filtered_m[a] = Seen(a);
  }

  [[nodiscard]] double Seen(std::size_t axis) const {
    return plant::AtPlane(model.bearings()[axis / 2].sensor_shape,
                          modal.position.data() + (axis % 2) * model.layout().modes);
  }

  plant::Spin SpinAt(double instant_s) const {
    const plant::Rotation rotation{speed_rad_per_s, speed_rad_per_s * instant_s, 0.0};
    return plant::MakeSpin(rotation, plant::MakeHeading(rotation));
  }

  void Advance(Scheme scheme, const AxisArray& command_a) {
    const plant::StepTable& table = model.steps()[1];
    const double half_decay = std::sqrt(table.amplifier[0].decay);
    for (int i = 0; i < table.substeps; ++i) {
      Instants at{currents,
                  currents,
                  currents,
                  SpinAt(time_s),
                  SpinAt(time_s + table.duration_s / 2.0),
                  SpinAt(time_s + table.duration_s)};
      AxisArray seen_m{};
      for (std::size_t a = 0; a < 4; ++a) {
        seen_m[a] = Seen(a);
        const double error_a = currents.control_a[a] - command_a[a];
        at.middle.control_a[a] = command_a[a] + error_a * half_decay;
        at.end.control_a[a] = command_a[a] + error_a * half_decay * half_decay;
      }
      if (scheme == kRungeKutta4) step.RungeKutta4(table.duration_s, at, modal);
      if (scheme == kKickDriftKick) step.KickDriftKick(table, at, modal);
      if (scheme == kExponentialTrapezoid) step.ExponentialTrapezoid(table, at, modal);
      currents = at.end;
      time_s += table.duration_s;
      for (std::size_t a = 0; a < 4; ++a) {
        const auto& f = table.sensor[a / 2];
        filtered_m[a] = f.decay * filtered_m[a] + f.start * seen_m[a] + f.end * Seen(a);
      }
    }
  }

  plant::PlantModel model;
  CandidateStep step;
  Modal modal;
  plant::Currents currents;
  AxisArray filtered_m{};
  double speed_rad_per_s{};
  double time_s{};
};

double ErrorPercent(Scheme scheme, int substeps, std::size_t modes, const char* file,
                    const AxisArray& actuator_position_m, double speed_rpm) {
  Rig rig(substeps, modes);
  rig.Place(actuator_position_m);
  rig.speed_rad_per_s = RpmToRadPerS(speed_rpm);
  std::array<test::TextbookAxis, 4> law{
      test::TextbookAxis{1.0, 1e-4}, test::TextbookAxis{1.0, 1e-4},
      test::TextbookAxis{2.1294, 1e-4}, test::TextbookAxis{2.1294, 1e-4}};
  AxisArray waiting_a{};
  double worst_m = 0.0;
  double peak_m = 0.0;
  for (const auto& row : test::ReadReference(file)) {
    AxisArray command_a{};
    for (std::size_t a = 0; a < 4; ++a) {
      const double error_m = std::abs(rig.filtered_m[a] - row[1 + a]);
      worst_m = std::isfinite(error_m) ? std::max(worst_m, error_m) : INFINITY;
      peak_m = std::max(peak_m, std::abs(row[1 + a]));
      command_a[a] = law[a].Step(rig.filtered_m[a]);
    }
    rig.Advance(scheme, waiting_a);
    waiting_a = command_a;
  }
  return 100.0 * worst_m / peak_m;
}

void Integrator(benchmark::State& state) {
  const auto scheme = static_cast<Scheme>(state.range(0));
  const auto substeps = static_cast<int>(state.range(1));
  const auto modes = static_cast<std::size_t>(state.range(2));
  state.counters["standing_%"] = ErrorPercent(
      scheme, substeps, modes, "flexible_rotor_release_large.csv", {60e-6, 0.0, 0.0, 30e-6}, 0.0);
  state.counters["spinning_%"] =
      ErrorPercent(scheme, substeps, modes, "flexible_rotor_spin_3000rpm.csv", {}, 3000.0);
  // Magnets off: the rotor floats freely and stays finite however long it is timed.
  Rig rig(substeps, modes);
  rig.currents = {};
  rig.speed_rad_per_s = 314.0;
  for (auto _ : state) rig.Advance(scheme, {});
  state.SetLabel(scheme == kRungeKutta4     ? "Runge-Kutta 4"
                 : scheme == kKickDriftKick ? "kick-drift-kick"
                                            : "exponential trapezoid");
}
BENCHMARK(Integrator)
    ->ArgNames({"", "substeps", "modes"})
    ->ArgsProduct({{kRungeKutta4, kKickDriftKick, kExponentialTrapezoid}, {1, 2, 4}, {8, 12, 16}});

}  // namespace
}  // namespace levitas::bench
