#include "diagnosis/report/effect_entry.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>

#include "configuration/schema/unit.hpp"
#include "diagnosis/report/gear_entry.hpp"
#include "diagnosis/terms/terms.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

EntryValue Number(std::string key, double value, int digits = 6) {
  return {std::move(key), value, digits};
}

/// The unit that a key ends in; null for a pure number.
const configuration::Unit* FindUnit(const std::string& key) {
  const configuration::Unit* longest = nullptr;
  for (const configuration::Unit& unit : configuration::AllUnits()) {
    const std::string ending = fmt::format("_{}", unit.suffix);
    if (unit.suffix.empty() || !key.ends_with(ending)) continue;
    if (longest == nullptr || unit.suffix.size() > longest->suffix.size()) longest = &unit;
  }
  return longest;
}

/// Of an effect whose term is named by the parameters of the catalogue and counts from neutral.
EntryValues CatalogueEntry(const effect::Row& row, const PlacedEffect& at) {
  EntryValues values;
  for (const effect::Parameter& p : row.parameters) {
    const std::string key = effect::FileKey(p);
    const double value = p.neutral + at.At(effect::SiName(p));
    values.push_back(Number(key, value / UnitOfKey(key).si));
  }
  return values;
}

EntryValues MagnetEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  const double bias_a = rig.bias_a(0);
  if (id == Id::kCoilAsymmetry) {
    const double a = std::clamp(0.5 * at.At("ratio"), -0.6, 0.6);
    return {Number("ratio", (1.0 + a) / (1.0 - a))};
  }
  if (id == Id::kMagneticSaturation) {
    // Amplitude to knee current: well below the knee the force loss goes as (i/knee)^exponent.
    const double share = std::max(1e-3, at.At("share"));
    const double knee_share = at.shape.at(0);
    const double exponent = at.shape.at(1);
    return {Number("knee_a", knee_share * bias_a * std::pow(share, -1.0 / exponent)),
            Number("exponent", exponent)};
  }
  if (id == Id::kHysteresis) {
    return {Number("width_a", at.shape.at(0) * bias_a * std::max(0.0, at.At("share")))};
  }
  if (id == Id::kEddyCurrent) {
    const bool current_alone = at.theta.contains(kRootTauOfCurrent);
    const double root = std::max(0.0, at.At(current_alone ? kRootTauOfCurrent : kRootTau));
    EntryValues values{Number("tau_us", 1e6 * root * root)};
    if (current_alone) values.push_back(Number("displacement_share", 0.0));
    return values;
  }
  if (id == Id::kAxisRotation) {
    return {Number("angle_deg", at.At("angle_rad") * 180.0 / std::numbers::pi)};
  }
  return CatalogueEntry(effect::At(id), at);
}

EntryValues SensorEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  if (id == Id::kSensorOffset) return {Number("offset_um", 1e6 * at.At("offset_m"))};
  if (id == Id::kSensorNonlinearity) {
    return {Number("a2_1_per_m", at.At("a2")), Number("a3_1_per_m2", at.At("a3"))};
  }
  if (id == Id::kSensorPosition) return {Number("shift_mm", 1e3 * at.At("shift_m"))};
  if (id == Id::kSensorRunout) {
    const int order = at.location.order.value();
    const bool y_probe = at.location.axis.value() % 2 == 1;
    const double phase = -at.Phase() + (y_probe ? order * 0.5 * std::numbers::pi : 0.0);
    return {Number("order", order), Number("amplitude_um", 1e6 * at.Amplitude()),
            PhaseValue(std::remainder(phase, 2.0 * std::numbers::pi))};
  }
  if (id == Id::kMainsPickup) {
    return {Number("frequency_hz", at.location.frequency_hz.value()),
            Number("amplitude_um", 1e6 * at.Amplitude()), PhaseValue(0.0)};
  }
  if (id == Id::kSensorBandwidth) {
    return {Number("bandwidth_hz", rig.bearing(at.location.axis.value()).sensor.bandwidth_hz /
                                       std::max(0.05, 1.0 + at.At("lag_ratio")))};
  }
  return {Number("ratio", 1.0 + at.At("ratio"))};
}

EntryValues RotorEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  if (id == Id::kUnbalance) {
    return {Number("z_mm", 1e3 * at.location.z_m.value()),
            Number("moment_g_mm", 1e6 * at.Amplitude()), PhaseValue(at.Phase())};
  }
  if (id == Id::kShaftBow) {
    return {Number("amplitude_um", 1e6 * at.Amplitude()), PhaseValue(at.Phase())};
  }
  if (id == Id::kShaftAnisotropy) {
    return {Number("ratio", at.Amplitude()), PhaseValue(0.5 * at.Phase())};
  }
  if (id == Id::kModalFrequency) {
    const double own_rad_per_s = rig.omega_rad_per_s[at.location.mode.value() + 1];
    return {Number("frequency_hz",
                   own_rad_per_s / (2.0 * std::numbers::pi) * (1.0 + at.At("ratio")), 8)};
  }
  if (id == Id::kModalDamping) {
    const double own = rig.damping_ratio[at.location.mode.value() + 1];
    return {Number("damping_ratio", std::max(0.0, own * (1.0 + at.At("ratio"))))};
  }
  if (id == Id::kBreathingCrack) {
    const double z_m = at.shape.at(0);
    const double direction_rad = at.shape.at(1);
    return {Number("z_mm", 1e3 * z_m), Number("depth", CrackDepth(rig, z_m, at.At("softening"))),
            PhaseValue(std::remainder(direction_rad, 2.0 * std::numbers::pi))};
  }
  if (id == Id::kInternalDamping) {
    return {Number("z_mm", 1e3 * at.location.z_m.value()),
            Number("damping_n_s_per_m", at.At("damping"))};
  }
  return {Number("ratio", 1.0 + at.At("ratio"))};
}

