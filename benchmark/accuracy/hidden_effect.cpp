#include "benchmark/accuracy/hidden_effect.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::accuracy {
namespace {

using effect::AmplifierId;
using effect::EffectConfig;
using effect::ExternalId;
using effect::Id;
using effect::MagnetId;
using effect::RotorId;
using effect::SensorId;
using effect::SupportId;
using effect::TimingId;

/// All but those of teeth (hidden_gear_effect.hpp) and the jitter, which a rotor never shows.
std::vector<Id> MakeIds() {
  std::vector<Id> ids;
  for (const effect::Row& row : effect::EntryRows()) {
    if (row.place != effect::Place::kGear && row.id != Id::kSampleJitter) ids.push_back(row.id);
  }
  return ids;
}

class Drawer {
 public:
  Drawer(Id id, double size, const plant::PlantParameters& nominal, Random& random)
      : size_(size), nominal_(nominal), random_(random) {
    entry_ = effect::ClearEntry(id);
  }

  std::vector<EffectConfig> Draw() {
    std::visit([this](auto id) { Set(id); }, effect::Placed(entry_.id));
    std::vector<EffectConfig> entries{entry_};
    return entries;
  }

 private:
  [[nodiscard]] double Sign() { return random_.Uniform() < 0.5 ? -1.0 : 1.0; }
  [[nodiscard]] double Between(double low, double high) {
    return low + (high - low) * random_.Uniform();
  }
  [[nodiscard]] double Phase() { return Between(-std::numbers::pi, std::numbers::pi); }
  [[nodiscard]] std::size_t Pick(std::size_t count) { return random_.Bits() % count; }
  double& Value(std::size_t at) { return entry_.values[at]; }
  /// A ratio off by the size times `clear`, to either side.
  [[nodiscard]] double Ratio(double clear) { return std::exp(Sign() * size_ * std::log1p(clear)); }
  [[nodiscard]] double Disc() {
    const auto& discs = nominal_.config.rotor.discs;
    const auto& planes = nominal_.config.unbalance;  // of a rotor that is given by its modes
    return discs.empty() ? planes[Pick(planes.size())].z_m : discs[Pick(discs.size())].z_m;
  }

  /// One axis as often as a bearing and as all.
  void Channels() {
    const std::size_t bearings = nominal_.config.bearings.size();
    switch (Pick(3)) {
      case 0:
        entry_.axes = 1U << Pick(2 * bearings);
        break;
      case 1:
        entry_.axes = 3U << (2 * Pick(bearings));
        break;
      default:
        entry_.axes = (1U << (2 * bearings)) - 1U;
        break;
    }
  }
  void AllChannels() { entry_.axes = (1U << (2 * nominal_.config.bearings.size())) - 1U; }
  void OneChannel() { entry_.axes = 1U << Pick(2 * nominal_.config.bearings.size()); }
  void Bearing() { entry_.bearing = Pick(nominal_.config.bearings.size()); }

  // What is drawn of each effect. No default: the compiler names a new one here.
  void Set(TimingId id) {
    switch (id) {
      case TimingId::kExtraDelay:
        Value(0) = 80e-6 * size_;
        break;
      case TimingId::kDroppedSamples:
        Value(0) = 0.004 * size_;
        Value(1) = static_cast<double>(1 + Pick(2));
        break;
      case TimingId::kSampleJitter:
        Clear();
        break;
    }
  }

  void Set(AmplifierId id) {
    switch (id) {
      case AmplifierId::kCurrentGain:
        Channels();
        Value(0) = Ratio(0.25);
        break;
      case AmplifierId::kAmplifierBandwidth:
        Channels();
        Value(0) = nominal_.config.bearings[0].amplifier.bandwidth_hz * Ratio(0.8);
        break;
      case AmplifierId::kAmplifierSlew:
        AllChannels();
        Value(0) = 5000.0 / std::sqrt(size_);
        break;
      case AmplifierId::kCommandOffset:
        Clear();
        break;
    }
  }

