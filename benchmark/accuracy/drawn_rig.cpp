#include "benchmark/accuracy/drawn_rig.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <variant>

#include "common/problem.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

constexpr int kConverterBits = 18;

/// A shaft with journals under the magnets and a disc.
struct Rotor {
  double length_m, diameter_m;
  double first_z_m, second_z_m;
  double journal_kg, journal_radius_m;
  double disc_z_m, disc_kg, disc_radius_m;
};

constexpr std::array kRotors{
    Rotor{0.80, 0.030, 0.12, 0.68, 1.5, 0.035, 0.42, 5.0, 0.09},   // machine: 13 kg
    Rotor{0.36, 0.028, 0.07, 0.24, 0.7, 0.030, 0.335, 1.4, 0.06},  // overhung: 4.6 kg
    Rotor{0.42, 0.032, 0.09, 0.33, 0.8, 0.030, 0.22, 0.9, 0.05},   // spindle: 5.2 kg
};

double Between(Random& random, double low, double high) {
  return low + (high - low) * random.Uniform();
}
double LogBetween(Random& random, double low, double high) {
  return low * std::pow(high / low, random.Uniform());
}

rotor::Disc Solid(double z_m, double mass_kg, double radius_m) {
  const double polar = 0.5 * mass_kg * radius_m * radius_m;
  return {z_m, mass_kg, 0.55 * polar, polar};
}

/// Geometry in place of the file's; the masses are those of steel.
void Build(const Rotor& shape, Random& random, plant::PlantConfig& plant) {
  constexpr double kProbeBesideM = 4e-3;
  constexpr double kUnbalanceM = 4e-6;  // of the disc's mass
  const double stretch = Between(random, 0.9, 1.1);
  const double thickness = Between(random, 0.95, 1.1);
  rotor::RotorConfig& rotor = plant.rotor;
  rotor.sections = {{stretch * shape.length_m, thickness * shape.diameter_m, 0.0}};
  rotor.rings.clear();
  rotor.discs = {Solid(stretch * shape.first_z_m, shape.journal_kg, shape.journal_radius_m),
                 Solid(stretch * shape.disc_z_m, shape.disc_kg * Between(random, 0.8, 1.2),
                       shape.disc_radius_m),
                 Solid(stretch * shape.second_z_m, shape.journal_kg, shape.journal_radius_m)};
  plant.unbalance.clear();
  for (const rotor::Disc& disc : rotor.discs) {
    plant.unbalance.push_back(
        {disc.z_m, kUnbalanceM * disc.mass_kg, Between(random, -3.0, 3.0), 0});
  }
  const double gap_m = Between(random, 0.3e-3, 0.6e-3);
  for (std::size_t b = 0; b < 2; ++b) {
    plant::BearingConfig& bearing = plant.bearings[b];
    bearing.actuator_z_m = rotor.discs[2 * b].z_m;
    bearing.sensor_z_m = bearing.actuator_z_m + (b == 0 ? -kProbeBesideM : kProbeBesideM);
    bearing.magnet.gap_m = gap_m;
    bearing.amplifier.bandwidth_hz = Between(random, 1500.0, 3000.0);
    bearing.sensor.bandwidth_hz = Between(random, 5000.0, 10000.0);
  }
}

double MassOf(const rotor::RotorConfig& rotor) {
  double mass = 0.0;
  for (const rotor::Section& s : rotor.sections) {
    mass += rotor.material.density_kg_per_m3 * 0.25 * std::numbers::pi * s.length_m *
            s.outer_diameter_m * s.outer_diameter_m;
  }
  return std::accumulate(rotor.discs.begin(), rotor.discs.end(), mass,
                         [](double sum, const rotor::Disc& d) { return sum + d.mass_kg; });
}

/// All masses and stiffnesses times `by`: modes keep their frequency and shape.
void ScaleWeight(double by, plant::PlantConfig& plant) {
  plant.rotor.material.young_pa *= by;
  plant.rotor.material.density_kg_per_m3 *= by;
  for (rotor::Disc& disc : plant.rotor.discs) {
    disc.mass_kg *= by;
    disc.diametral_inertia_kg_m2 *= by;
    disc.polar_inertia_kg_m2 *= by;
  }
  for (plant::UnbalanceMass& mass : plant.unbalance) mass.moment_kg_m *= by;
}

void SetForce(double force_n, plant::PlantConfig& plant) {
  for (plant::BearingConfig& bearing : plant.bearings) {
    plant::MagnetConfig& magnet = bearing.magnet;
    // ki i0 = 4 k i0^2/s0^2
    magnet.force_constant_n_m2_per_a2 =
        force_n * std::pow(magnet.gap_m / magnet.bias_current_a, 2) / 4.0;
  }
}

law::LawConfig TextbookLaw(const law::LawConfig& limits, const plant::PlantConfig& plant,
                           double force_n, double mass_kg) {
  constexpr double kDamping = 0.6;
  constexpr double kIntegratorPerS = 5.0;
  const plant::MagnetConfig& magnet = plant.bearings.front().magnet;
  const double ki = force_n / magnet.bias_current_a;
  const double ks = force_n / magnet.gap_m;
  law::AxisLawConfig axis;
  axis.kp_a_per_m = 2.0 * ks / ki;
  axis.ki_a_per_m_s = kIntegratorPerS * axis.kp_a_per_m;
  axis.kd_a_s_per_m = 2.0 * kDamping * std::sqrt(ks * 0.5 * mass_kg) / ki;
  axis.derivative_hz = 2500.0;
  law::LawConfig law = limits;
  law.state_space.reset();
  law.schedule.clear();
  law.axes.assign(2 * plant.bearings.size(), axis);
  return law;
}

