#include "diagnosis/extended_rig.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "common/problem.hpp"
#include "diagnosis/gear_entry.hpp"
#include "diagnosis/terms/terms.hpp"
#include "diagnosis/words.hpp"

namespace levitas::diagnosis {
namespace {

/// The terms of one cause at one place, by parameter.
struct Group {
  std::string effect, place;
  std::map<std::string, double> theta;

  [[nodiscard]] double At(const std::string& parameter) const {
    const auto found = theta.find(parameter);
    return found == theta.end() ? 0.0 : found->second;
  }
  [[nodiscard]] double Amplitude() const { return std::hypot(At("cosine"), At("sine")); }
  [[nodiscard]] double Phase() const { return std::atan2(At("sine"), At("cosine")); }
  /// The first number in the place: "mode 2", "order -3", "z 299.2 mm", "90 Hz".
  [[nodiscard]] double Number() const {
    const auto at = place.find_first_of("-0123456789");
    return at == std::string::npos ? 0.0 : std::strtod(place.c_str() + at, nullptr);
  }
  [[nodiscard]] std::string After(const std::string& comma) const {
    const auto at = place.find(comma);
    return at == std::string::npos ? place : place.substr(at + comma.size());
  }
};

std::vector<Group> GroupsOf(const SessionAnswer& answer) {
  std::vector<Group> groups;
  for (const Hypothesis& cause : answer.answer.causes) {
    for (const std::size_t t : cause.terms) {
      const Term& term = answer.terms[t];
      const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
        return g.effect == term.effect && g.place == term.place;
      });
      Group& group =
          same != groups.end() ? *same : groups.emplace_back(Group{term.effect, term.place, {}});
      group.theta.try_emplace(term.parameter, answer.answer.theta_extended[t]);
    }
  }
  return groups;
}

std::string MagnetEntry(const RigView& rig, const Group& g) {
  const double bias_a = rig.bias_a(0);
  if (g.effect == "coil_asymmetry") {
    const double a = std::clamp(0.5 * g.At("ratio"), -0.6, 0.6);
    return fmt::format("channels: [{}], ratio: {:.6g}", g.place, (1.0 + a) / (1.0 - a));
  }
  if (g.effect == "magnetic_saturation") {
    // The family's amplitude as a knee: far below it the loss goes with the power of the exponent.
    const double share = std::max(1e-3, g.At("share"));
    const double exponent = std::strtod(g.After("exponent ").c_str(), nullptr);
    return fmt::format("channels: [{}], knee_a: {:.6g}, exponent: {:.6g}",
                       fmt::join(rig.numbers.channels, ", "),
                       g.Number() * bias_a * std::pow(share, -1.0 / exponent), exponent);
  }
  if (g.effect == "hysteresis") {
    return fmt::format("channels: [{}], width_a: {:.6g}", fmt::join(rig.numbers.channels, ", "),
                       g.Number() * bias_a * std::max(0.0, g.At("share")));
  }
  if (g.effect == "eddy_current") {
    const double root = std::max(0.0, g.At("sqrt(tau_s)"));
    return fmt::format("channels: [{}], tau_us: {:.6g}", g.place, 1e6 * root * root);
  }
  if (g.effect == "axis_rotation") {
    return fmt::format("bearing: {}, of: {}, angle_deg: {:.6g}", g.After(" "),
                       g.place.substr(0, g.place.find(' ')),
                       g.At("angle_rad") * 180.0 / std::numbers::pi);
  }
  return fmt::format("channels: [{}], ratio: {:.6g}", g.place, 1.0 + g.At("ratio"));
}