  /// Every parameter off by the size times what is clear, to either side; for an effect that needs
  /// no more than that.
  void Clear() {
    const effect::Row& row = effect::At(entry_.id);
    if (row.scope == effect::Scope::kChannels) Channels();
    if (row.scope == effect::Scope::kBearing) Bearing();
    for (std::size_t i = 0; i < row.parameters.size(); ++i) {
      const effect::Parameter& p = row.parameters[i];
      if (p.scaling != effect::Scaling::kLinear) continue;
      Value(i) = p.neutral + Sign() * size_ * (p.clear - p.neutral);
    }
  }

  void Set(MagnetId id) {
    switch (id) {
      case MagnetId::kDisplacementStiffness:
        Channels();
        Value(0) = 1.0 + Sign() * 0.3 * size_;
        break;
      case MagnetId::kCoilAsymmetry:
        Channels();
        Value(0) = Ratio(0.45);
        break;
      case MagnetId::kMagneticSaturation:
        AllChannels();
        Value(0) = 2.3 / std::sqrt(std::sqrt(size_));
        Value(1) = Between(3.0, 6.0);
        break;
      case MagnetId::kHysteresis:
        AllChannels();
        Value(0) = 0.005 * size_;
        Value(1) = Between(0.5, 1.5);
        break;
      case MagnetId::kEddyCurrent:
        Channels();
        Value(0) = 10e-6 * size_ * size_;
        break;
      case MagnetId::kAxisRotation:
        Rotation();
        break;
      case MagnetId::kForceConstant:
      case MagnetId::kMagneticCoupling:
        Clear();
        break;
    }
  }

  void Rotation() {
    Bearing();
    entry_.on_sensor = Pick(2) == 0;
    Value(0) = Sign() * 0.02 * size_;
  }

  void Set(SensorId id) {
    switch (id) {
      case SensorId::kSensorGain:
        Channels();
        Value(0) = Ratio(0.22);
        break;
      case SensorId::kSensorOffset:
        OneChannel();
        Value(0) = Sign() * 85e-6 * size_;
        break;
      case SensorId::kSensorNonlinearity:
        Channels();
        Value(0) = Sign() * 1.5e3 * size_;
        Value(1) = Sign() * 4e7 * size_;
        break;
      case SensorId::kSensorBandwidth:
        Channels();
        Value(0) = nominal_.config.bearings[0].sensor.bandwidth_hz / (1.0 + 2.5 * size_);
        break;
      case SensorId::kSensorPosition:
        Bearing();
        Value(0) = Sign() * 6e-3 * size_;
        break;
      case SensorId::kSensorRunout:
        Channels();
        Value(0) = static_cast<double>(1 + Pick(3));
        Value(1) = (Value(0) == 1.0 ? 10e-6 : 0.5e-6) * size_;
        Value(2) = Phase();
        break;
      case SensorId::kMainsPickup:
        Channels();
        Value(0) = Pick(2) == 0 ? 50.0 : 60.0;
        Value(1) = 0.1e-6 * size_;
        Value(2) = Phase();
        break;
      case SensorId::kSensorNoise:
        Channels();
        Value(0) = nominal_.config.bearings[0].sensor.noise_rms_m * (1.0 + 0.6 * size_);
        Value(1) = 0.0;
        break;
    }
  }

