#include "benchmark/accuracy/perturbed_rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>

#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

using effect::EffectConfig;
using effect::Id;

/// How a hidden effect joins one that the healthy rig has at the same place.
enum class Joining : std::uint8_t {
  kMultiplies,
  kMultipliesBandwidth,
  kAdds,
  kAddsForce,  ///< on the same plane
  kStaysApart  ///< an entry of its own
};

/// No default where a healthy rig is off (Mismatch): the compiler names a new effect there.
struct JoiningOf {
  // The mismatch has no entry of these: delay and meshes are off in the configuration.
  Joining operator()(effect::TimingId /*id*/) const { return Joining::kStaysApart; }
  Joining operator()(effect::SupportId /*id*/) const { return Joining::kStaysApart; }
  Joining operator()(effect::GearId /*id*/) const { return Joining::kStaysApart; }
  Joining operator()(effect::CoilId /*id*/) const { return Joining::kStaysApart; }
  Joining operator()(effect::BallId /*id*/) const { return Joining::kStaysApart; }

  Joining operator()(effect::AmplifierId id) const {
    using effect::AmplifierId;
    switch (id) {
      case AmplifierId::kCurrentGain:
        return Joining::kMultiplies;
      case AmplifierId::kAmplifierBandwidth:
        return Joining::kMultipliesBandwidth;
      case AmplifierId::kAmplifierSlew:
      case AmplifierId::kCommandOffset:
        break;
    }
    return Joining::kStaysApart;
  }

  Joining operator()(effect::MagnetId id) const {
    using effect::MagnetId;
    switch (id) {
      case MagnetId::kDisplacementStiffness:
        return Joining::kMultiplies;
      case MagnetId::kForceConstant:
      case MagnetId::kCoilAsymmetry:
      case MagnetId::kMagneticSaturation:
      case MagnetId::kHysteresis:
      case MagnetId::kEddyCurrent:
      case MagnetId::kMagneticCoupling:
      case MagnetId::kAxisRotation:
        break;
    }
    return Joining::kStaysApart;
  }

  Joining operator()(effect::RotorId id) const {
    using effect::RotorId;
    switch (id) {
      case RotorId::kRotorMass:
      case RotorId::kGyroscopicInertia:
        return Joining::kMultiplies;
      case RotorId::kUnbalance:
      case RotorId::kShaftBow:
      case RotorId::kShaftAnisotropy:
      case RotorId::kModalFrequency:
      case RotorId::kModalDamping:
      case RotorId::kInternalDamping:
      case RotorId::kBreathingCrack:
        break;
    }
    return Joining::kStaysApart;
  }

  Joining operator()(effect::ExternalId id) const {
    using effect::ExternalId;
    switch (id) {
      case ExternalId::kStaticLoad:
        return Joining::kAddsForce;
      case ExternalId::kMisalignment:
      case ExternalId::kCouplingStiffness:
      case ExternalId::kCrossCoupledStiffness:
        break;
    }
    return Joining::kStaysApart;
  }

  Joining operator()(effect::SensorId id) const {
    using effect::SensorId;
    switch (id) {
      case SensorId::kSensorGain:
        return Joining::kMultiplies;
      case SensorId::kSensorOffset:
      case SensorId::kSensorPosition:
        return Joining::kAdds;
      case SensorId::kSensorNonlinearity:
      case SensorId::kSensorBandwidth:
      case SensorId::kSensorRunout:
      case SensorId::kMainsPickup:
      case SensorId::kSensorNoise:
        break;
    }
    return Joining::kStaysApart;
  }
};

class Maker {
 public:
  Maker(const plant::PlantConfig& nominal, const Mismatch& off, Random& random)
      : off_(off), random_(random), config_(nominal), nominal_gears_(nominal.gears) {
    config_.rotor.modes_per_plane += 2;
    config_.substeps = 7;
  }

