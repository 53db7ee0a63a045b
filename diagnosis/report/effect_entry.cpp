#include "diagnosis/report/effect_entry.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "configuration/schema/unit.hpp"
#include "diagnosis/report/gear_entry.hpp"
#include "diagnosis/terms/terms.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

EntryValue Number(std::string key, double value, int digits = 6) {
  return {std::move(key), value, {}, digits};
}
EntryValue Words(std::string key, std::string text) {
  return {std::move(key), 0.0, std::move(text)};
}
EntryValue Channel(const std::string& channel) {
  return Words("channels", fmt::format("[{}]", channel));
}
EntryValue AllChannels(const RigView& rig) {
  return Words("channels", fmt::format("[{}]", fmt::join(rig.numbers.channels, ", ")));
}

/// Of an effect whose term is named by the parameters of the catalogue and counts from neutral.
EntryValues CatalogueEntry(const PlacedEffect& g) {
  const effect::Row* row = effect::Find(g.effect);
  if (row == nullptr) return {};
  const auto named = [](std::string_view stem, std::string_view suffix) {
    return suffix.empty() ? std::string(stem) : fmt::format("{}_{}", stem, suffix);
  };
  EntryValues values;
  if (row->scope == effect::Scope::kChannels) values.push_back(Channel(g.place));
  if (row->scope == effect::Scope::kBearing) values.push_back(Words("bearing", g.place));
  for (const effect::Parameter& p : row->parameters) {
    const std::string key = named(p.stem, p.file_suffix);
    const double value = p.neutral + g.At(named(p.stem, p.si_suffix));
    values.push_back(Number(key, value / UnitOfKey(key).si));
  }
  return values;
}

EntryValues MagnetEntry(const RigView& rig, Id id, const PlacedEffect& g) {
  const double bias_a = rig.bias_a(0);
  if (id == Id::kCoilAsymmetry) {
    const double a = std::clamp(0.5 * g.At("ratio"), -0.6, 0.6);
    return {Channel(g.place), Number("ratio", (1.0 + a) / (1.0 - a))};
  }
  if (id == Id::kMagneticSaturation) {
    // Amplitude to knee current: well below the knee the force loss goes as (i/knee)^exponent.
    const double share = std::max(1e-3, g.At("share"));
    const double exponent = std::strtod(g.After("exponent ").c_str(), nullptr);
    return {AllChannels(rig),
            Number("knee_a", g.Number() * bias_a * std::pow(share, -1.0 / exponent)),
            Number("exponent", exponent)};
  }
  if (id == Id::kHysteresis) {
    return {AllChannels(rig),
            Number("width_a", g.Number() * bias_a * std::max(0.0, g.At("share")))};
  }
  if (id == Id::kEddyCurrent) {
    const bool current_alone = g.theta.count(kRootTauOfCurrent) > 0;
    const double root = std::max(0.0, g.At(current_alone ? kRootTauOfCurrent : kRootTau));
    EntryValues values{Channel(g.place), Number("tau_us", 1e6 * root * root)};
    if (current_alone) values.push_back(Number("displacement_share", 0.0));
    return values;
  }
  if (id == Id::kAxisRotation) {
    return {Words("bearing", g.After(" ")), Words("of", g.place.substr(0, g.place.find(' '))),
            Number("angle_deg", g.At("angle_rad") * 180.0 / std::numbers::pi)};
  }
  return CatalogueEntry(g);
}

EntryValues SensorEntry(const RigView& rig, Id id, const PlacedEffect& g) {
  if (id == Id::kSensorOffset) {
    return {Channel(g.place), Number("offset_um", 1e6 * g.At("offset_m"))};
  }
  if (id == Id::kSensorNonlinearity) {
    return {Channel(g.place), Number("a2_1_per_m", g.At("a2")), Number("a3_1_per_m2", g.At("a3"))};
  }
  if (id == Id::kSensorPosition) {
    return {Words("bearing", g.place), Number("shift_mm", 1e3 * g.At("shift_m"))};
  }
  if (id == Id::kSensorRunout) {
    const auto& channels = rig.numbers.channels;
    const auto at = std::find(channels.begin(), channels.end(), g.After(", ")) - channels.begin();
    const bool y_probe = at % 2 == 1;
    const double phase = -g.Phase() + (y_probe ? g.Number() * 0.5 * std::numbers::pi : 0.0);
    return {Channel(g.After(", ")), Number("order", g.Number()),
            Number("amplitude_um", 1e6 * g.Amplitude()),
            PhaseValue(std::remainder(phase, 2.0 * std::numbers::pi))};
  }
  if (id == Id::kMainsPickup) {
    return {Channel(g.After(", ")), Number("frequency_hz", g.Number()),
            Number("amplitude_um", 1e6 * g.Amplitude()), PhaseValue(0.0)};
  }
  for (std::size_t a = 0; a < rig.axes; ++a) {
    if (id == Id::kSensorBandwidth && g.place == rig.numbers.channels[a]) {
      return {Channel(g.place),
              Number("bandwidth_hz",
                     rig.bearing(a).sensor.bandwidth_hz / std::max(0.05, 1.0 + g.At("lag_ratio")))};
    }
  }
  return {Channel(g.place), Number("ratio", 1.0 + g.At("ratio"))};
}