std::string SensorEntry(const RigView& rig, const Group& g) {
  if (g.effect == "sensor_offset") {
    return fmt::format("channels: [{}], offset_um: {:.6g}", g.place, 1e6 * g.At("offset_m"));
  }
  if (g.effect == "sensor_nonlinearity") {
    return fmt::format("channels: [{}], a2_1_per_m: {:.6g}, a3_1_per_m2: {:.6g}", g.place,
                       g.At("a2"), g.At("a3"));
  }
  if (g.effect == "sensor_position") {
    return fmt::format("bearing: {}, shift_mm: {:.6g}", g.place, 1e3 * g.At("shift_m"));
  }
  if (g.effect == "sensor_runout") {
    const auto& channels = rig.numbers.channels;
    const auto at = std::find(channels.begin(), channels.end(), g.After(", ")) - channels.begin();
    const bool y_probe = at % 2 == 1;
    const double phase = -g.Phase() + (y_probe ? g.Number() * 0.5 * std::numbers::pi : 0.0);
    return fmt::format("channels: [{}], order: {:.0f}, amplitude_um: {:.6g}, phase_rad: {:.6g}",
                       g.After(", "), g.Number(), 1e6 * g.Amplitude(),
                       std::remainder(phase, 2.0 * std::numbers::pi));
  }
  if (g.effect == "mains_pickup") {
    return fmt::format("channels: [{}], frequency_hz: {:.6g}, amplitude_um: {:.6g}, phase_rad: 0",
                       g.After(", "), g.Number(), 1e6 * g.Amplitude());
  }
  for (std::size_t a = 0; a < rig.axes; ++a) {
    if (g.effect == "sensor_bandwidth" && g.place == rig.numbers.channels[a]) {
      return fmt::format(
          "channels: [{}], bandwidth_hz: {:.6g}", g.place,
          rig.bearing(a).sensor.bandwidth_hz / std::max(0.05, 1.0 + g.At("lag_ratio")));
    }
    if (g.effect == "amplifier_bandwidth" && g.place == rig.numbers.channels[a]) {
      return fmt::format(
          "channels: [{}], bandwidth_hz: {:.6g}", g.place,
          rig.bearing(a).amplifier.bandwidth_hz * std::max(0.05, 1.0 + g.At("ratio")));
    }
  }
  return fmt::format("channels: [{}], ratio: {:.6g}", g.place, 1.0 + g.At("ratio"));
}

std::string RotorEntry(const RigView& rig, const Group& g) {
  const auto mode = static_cast<std::size_t>(g.Number());
  if (g.effect == "unbalance") {
    return fmt::format("z_mm: {:.6g}, moment_g_mm: {:.6g}, phase_rad: {:.6g}", g.Number(),
                       1e6 * g.Amplitude(), g.Phase());
  }
  if (g.effect == "shaft_bow") {
    return fmt::format("mode: {}, amplitude_um: {:.6g}, phase_rad: {:.6g}", mode,
                       1e6 * g.Amplitude(), g.Phase());
  }
  if (g.effect == "shaft_anisotropy") {
    return fmt::format("ratio: {:.6g}, phase_rad: {:.6g}", g.Amplitude(), 0.5 * g.Phase());
  }
  if (g.effect == "modal_frequency") {
    return fmt::format(
        "mode: {}, frequency_hz: {:.8g}", mode,
        rig.omega_rad_per_s[mode + 1] / (2.0 * std::numbers::pi) * (1.0 + g.At("ratio")));
  }
  if (g.effect == "modal_damping") {
    return fmt::format("mode: {}, damping_ratio: {:.6g}", mode,
                       std::max(0.0, rig.damping_ratio[mode + 1] * (1.0 + g.At("ratio"))));
  }
  if (g.effect == "breathing_crack") {
    const double direction_deg = std::strtod(g.After("direction ").c_str(), nullptr);
    return fmt::format(
        "z_mm: {:.6g}, depth: {:.6g}, phase_rad: {:.6g}", g.Number(),
        CrackDepth(rig, 1e-3 * g.Number(), g.At("softening")),
        std::remainder(direction_deg * std::numbers::pi / 180.0, 2.0 * std::numbers::pi));
  }
  if (g.effect == "internal_damping") {
    return fmt::format("z_mm: {:.6g}, damping_n_s_per_m: {:.6g}", g.Number(), g.At("damping"));
  }
  return fmt::format("ratio: {:.6g}", 1.0 + g.At("ratio"));
}