  plant::PlantParameters Make(const std::vector<EffectConfig>& hidden) {
    config_.delay_samples += Off(off_.delay_samples);
    for (auto& mass : config_.unbalance) Unbalance(mass);
    for (std::size_t b = 0; b < config_.bearings.size(); ++b) Bearing(b);
    if (!config_.shafts.empty()) return MakeGeared(hidden);
    for (const auto& disc : config_.rotor.discs) {
      Add(Id::kStaticLoad,
          {WithinBearings(disc.z_m), Off(off_.static_load_n), Off(off_.static_load_n)});
    }
    Add(Id::kRotorMass, {1.0 + Off(off_.rotor_mass)});
    Add(Id::kGyroscopicInertia, {1.0 + Off(off_.gyroscopic_inertia)});
    plant::PlantParameters parameters = plant::Reduce(config_);
    Modes(parameters.modes);
    if (off_.transverse_inertia > 0.0) {
      ScaleInertia(1.0 + Off(off_.transverse_inertia), parameters.modes);
    }
    for (const EffectConfig& entry : hidden) Join(entry, parameters.modes);
    parameters.config.effects = config_.effects;
    return parameters;
  }

 private:
  /// What refers to the modes and planes of one rotor has no place here.
  plant::PlantParameters MakeGeared(const std::vector<EffectConfig>& hidden) {
    Spoil(config_, off_.train, random_);
    plant::PlantParameters parameters = plant::Reduce(config_);
    for (const EffectConfig& entry : hidden) Join(entry, parameters.modes);
    for (EffectConfig& entry : config_.effects) {
      if (entry.id != Id::kMeshStiffness) continue;
      // The drawn values refer to the nominal mesh; the healthy rig's is off already.
      const gear::GearPair& own = config_.gears[entry.gear];
      const gear::GearPair& file = nominal_gears_[entry.gear];
      entry.values[0] *= own.stiffness_n_per_m / file.stiffness_n_per_m;
      entry.values[1] *= own.damping_n_s_per_m / file.damping_n_s_per_m;
    }
    parameters.config.effects = config_.effects;
    return parameters;
  }

  /// A tolerance of load is one of what a bearing carries. On an overhung disc it would act on the
  /// nearest bearing by a lever, and the rig would not be healthy by its own file.
  [[nodiscard]] double WithinBearings(double z_m) const {
    const auto& first = config_.bearings.front();
    const auto& last = config_.bearings.back();
    const auto [low, high] = std::minmax(first.actuator_z_m, last.actuator_z_m);
    return std::clamp(z_m, low, high);
  }

  [[nodiscard]] double Off(double deviation) {
    return deviation * std::clamp(random_.Normal(), -2.0, 2.0);
  }

  void Add(Id id, std::initializer_list<double> values, std::uint32_t axes = effect::kAllAxes,
           std::size_t bearing = 0) {
    EffectConfig entry;
    entry.id = id;
    entry.axes = axes;
    entry.bearing = bearing;
    std::copy(values.begin(), values.end(), entry.values.begin());
    config_.effects.push_back(entry);
  }

  void Unbalance(plant::UnbalanceMass& mass) {
    const double x = mass.moment_kg_m * std::cos(mass.phase_rad) + Off(off_.unbalance_kg_m);
    const double y = mass.moment_kg_m * std::sin(mass.phase_rad) + Off(off_.unbalance_kg_m);
    mass.moment_kg_m = std::hypot(x, y);
    mass.phase_rad = std::atan2(y, x);
  }

  void Bearing(std::size_t b) {
    auto& bearing = config_.bearings[b];
    for (std::size_t axis = 2 * b; axis < 2 * b + 2; ++axis) {
      const std::uint32_t one = 1U << axis;
      Add(Id::kCurrentGain, {1.0 + Off(off_.current_gain)}, one);
      Add(Id::kDisplacementStiffness, {1.0 + Off(off_.displacement_stiffness)}, one);
      Add(Id::kAmplifierBandwidth,
          {bearing.amplifier.bandwidth_hz * (1.0 + Off(off_.amplifier_bandwidth))}, one);
      Add(Id::kSensorGain, {1.0 + Off(off_.sensor_gain)}, one);
      Add(Id::kSensorOffset, {Off(off_.sensor_offset_m)}, one);
      const double phase = std::numbers::pi * (2.0 * random_.Uniform() - 1.0);
      Add(Id::kSensorRunout, {1.0, std::abs(Off(1.4 * off_.sensor_runout_m)), phase}, one);
    }
    bearing.sensor.bandwidth_hz *= 1.0 + Off(off_.sensor_bandwidth);
    if (!config_.shafts.empty()) return;
    Add(Id::kSensorPosition, {Off(off_.sensor_position_m)}, effect::kAllAxes, b);
  }