  void Set(RotorId id) {
    switch (id) {
      case RotorId::kUnbalance:
        Value(0) = Disc();
        Value(1) = 40e-6 * size_;
        Value(2) = Phase();
        break;
      case RotorId::kShaftBow:
        entry_.mode = 1;
        Value(0) = 35e-6 * size_;
        Value(1) = Phase();
        break;
      case RotorId::kShaftAnisotropy:
        Value(0) = 0.006 * size_;
        Value(1) = Phase();
        break;
      case RotorId::kModalFrequency:
        Mode();
        Value(0) = OwnFrequency() * Ratio(0.1);
        break;
      case RotorId::kModalDamping:
        Mode();
        Value(0) = 0.003 * (1.0 + 12.0 * size_);
        break;
      case RotorId::kGyroscopicInertia:
        Value(0) = 1.0 + Sign() * 0.3 * size_;
        break;
      case RotorId::kInternalDamping:
        Value(0) = nominal_.config.rotor.discs[1].z_m;
        Value(1) = 20.0 * size_;
        break;
      case RotorId::kRotorMass:
        Value(0) = Ratio(0.14);
        break;
      case RotorId::kBreathingCrack:
        Value(0) = Between(0.2, 0.36);
        Value(1) = std::min(0.5, 0.35 * std::sqrt(size_));
        Value(2) = Phase();
        break;
    }
  }

  void Mode() {
    const auto modes = static_cast<std::size_t>(nominal_.modes.frequency_rad_per_s.size());
    entry_.mode = 1 + Pick(std::min<std::size_t>(4, modes - 2));
  }
  [[nodiscard]] double OwnFrequency() const {
    return nominal_.modes.frequency_rad_per_s[static_cast<Eigen::Index>(entry_.mode + 1)] /
           (2.0 * std::numbers::pi);
  }

  void Set(ExternalId id) {
    switch (id) {
      case ExternalId::kMisalignment: {
        constexpr std::array kOrders{2.0, -2.0, 3.0, -3.0};
        Value(1) = kOrders[Pick(kOrders.size())];
        Value(2) = 0.6 * size_;
        Value(3) = Phase();
        break;
      }
      case ExternalId::kCouplingStiffness:
        Value(1) = 3e3 * size_;
        Value(2) = Between(-0.5, 0.5) * Value(1);
        Value(3) = Between(-0.2, 0.2) * Value(1);
        break;
      case ExternalId::kCrossCoupledStiffness:
        Value(0) = nominal_.config.rotor.discs[1].z_m;
        Value(1) = Sign() * 8e3 * size_;
        break;
      case ExternalId::kStaticLoad: {
        const double angle = Phase();
        Value(0) = Disc();
        Value(1) = 8.0 * size_ * std::cos(angle);
        Value(2) = 8.0 * size_ * std::sin(angle);
        break;
      }
    }
  }

  void Set(SupportId id) {
    switch (id) {
      case SupportId::kSupportMode:
        Bearing();
        Value(0) = 4.0 / size_;
        Value(1) = 50.0 * std::pow(5.0, random_.Uniform());
        Value(2) = Between(0.01, 0.04);
        break;
      case SupportId::kTouchdownRub:
        Bearing();
        Value(0) = Between(9e-6, 14e-6);
        Value(1) = 3e4 * size_;
        Value(2) = Between(0.0, 50.0);
        Value(3) = Between(0.05, 0.2);
        break;
    }
  }

  [[noreturn]] void Set(effect::GearId /*id*/) const {
    throw std::logic_error(fmt::format("{}: DrawGearEffect() draws it (hidden_gear_effect.hpp)",
                                       effect::At(entry_.id).name));
  }
  [[noreturn]] void Set(effect::CoilId /*id*/) const { RefuseOtherRigs(); }
  [[noreturn]] void Set(effect::BallId /*id*/) const { RefuseOtherRigs(); }
  [[noreturn]] void RefuseOtherRigs() const {
    const effect::Row& row = effect::At(entry_.id);
    throw std::logic_error(fmt::format("{}: {}", row.name, effect::InPlaceOfAnEntry(row)));
  }

  double size_;
  const plant::PlantParameters& nominal_;
  Random& random_;
  EffectConfig entry_;
};

}  // namespace

std::span<const effect::Id> HiddenIds() {
  static const std::vector<Id> kIds = MakeIds();
  return kIds;
}

std::vector<EffectConfig> DrawEffect(Id id, double size, const plant::PlantParameters& nominal,
                                     Random& random) {
  return Drawer(id, size, nominal, random).Draw();
}

}  // namespace levitas::accuracy