EntryValues AmplifierEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  if (id == Id::kAmplifierSlew) return {Number("slew_a_per_s", at.shape.at(0))};
  return {Number("bandwidth_hz", rig.bearing(at.location.axis.value()).amplifier.bandwidth_hz *
                                     std::max(0.05, 1.0 + at.At("ratio")))};
}

EntryValues ExternalEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  if (id == Id::kExtraDelay) {
    return {Number("delay_us", 1e6 * rig.period_s * at.At("samples"))};
  }
  if (id == Id::kMisalignment && at.location.gear) return GearEntry(rig, id, at);
  if (id == Id::kMisalignment) {
    return {Number("z_mm", 0), Number("order", at.location.order.value()),
            Number("force_n", at.Amplitude()), PhaseValue(at.Phase())};
  }
  if (id == Id::kCouplingStiffness) {
    return {Number("z_mm", 1e3 * at.location.z_m.value()),
            Number("direct_n_per_m", at.At("direct")), Number("cross_n_per_m", at.At("cross")),
            Number("whirl_n_per_m", at.At("whirl"))};
  }
  if (id == Id::kCrossCoupledStiffness) {
    return {Number("z_mm", 1e3 * at.location.z_m.value()),
            Number("stiffness_n_per_m", at.At("cross"))};
  }
  if (id == Id::kSupportMode) {
    return {Number("mass_kg", 1.0 / std::max(1e-3, at.At("1/mass_kg"))),
            Number("frequency_hz", at.shape.at(0)), Number("damping_ratio", at.shape.at(1))};
  }
  if (id == Id::kTouchdownRub) {
    return {Number("clearance_um", 1e6 * at.shape.at(0)),
            Number("stiffness_n_per_m", std::max(0.0, at.At("stiffness_n_per_m"))),
            Number("damping_n_s_per_m", std::max(0.0, at.At("damping_n_s_per_m"))),
            Number("friction", at.shape.at(1))};
  }
  if (id == Id::kStaticLoad) {
    const std::size_t axis = at.location.axis.value();
    return {Number("z_mm", 1e3 * rig.bearing(axis).actuator_z_m),
            Number(axis % 2 == 0 ? "force_x_n" : "force_y_n", at.At("force_n"))};
  }
  return {};
}

/// Where the entry acts: what the kind of effect refers to, else the whole rig.
effect::EffectConfig PlaceIn(const effect::Row& row, const Location& at, std::size_t axes) {
  effect::EffectConfig entry;
  entry.id = row.id;
  if (row.scope == effect::Scope::kChannels) {
    const std::uint32_t all = (1U << axes) - 1U;
    entry.axes = at.axis ? 1U << *at.axis : all;
  }
  entry.bearing = at.bearing.value_or(0);
  entry.mode = at.mode.value_or(1);
  entry.on_sensor = at.on_sensor;
  entry.gear = at.gear.value_or(0);
  entry.on_driven = at.on_driven;
  return entry;
}

/// In SI, rounded to the digits that a file shows.
std::optional<double> RoundedSi(const EntryValue& value) {
  if (!std::isfinite(value.number)) return std::nullopt;
  const configuration::Unit* unit = FindUnit(value.key);
  return configuration::ToSi(fmt::format("{:.{}g}", value.number, value.digits),
                             unit == nullptr ? configuration::unit::kOne : *unit);
}

/// Every effect has its line: a new one without an entry is refused by the compiler (-Wswitch).
struct NumbersOf {
  const RigView& rig;
  const PlacedEffect& at;

  EntryValues operator()(effect::TimingId id) const {
    switch (id) {
      case effect::TimingId::kExtraDelay:
        return ExternalEntry(rig, effect::IdOf(id), at);
      case effect::TimingId::kDroppedSamples:
      case effect::TimingId::kSampleJitter:
        break;
    }
    return {};
  }

  EntryValues operator()(effect::AmplifierId id) const {
    switch (id) {
      case effect::AmplifierId::kAmplifierBandwidth:
      case effect::AmplifierId::kAmplifierSlew:
        return AmplifierEntry(rig, effect::IdOf(id), at);
      case effect::AmplifierId::kCurrentGain:
      case effect::AmplifierId::kCommandOffset:
        break;
    }
    return CatalogueEntry(effect::At(effect::IdOf(id)), at);
  }