std::string ExternalEntry(const RigView& rig, const Group& g) {
  if (g.effect == "extra_delay") {
    return fmt::format("delay_us: {:.6g}", 1e6 * rig.period_s * std::max(0.0, g.At("samples")));
  }
  if (g.effect == "amplifier_slew") {
    return fmt::format("channels: [{}], slew_a_per_s: {:.6g}",
                       fmt::join(rig.numbers.channels, ", "), g.Number());
  }
  if (g.effect == "misalignment") {
    return fmt::format("z_mm: 0, order: {:.0f}, force_n: {:.6g}, phase_rad: {:.6g}", g.Number(),
                       g.Amplitude(), g.Phase());
  }
  if (g.effect == "coupling_stiffness") {
    return fmt::format("z_mm: {:.6g}, direct_n_per_m: {:.6g}, cross_n_per_m: {:.6g}", g.Number(),
                       g.At("direct"), g.At("cross"));
  }
  if (g.effect == "cross_coupled_stiffness") {
    return fmt::format("z_mm: {:.6g}, stiffness_n_per_m: {:.6g}", g.Number(), g.At("cross"));
  }
  if (g.effect == "support_mode") {
    return fmt::format("bearing: {}, mass_kg: {:.6g}, frequency_hz: {:.6g}, damping_ratio: {:.6g}",
                       g.place.substr(0, g.place.find(',')),
                       1.0 / std::max(1e-3, g.At("1/mass_kg")),
                       std::strtod(g.After(", ").c_str(), nullptr),
                       std::strtod(g.After("damping ").c_str(), nullptr));
  }
  if (g.effect == "touchdown_rub") {
    return fmt::format(
        "bearing: {}, clearance_um: {:.6g}, stiffness_n_per_m: {:.6g}, damping_n_s_per_m: {:.6g}, "
        "friction: {:.6g}",
        g.place.substr(0, g.place.find(',')), std::strtod(g.After("clearance ").c_str(), nullptr),
        std::max(0.0, g.At("stiffness_n_per_m")), std::max(0.0, g.At("damping_n_s_per_m")),
        std::strtod(g.After("friction ").c_str(), nullptr));
  }
  if (g.effect == "static_load") {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      if (rig.numbers.channels[a] != g.place) continue;
      return fmt::format("z_mm: {:.6g}, force_{}_n: {:.6g}", 1e3 * rig.bearing(a).actuator_z_m,
                         a % 2 == 0 ? "x" : "y", g.At("force_n"));
    }
  }
  return {};
}

std::string Entry(const RigView& rig, const Group& g) {
  const std::string place = PlaceOfEffect(g.effect);
  std::string values;
  if (place == "gear") values = GearEntry(rig, g.effect, g.place, g.theta);
  if (place == "magnet") values = MagnetEntry(rig, g);
  if (place == "sensor" || place == "amplifier") values = SensorEntry(rig, g);
  if (place == "rotor") values = RotorEntry(rig, g);
  if (g.effect == "amplifier_slew" || place == "external" || place == "support" ||
      place == "timing") {
    values = ExternalEntry(rig, g);
  }
  return values.empty() ? values : fmt::format("{{id: {}, {}}}", g.effect, values);
}

/// The entry as the strict reader takes it on this rig; empty when it refuses.
std::vector<effect::EffectConfig> Read(config::RigFile rig, const std::string& entry) {
  const std::string none = "effects: []\n";
  rig.plant.effects.clear();
  std::string text = config::WriteRig(rig);
  const auto at = text.rfind(none);
  if (at == std::string::npos) return {};
  text.replace(at, none.size(), "effects:\n  - " + entry + "\n");
  try {
    return config::ParseRig(text, "extended_rig.yaml").plant.effects;
  } catch (const BadInput&) {
    return {};
  }
}

}  // namespace

std::vector<std::string> EffectEntries(const SessionAnswer& answer) {
  std::vector<std::string> entries;
  for (const Group& group : GroupsOf(answer)) {
    const std::string entry = Entry(*answer.view, group);
    if (!entry.empty()) entries.push_back(entry);
  }
  return entries;
}

std::string ExtendedRig(const SessionAnswer& answer, const config::RigFile& rig) {
  config::RigFile extended = rig;
  std::string comments;
  std::string missing;
  for (const std::string& entry : EffectEntries(answer)) {
    const auto effects = Read(rig, entry);
    extended.plant.effects.insert(extended.plant.effects.end(), effects.begin(), effects.end());
    if (effects.empty()) missing += "#  - " + entry + "\n";
  }
  for (const NamedParameter& p : Parameters(answer)) {
    comments += fmt::format("# {} {} = {:.5g} {} ({:.5g} to {:.5g})\n", p.effect, p.name, p.value,
                            p.unit, p.low, p.high);
  }
  if (!missing.empty()) missing.insert(0, "# not known to this build's reader:\n");
  return comments + missing + config::WriteRig(extended);
}

}  // namespace levitas::diagnosis