EntryValues RotorEntry(const RigView& rig, Id id, const PlacedEffect& g) {
  const auto mode = static_cast<std::size_t>(g.Number());
  if (id == Id::kUnbalance) {
    return {Number("z_mm", g.Number()), Number("moment_g_mm", 1e6 * g.Amplitude()),
            PhaseValue(g.Phase())};
  }
  if (id == Id::kShaftBow) {
    return {Number("mode", static_cast<double>(mode)), Number("amplitude_um", 1e6 * g.Amplitude()),
            PhaseValue(g.Phase())};
  }
  if (id == Id::kShaftAnisotropy) {
    return {Number("ratio", g.Amplitude()), PhaseValue(0.5 * g.Phase())};
  }
  if (id == Id::kModalFrequency) {
    return {Number("mode", static_cast<double>(mode)),
            Number("frequency_hz",
                   rig.omega_rad_per_s[mode + 1] / (2.0 * std::numbers::pi) * (1.0 + g.At("ratio")),
                   8)};
  }
  if (id == Id::kModalDamping) {
    return {Number("mode", static_cast<double>(mode)),
            Number("damping_ratio",
                   std::max(0.0, rig.damping_ratio[mode + 1] * (1.0 + g.At("ratio"))))};
  }
  if (id == Id::kBreathingCrack) {
    const double direction_deg = std::strtod(g.After("direction ").c_str(), nullptr);
    return {Number("z_mm", g.Number()),
            Number("depth", CrackDepth(rig, 1e-3 * g.Number(), g.At("softening"))),
            PhaseValue(
                std::remainder(direction_deg * std::numbers::pi / 180.0, 2.0 * std::numbers::pi))};
  }
  if (id == Id::kInternalDamping) {
    return {Number("z_mm", g.Number()), Number("damping_n_s_per_m", g.At("damping"))};
  }
  return {Number("ratio", 1.0 + g.At("ratio"))};
}

EntryValues AmplifierEntry(const RigView& rig, Id id, const PlacedEffect& g) {
  if (id == Id::kAmplifierSlew) {
    return {AllChannels(rig), Number("slew_a_per_s", g.Number())};
  }
  for (std::size_t a = 0; id == Id::kAmplifierBandwidth && a < rig.axes; ++a) {
    if (g.place != rig.numbers.channels[a]) continue;
    return {Channel(g.place), Number("bandwidth_hz", rig.bearing(a).amplifier.bandwidth_hz *
                                                         std::max(0.05, 1.0 + g.At("ratio")))};
  }
  return CatalogueEntry(g);
}

EntryValues ExternalEntry(const RigView& rig, Id id, const PlacedEffect& g) {
  if (id == Id::kExtraDelay) {
    return {Number("delay_us", 1e6 * rig.period_s * std::max(0.0, g.At("samples")))};
  }
  if (id == Id::kMisalignment) {
    return {Number("z_mm", 0), Number("order", g.Number()), Number("force_n", g.Amplitude()),
            PhaseValue(g.Phase())};
  }
  if (id == Id::kCouplingStiffness) {
    return {Number("z_mm", g.Number()), Number("direct_n_per_m", g.At("direct")),
            Number("cross_n_per_m", g.At("cross"))};
  }
  if (id == Id::kCrossCoupledStiffness) {
    return {Number("z_mm", g.Number()), Number("stiffness_n_per_m", g.At("cross"))};
  }
  if (id == Id::kSupportMode) {
    return {Words("bearing", g.place.substr(0, g.place.find(','))),
            Number("mass_kg", 1.0 / std::max(1e-3, g.At("1/mass_kg"))),
            Number("frequency_hz", std::strtod(g.After(", ").c_str(), nullptr)),
            Number("damping_ratio", std::strtod(g.After("damping ").c_str(), nullptr))};
  }
  if (id == Id::kTouchdownRub) {
    return {Words("bearing", g.place.substr(0, g.place.find(','))),
            Number("clearance_um", std::strtod(g.After("clearance ").c_str(), nullptr)),
            Number("stiffness_n_per_m", std::max(0.0, g.At("stiffness_n_per_m"))),
            Number("damping_n_s_per_m", std::max(0.0, g.At("damping_n_s_per_m"))),
            Number("friction", std::strtod(g.After("friction ").c_str(), nullptr))};
  }
  if (id == Id::kStaticLoad) {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      if (rig.numbers.channels[a] != g.place) continue;
      return {Number("z_mm", 1e3 * rig.bearing(a).actuator_z_m),
              Number(fmt::format("force_{}_n", a % 2 == 0 ? "x" : "y"), g.At("force_n"))};
    }
  }
  return {};
}