  EntryValues operator()(effect::MagnetId id) const {
    switch (id) {
      case effect::MagnetId::kCoilAsymmetry:
      case effect::MagnetId::kMagneticSaturation:
      case effect::MagnetId::kHysteresis:
      case effect::MagnetId::kEddyCurrent:
      case effect::MagnetId::kAxisRotation:
        return MagnetEntry(rig, effect::IdOf(id), at);
      case effect::MagnetId::kForceConstant:
      case effect::MagnetId::kDisplacementStiffness:
      case effect::MagnetId::kMagneticCoupling:
        break;
    }
    return CatalogueEntry(effect::At(effect::IdOf(id)), at);
  }

  EntryValues operator()(effect::SensorId id) const {
    switch (id) {
      case effect::SensorId::kSensorGain:
      case effect::SensorId::kSensorOffset:
      case effect::SensorId::kSensorNonlinearity:
      case effect::SensorId::kSensorBandwidth:
      case effect::SensorId::kSensorPosition:
      case effect::SensorId::kSensorRunout:
      case effect::SensorId::kMainsPickup:
      case effect::SensorId::kSensorNoise:
        break;
    }
    return SensorEntry(rig, effect::IdOf(id), at);
  }

  EntryValues operator()(effect::RotorId id) const {
    switch (id) {
      case effect::RotorId::kUnbalance:
      case effect::RotorId::kShaftBow:
      case effect::RotorId::kShaftAnisotropy:
      case effect::RotorId::kModalFrequency:
      case effect::RotorId::kModalDamping:
      case effect::RotorId::kGyroscopicInertia:
      case effect::RotorId::kInternalDamping:
      case effect::RotorId::kRotorMass:
      case effect::RotorId::kBreathingCrack:
        break;
    }
    return RotorEntry(rig, effect::IdOf(id), at);
  }

  EntryValues operator()(effect::ExternalId id) const {
    switch (id) {
      case effect::ExternalId::kMisalignment:
      case effect::ExternalId::kCouplingStiffness:
      case effect::ExternalId::kCrossCoupledStiffness:
      case effect::ExternalId::kStaticLoad:
        break;
    }
    return ExternalEntry(rig, effect::IdOf(id), at);
  }

  EntryValues operator()(effect::SupportId id) const {
    switch (id) {
      case effect::SupportId::kSupportMode:
      case effect::SupportId::kTouchdownRub:
        break;
    }
    return ExternalEntry(rig, effect::IdOf(id), at);
  }

  EntryValues operator()(effect::GearId id) const {
    switch (id) {
      case effect::GearId::kMeshStiffness:
      case effect::GearId::kMeshStiffnessVariation:
      case effect::GearId::kBacklash:
      case effect::GearId::kMeshFriction:
      case effect::GearId::kTransmissionError:
      case effect::GearId::kGearRunout:
      case effect::GearId::kToothCrack:
        break;
    }
    return GearEntry(rig, effect::IdOf(id), at);
  }

  // No entries of a rig file.
  EntryValues operator()(effect::CoilId /*id*/) const { return {}; }
  EntryValues operator()(effect::BallId /*id*/) const { return {}; }
};

}  // namespace

EntryValue PhaseValue(double phase_rad) {
  return Number(kPhaseKey, phase_rad * 180.0 / std::numbers::pi);
}

EntryValues ValuesOf(const RigView& rig, const PlacedEffect& at) {
  return std::visit(NumbersOf{rig, at}, effect::Placed(at.effect.value()));
}

std::optional<effect::EffectConfig> MakeEntry(Id id, const Location& at, std::size_t axes_of_rig,
                                              const EntryValues& values) {
  const effect::Row& row = effect::At(id);
  effect::EffectConfig entry = PlaceIn(row, at, axes_of_rig);
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    const effect::Parameter& p = row.parameters[i];
    const std::string key = effect::FileKey(p);
    const auto value = std::find_if(values.begin(), values.end(),
                                    [&key](const EntryValue& v) { return v.key == key; });
    if (value == values.end() && !p.fallback) {
      throw std::logic_error(fmt::format("the entry of {} has no {}", row.name, key));
    }
    const std::optional<double> si = value == values.end() ? p.fallback : RoundedSi(*value);
    if (!si) return std::nullopt;
    entry.values[i] = *si;
  }
  return entry;
}

std::optional<effect::EffectConfig> EntryFor(const RigView& rig, const PlacedEffect& at) {
  const EntryValues values = ValuesOf(rig, at);
  if (values.empty()) return std::nullopt;
  return MakeEntry(at.effect.value(), at.location, rig.axes, values);
}

KeyUnit UnitOfKey(const std::string& key) {
  const configuration::Unit* unit = FindUnit(key);
  if (unit == nullptr) return {};
  return {std::string(unit->symbol),
          static_cast<double>(unit->factor) * std::pow(10.0, unit->decimal_exponent)};
}

}  // namespace levitas::diagnosis