  void Modes(rotor::ModalRotor& modes) {
    for (Eigen::Index i = 2; i < modes.frequency_rad_per_s.size(); ++i) {
      modes.frequency_rad_per_s[i] *= 1.0 + Off(off_.modal_frequency);
      modes.damping_ratio[i] *= std::exp(Off(off_.modal_damping));
      // A shape that is off by a smooth bend of the shaft.
      const double size =
          std::sqrt(modes.shapes.col(i).squaredNorm() / static_cast<double>(modes.shapes.rows()));
      const double bend = Off(off_.modal_shape);
      const double tilt = Off(off_.modal_shape);
      const double length_m = modes.node_z_m.back();
      for (Eigen::Index n = 0; n < modes.shapes.rows(); ++n) {
        const double z = modes.node_z_m[static_cast<std::size_t>(n)] / length_m;
        modes.shapes(n, i) +=
            size * (bend * std::sin(std::numbers::pi * z) + tilt * (2.0 * z - 1.0));
      }
    }
  }

  /// The tilt is one direction among the rigid modes: along it every shape shrinks by sqrt(ratio).
  static void ScaleInertia(double ratio, rotor::ModalRotor& modes) {
    const Eigen::VectorXd shift = modes.rigid.col(0).normalized();
    const Eigen::VectorXd slope = modes.rigid.col(1);
    const Eigen::VectorXd tilt = (slope - slope.dot(shift) * shift).normalized();
    const Eigen::MatrixXd along = tilt * tilt.transpose();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(along.rows(), along.cols());
    const Eigen::MatrixXd shrink = unit + (1.0 / std::sqrt(ratio) - 1.0) * along;
    modes.shapes *= shrink;
    modes.slopes *= shrink;
    modes.gyroscopic = shrink * modes.gyroscopic * shrink;
    modes.rigid = (unit + (std::sqrt(ratio) - 1.0) * along) * modes.rigid;
  }

  /// An effect on top of what the healthy rig is off by.
  void Join(const EffectConfig& entry, const rotor::ModalRotor& modes) {
    const Joining joining = std::visit(JoiningOf{}, effect::Placed(entry.id));
    bool joined = false;
    for (EffectConfig& own : config_.effects) {
      if (own.id != entry.id || !Meets(own, entry)) continue;
      switch (joining) {
        case Joining::kMultiplies:
          own.values[0] *= entry.values[0];
          joined = true;
          break;
        case Joining::kMultipliesBandwidth:
          own.values[0] *= entry.values[0] / config_.bearings[0].amplifier.bandwidth_hz;
          joined = true;
          break;
        case Joining::kAdds:
          own.values[0] += entry.values[0];
          joined = true;
          break;
        case Joining::kAddsForce:
          if (own.values[0] != entry.values[0]) break;
          own.values[1] += entry.values[1];
          own.values[2] += entry.values[2];
          joined = true;
          break;
        case Joining::kStaysApart:
          break;
      }
    }
    if (joined) return;
    config_.effects.push_back(entry);
    EffectConfig& added = config_.effects.back();
    const auto mode = static_cast<Eigen::Index>(entry.mode + 1);
    if (entry.id == Id::kModalFrequency) {
      // The drawn value refers to the nominal mode; the healthy rig's is off already.
      const double own_hz = modes.frequency_rad_per_s[mode] / (2.0 * std::numbers::pi);
      added.values[0] = std::max(1.0, added.values[0] * own_hz / nominal_hz(mode));
    }
  }

  [[nodiscard]] double nominal_hz(Eigen::Index mode) const {
    return plant::Reduce(config_).modes.frequency_rad_per_s[mode] / (2.0 * std::numbers::pi);
  }

  [[nodiscard]] static bool Meets(const EffectConfig& own, const EffectConfig& entry) {
    return entry.id == Id::kSensorPosition ? own.bearing == entry.bearing
                                           : (own.axes & entry.axes) != 0U;
  }

  const Mismatch& off_;
  Random& random_;
  plant::PlantConfig config_;
  std::vector<gear::GearPair> nominal_gears_;
};

}  // namespace

plant::PlantParameters PerturbedRig(const plant::PlantConfig& nominal, const Mismatch& mismatch,
                                    const std::vector<EffectConfig>& hidden, Random& random) {
  return Maker(nominal, mismatch, random).Make(hidden);
}

}  // namespace levitas::accuracy
