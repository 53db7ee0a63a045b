#include "tests/loop/effects/signature_probes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>

#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/time_step.hpp"
#include "plant_sim/rotor/plane_shape.hpp"

namespace levitas::plant::test {
namespace {

using Complex = std::complex<double>;
using Probe = std::function<double(const Plant&)>;

constexpr std::size_t kMode = 2;  // two rigid ones come first
constexpr std::size_t kModes = 8;
constexpr int kPerTurn = 100;

double CoilCurrent(const Plant& plant) { return plant.state()[plant.layout().coil_current]; }

PlantCommand DeX(double control_a) {
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.control_current_a[0] = control_a;
  return command;
}

PlantCommand Off() {
  PlantCommand command;
  command.amplifiers_enabled = false;
  return command;
}

void HoldInTheCentre(Plant& plant) {
  std::fill_n(plant.mutable_state().begin(), plant.layout().coil_current, 0.0);
}

/// Line of a quantity at a multiple of the tone, after twenty of its periods.
Complex LineUnderTone(const effect::EffectConfig& entry, double amplitude_a, int harmonic,
                      const Probe& probe) {
  Plant plant(QuietWith(entry), 1);
  Complex line = 0.0;
  for (int n = 0; n < 21 * kPerTurn; ++n) {
    const double turn_rad = kTwoPi * n / kPerTurn;
    plant.Advance(DeX(amplitude_a * std::sin(turn_rad)));
    HoldInTheCentre(plant);
    if (n >= 20 * kPerTurn) line += probe(plant) * std::polar(1.0 / kPerTurn, -harmonic * turn_rad);
  }
  return line;
}

/// The rotor floating in the centre, filters settled, nothing energised.
Plant Floating(const effect::EffectConfig& entry) {
  Plant plant(QuietWith(entry), 4);
  plant.RestInTouchdown();
  return plant;
}

std::vector<Complex> ForcesOf(const PlantModel& model, const Rotation& rotation,
                              const std::vector<double>& position,
                              const std::vector<double>& velocity) {
  std::vector<double> acceleration(2 * kModes);
  ForceReport report;
  ModalForces(model, {}, MakeSpin(rotation, MakeHeading(rotation)), position.data(),
              velocity.data(), acceleration.data(), report);
  std::vector<Complex> forces;
  forces.reserve(kModes);
  for (std::size_t i = 0; i < kModes; ++i) {
    forces.emplace_back(acceleration[i], acceleration[i + kModes]);
  }
  return forces;
}

}  // namespace

double ShapeOf(double z_m) {
  return rotor::DeflectionAt(Quiet()->parameters().modes, z_m)[static_cast<Eigen::Index>(kMode)];
}

Complex ToneRatio(const effect::EffectConfig& entry) {
  return LineUnderTone(entry, 0.1, 1, CoilCurrent) / LineUnderTone({}, 0.1, 1, CoilCurrent);
}

Complex ForceToneRatio(const effect::EffectConfig& entry) {
  const Probe force = [](const Plant& plant) { return plant.MagnetForce()[0]; };
  return LineUnderTone(entry, 0.1, 1, force) / LineUnderTone({}, 0.1, 1, force);
}

double ThirdHarmonic(const effect::EffectConfig& entry, double amplitude_a) {
  const Complex first = LineUnderTone(entry, amplitude_a, 1, CoilCurrent);
  const Complex third = LineUnderTone(entry, amplitude_a, 3, CoilCurrent);
  return (third / std::pow(first / std::abs(first), 3)).real() / std::abs(first);
}

double HeldShare(const effect::EffectConfig& entry) {
  constexpr int kPeriods = 40'000;
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.effects.push_back(entry);
  // So fast that a period is 63 of its time constants: a current that stands was held.
  for (auto& bearing : parameters.config.bearings) bearing.amplifier.bandwidth_hz = 1e5;
  Plant plant(std::make_shared<const PlantModel>(std::move(parameters)), 11);
  int held = 0;
  double before_a = -1.0;
  for (int n = 0; n < kPeriods; ++n) {
    plant.Advance(DeX(1e-5 * n));
    HoldInTheCentre(plant);
    if (CoilCurrent(plant) - before_a < 1e-9) ++held;
    before_a = CoilCurrent(plant);
  }
  return static_cast<double>(held) / kPeriods;
}

double ForceLeft(const effect::EffectConfig& entry) {
  Plant plant(QuietWith(entry), 1);
  for (int n = 0; n < 300; ++n) {
    plant.Advance(DeX(n < 100 ? 0.5 : 0.0));
    HoldInTheCentre(plant);
  }
  return plant.MagnetForce()[0];
}

AxisArray ForceOf(const effect::EffectConfig& entry, double de_x_a, double de_x_m) {
  Plant plant(QuietWith(entry), 1);
  plant.PlaceAtRest({de_x_m});
  plant.mutable_state()[plant.layout().coil_current] = de_x_a;
  return plant.MagnetForce();
}

AxisArray ReadingOf(const effect::EffectConfig& entry, double parallel_m, double tilt_m) {
  Plant plant(QuietWith(entry), 1);
  plant.PlaceAtRest({parallel_m, 0.0, parallel_m + tilt_m, 0.0});
  return plant.SensorOutput();
}

double MovingReadingRms(const effect::EffectConfig& entry, double rate_m_per_s) {
  constexpr int kSamples = 4000;
  Plant plant = Floating(entry);
  const auto& rigid = plant.model().rigid();
  for (std::size_t i = 0; i < 2; ++i) {
    plant.mutable_state()[plant.layout().v_x + i] =
        rate_m_per_s * rigid(static_cast<Eigen::Index>(i), 0);
  }
  for (int n = 0; n < 10; ++n) plant.Advance(Off());  // the filter settles: 3 of its lags a period
  double square = 0.0;
  for (int n = 0; n < kSamples; ++n) {
    square += std::pow(plant.Sample().position_m[0] - plant.SensorOutput()[0], 2) / kSamples;
    plant.Advance(Off());
  }
  return std::sqrt(square);
}

double StandingReadingRms(const effect::EffectConfig& entry) {
  constexpr int kSamples = 20'000;
  Plant plant(QuietWith(entry), 8);
  double square = 0.0;
  for (int n = 0; n < kSamples; ++n) {
    square += std::pow(plant.Sample().position_m[0] - plant.SensorOutput()[0], 2) / kSamples;
  }
  return std::sqrt(square);
}

double StepReading(const effect::EffectConfig& entry) {
  constexpr double kShift_m = 1e-5;
  Plant plant = Floating(entry);
  const auto& rigid = plant.model().rigid();
  for (std::size_t i = 0; i < 2; ++i) {
    plant.mutable_state()[i] = kShift_m * rigid(static_cast<Eigen::Index>(i), 0);
  }
  plant.Advance(Off());
  return plant.SensorOutput()[0] / kShift_m;
}

Complex OrbitLine(const effect::EffectConfig& entry, int order) {
  Plant plant = Floating(entry);
  PlantCommand off = Off();
  off.drive_enabled = true;
  off.speed_set_point_rad_per_s = kTwoPi * 100.0;
  off.acceleration_limit_rad_per_s2 = 1.0;
  plant.SetSpeed(kTwoPi * 100.0, 0.0);
  for (double& value : plant.mutable_state()) value = 0.0;
  for (int n = 0; n < kPerTurn; ++n) plant.Advance(off);
  Complex line = 0.0;
  for (int n = 0; n < kPerTurn; ++n) {
    const AxisArray reading_m = plant.SensorOutput();
    line += Complex(reading_m[0], reading_m[1]) *
            std::polar(1.0 / kPerTurn, -order * plant.angle_rad());
    plant.Advance(off);
  }
  return line;
}

double ToneOfReading(const effect::EffectConfig& entry, double frequency_hz, double phase_rad) {
  constexpr int kSamples = 400;  // whole periods of 50 Hz
  Plant plant = Floating(entry);
  double amplitude = 0.0;
  for (int n = 0; n < kSamples; ++n) {
    amplitude += plant.SensorOutput()[0] * 2.0 / kSamples *
                 std::cos(kTwoPi * frequency_hz * n * kPeriod_s + phase_rad);
    plant.Advance(Off());
  }
  return amplitude;
}

double RotorFeels(const effect::EffectConfig& entry) {
  Plant with(QuietWith(entry), 1);
  Plant without(Quiet(), 1);
  for (Plant* plant : {&with, &without}) {
    plant->PlaceAtRest({20e-6, -30e-6, 20e-6, -30e-6});
    plant->SetSpeed(200.0, 0.3);
    for (int n = 0; n < 20; ++n) plant->Advance(DeX(0.1));
  }
  const auto mechanical = static_cast<std::ptrdiff_t>(with.layout().sensor);
  const bool same =
      std::equal(with.state().begin(), with.state().begin() + mechanical, without.state().begin());
  return same ? 0.0 : 1.0;
}

Complex ForceLine(const effect::EffectConfig& entry, int order, double direction_rad) {
  constexpr int kAngles = 64;
  const auto with = QuietWith(entry);
  std::vector<double> position(2 * kModes);
  position[kMode] = kBent * std::cos(direction_rad);
  position[kMode + kModes] = kBent * std::sin(direction_rad);
  const std::vector<double> velocity(2 * kModes);
  Complex line = 0.0;
  for (int n = 0; n < kAngles; ++n) {
    const Rotation rotation{kSpeed, kTwoPi * n / kAngles, 0.0};
    const Complex added = ForcesOf(*with, rotation, position, velocity)[kMode] -
                          ForcesOf(*Quiet(), rotation, position, velocity)[kMode];
    line += added * std::polar(1.0 / kAngles, -order * rotation.angle_rad);
  }
  return line;
}

double GyroscopicForce(double speed_rad_per_s) {
  constexpr std::size_t kTilt = 1;
  const auto with = QuietWith(Entry(effect::Id::kGyroscopicInertia, {1.5}));
  const std::vector<double> position(2 * kModes);
  std::vector<double> velocity(2 * kModes);
  velocity[kTilt] = 1.0;
  const Rotation rotation{speed_rad_per_s, 0.0, 0.0};
  return (ForcesOf(*with, rotation, position, velocity)[kTilt] -
          ForcesOf(*Quiet(), rotation, position, velocity)[kTilt])
      .imag();
}

double RubForce(double x_m) {
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.bearings[0].touchdown.journal_radius_m = 0.012;
  parameters.config.effects = {Entry(effect::Id::kTouchdownRub, {20e-6, 2e5, 0.0, 0.1})};
  const auto model = std::make_shared<const PlantModel>(std::move(parameters));
  Plant plant(model, 1);
  plant.PlaceAtRest({x_m, 0.0, x_m, 0.0});
  std::vector<double> acceleration(2 * kModes);
  ForceReport report;
  const Rotation rotation{300.0, 0.0, 0.0};
  ModalForces(*model, {}, MakeSpin(rotation, MakeHeading(rotation)), plant.state().data(),
              plant.state().data() + plant.layout().v_x, acceleration.data(), report);
  return report.bearing_n[0];
}

Complex FreePole(const effect::EffectConfig& entry, double w) {
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.effects.push_back(entry);
  for (auto& bearing : parameters.config.bearings) bearing.magnet.bias_current_a = 1e-9;
  const LinearModel linear = Linearise(PlantModel(std::move(parameters)), 0.0);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(linear.a, false);
  Complex nearest = 1e300;
  for (const Complex pole : solver.eigenvalues()) {
    if (std::abs(pole - Complex(0.0, w)) < std::abs(nearest - Complex(0.0, w))) nearest = pole;
  }
  return nearest;
}

double RigidLine(const effect::EffectConfig& entry) {
  const auto model = QuietWith(entry);
  const auto& shape = model->bearings()[0].actuator_shape;
  return shape[0] * shape[0] + shape[1] * shape[1];
}

}  // namespace levitas::plant::test