/// What scales a size that DrawEffect has in newtons, kilograms or micrometres of a probe. No
/// default at a place that has such sizes: the compiler names a new effect there.
struct ScaleOf {
  double weight{}, force{}, noise{};

  // Times, ratios and currents.
  double operator()(effect::TimingId /*id*/) const { return 1.0; }
  double operator()(effect::AmplifierId /*id*/) const { return 1.0; }
  double operator()(effect::MagnetId /*id*/) const { return 1.0; }
  // No drawn rig has gears, coils on a voltage or a ball.
  double operator()(effect::GearId /*id*/) const { return 1.0; }
  double operator()(effect::CoilId /*id*/) const { return 1.0; }
  double operator()(effect::BallId /*id*/) const { return 1.0; }

  double operator()(effect::RotorId id) const {
    using effect::RotorId;
    switch (id) {
      case RotorId::kUnbalance:
      case RotorId::kInternalDamping:
        return weight;
      case RotorId::kShaftBow:
      case RotorId::kShaftAnisotropy:
      case RotorId::kModalFrequency:
      case RotorId::kModalDamping:
      case RotorId::kGyroscopicInertia:
      case RotorId::kRotorMass:
      case RotorId::kBreathingCrack:
        break;
    }
    return 1.0;
  }

  double operator()(effect::ExternalId id) const {
    using effect::ExternalId;
    switch (id) {
      case ExternalId::kStaticLoad:
      case ExternalId::kMisalignment:
      case ExternalId::kCouplingStiffness:
      case ExternalId::kCrossCoupledStiffness:
        break;
    }
    return force;
  }

  double operator()(effect::SupportId id) const {
    using effect::SupportId;
    switch (id) {
      case SupportId::kTouchdownRub:
        return force;
      case SupportId::kSupportMode:
        break;
    }
    return 1.0;
  }

  double operator()(effect::SensorId id) const {
    using effect::SensorId;
    switch (id) {
      case SensorId::kMainsPickup:
        return noise;
      case SensorId::kSensorGain:
      case SensorId::kSensorOffset:
      case SensorId::kSensorNonlinearity:
      case SensorId::kSensorBandwidth:
      case SensorId::kSensorPosition:
      case SensorId::kSensorRunout:
      case SensorId::kSensorNoise:
        break;
    }
    return 1.0;
  }
};

void ScaleSizes(const ScaleOf& scale, RigTrials& trials) {
  for (SizeOnRig& entry : trials.effects) {
    entry.factor *= std::visit(scale, effect::Placed(entry.id));
  }
}

}  // namespace

bool CanBeDrawn(const configuration::RigFile& rig) noexcept {
  const plant::PlantConfig& plant = rig.plant;
  return plant.shafts.empty() && plant.bearings.size() == 2 && !plant.rotor.given &&
         !plant.rotor.sections.empty() && plant.rotor.discs.size() == 3;
}

TestRig DrawRig(const TestRig& shipped, Random& random) {
  TestRig drawn = shipped;
  plant::PlantConfig& plant = drawn.rig.plant;
  const plant::MagnetConfig file = plant.bearings.front().magnet;
  const double file_force_n =
      4.0 * file.force_constant_n_m2_per_a2 * std::pow(file.bias_current_a / file.gap_m, 2);
  const double file_kg = MassOf(plant.rotor);
  const double force_n = LogBetween(random, kLeastForceN, kMostForceN);
  const double noise_m = LogBetween(random, kLeastNoiseM, kMostNoiseM);
  const std::size_t which = random.Bits() % (kRotors.size() + 1);
  for (plant::BearingConfig& bearing : plant.bearings) {
    bearing.sensor.noise_rms_m = noise_m;
    bearing.sensor.adc_bits = kConverterBits;
  }
  if (which < kRotors.size()) {
    // Half the weight is a seventh to a third of what the bias lets a magnet push with.
    const double per_weight = LogBetween(random, 3.0, 7.0);
    Build(kRotors[which], random, plant);
    ScaleWeight(2.0 * force_n / (plant.gravity_m_per_s2 * per_weight * MassOf(plant.rotor)), plant);
  } else {
    ScaleWeight(force_n / file_force_n, plant);
  }
  SetForce(force_n, plant);
  const double mass_kg = MassOf(plant.rotor);
  if (which < kRotors.size()) {
    const configuration::ControllerFile& controller = shipped.controllers.front();
    drawn.controllers = {{.name = "textbook",
                          .law = TextbookLaw(controller.law, plant, force_n, mass_kg),
                          .supervisor = controller.supervisor}};
  }
  const double weight = mass_kg / file_kg;
  configuration::Tolerances tolerances = drawn.rig.tolerances.value_or(configuration::Tolerances{});
  tolerances.unbalance_kg_m *= weight;
  tolerances.static_load_n *= force_n / file_force_n;
  drawn.rig.tolerances = tolerances;
  drawn.trials.mismatch.unbalance_kg_m *= weight;
  drawn.trials.mismatch.static_load_n *= force_n / file_force_n;
  ScaleSizes({weight, force_n / file_force_n, noise_m / 1e-6}, drawn.trials);
  return drawn;
}

Trial MakeDrawnTrial(const TestRig& shipped, const TrialPlan& plan) {
  if (!CanBeDrawn(shipped.rig)) return MakeTrial(shipped, plan);
  constexpr int kMostRigs = 40;
  constexpr std::uint64_t kOwnSequence = 0x5DEECE66DULL;  // not that of the trial itself
  Random random(plan.seed ^ kOwnSequence);
  for (int i = 0; i < kMostRigs; ++i) {
    const TestRig rig = DrawRig(shipped, random);
    if (std::optional<Trial> trial = TryTrial(rig, plan)) return *std::move(trial);
  }
  throw BadInput("none of the rigs drawn for this trial levitates");
}

}  // namespace levitas::accuracy