/// Every effect has its line: a new one without an entry is refused by the compiler (-Wswitch).
EntryValues EntryOf(const RigView& rig, Id id, const PlacedEffect& at) {
  switch (id) {
    case Id::kDisplacementStiffness:
    case Id::kCurrentGain:
    case Id::kForceConstant:
    case Id::kCommandOffset:
    case Id::kMagneticCoupling:
      return CatalogueEntry(at);
    case Id::kAmplifierBandwidth:
    case Id::kAmplifierSlew:
      return AmplifierEntry(rig, id, at);
    case Id::kCoilAsymmetry:
    case Id::kMagneticSaturation:
    case Id::kHysteresis:
    case Id::kEddyCurrent:
    case Id::kAxisRotation:
      return MagnetEntry(rig, id, at);
    case Id::kSensorGain:
    case Id::kSensorOffset:
    case Id::kSensorNonlinearity:
    case Id::kSensorBandwidth:
    case Id::kSensorPosition:
    case Id::kSensorRunout:
    case Id::kMainsPickup:
    case Id::kSensorNoise:
      return SensorEntry(rig, id, at);
    case Id::kUnbalance:
    case Id::kShaftBow:
    case Id::kShaftAnisotropy:
    case Id::kModalFrequency:
    case Id::kModalDamping:
    case Id::kGyroscopicInertia:
    case Id::kInternalDamping:
    case Id::kRotorMass:
    case Id::kBreathingCrack:
      return RotorEntry(rig, id, at);
    case Id::kExtraDelay:
    case Id::kMisalignment:
    case Id::kCouplingStiffness:
    case Id::kCrossCoupledStiffness:
    case Id::kStaticLoad:
    case Id::kSupportMode:
    case Id::kTouchdownRub:
      return ExternalEntry(rig, id, at);
    case Id::kMeshStiffness:
    case Id::kMeshStiffnessVariation:
    case Id::kBacklash:
    case Id::kMeshFriction:
    case Id::kTransmissionError:
    case Id::kGearRunout:
    case Id::kToothCrack:
      return GearEntry(rig, id, at.place, at.theta);
    case Id::kDroppedSamples:
    case Id::kSampleJitter:
      return {};
  }
  return {};
}

}  // namespace

EntryValue PhaseValue(double phase_rad) {
  return Number(kPhaseKey, phase_rad * 180.0 / std::numbers::pi);
}

EntryValues ValuesOf(const RigView& rig, const PlacedEffect& at) {
  const effect::Row* row = effect::Find(at.effect);
  if (row == nullptr) throw std::logic_error(at.effect + " is not in the catalogue of effects");
  return EntryOf(rig, row->id, at);
}

std::string EntryText(const std::string& effect, const EntryValues& values) {
  if (values.empty()) return {};
  std::string text = fmt::format("{{id: {}", effect);
  for (const EntryValue& value : values) {
    text += fmt::format(", {}: ", value.key);
    text += value.is_number() ? fmt::format("{:.{}g}", value.number, value.digits) : value.text;
  }
  text += "}";
  return text;
}

KeyUnit UnitOfKey(const std::string& key) {
  const config::Unit* longest = nullptr;
  for (const config::Unit& unit : config::AllUnits()) {
    const std::string ending = fmt::format("_{}", unit.suffix);
    if (unit.suffix.empty() || !key.ends_with(ending)) continue;
    if (longest == nullptr || unit.suffix.size() > longest->suffix.size()) longest = &unit;
  }
  if (longest == nullptr) return {};
  return {std::string(longest->symbol),
          static_cast<double>(longest->factor) * std::pow(10.0, longest->decimal_exponent)};
}

}  // namespace levitas::diagnosis
