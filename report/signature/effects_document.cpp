// docs/effects.md from the catalogue.
#include <fmt/format.h>

#include <cmath>

#include "configuration/rig_file.hpp"
#include "configuration/schema/unit.hpp"
#include "plant_sim/plant/applied_effects/clear_entry.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

constexpr std::string_view kIntroduction =
    R"(# Effects: what a rig does beyond its nominal model

Generated from the catalogue in `plant_sim/effect/` (`amb effects --document docs/effects.md --pictures docs/pictures/effects`); do not edit.
A test compares.

Every effect but those of a [coil on a voltage or a ball](#of-coils-on-a-voltage-and-of-a-ball) is an entry of the list `effects` of a rig
file ([configuration.md](configuration.md)); several may act at once, and those of channels on any axis:

```yaml
effects:
  - {id: eddy_current, channels: [de_x, de_y], tau_us: 50}
  - {id: breathing_crack, z_mm: 250, depth: 0.3, at_s: 10}       # sudden, after 10 s
  - {id: sensor_gain, channels: [nde_x], ratio: 1.1, ramp_s: 60}  # a drift over a minute
```

`strength` scales an entry from 0, where the plant is the nominal one bit for bit, to 1. Between them a value runs linearly from
its neutral value, or inversely where neutral is infinite, or geometrically from the rig's own (bandwidths, frequencies); phases,
orders and exponents stay. The program reaches every number by name, `effects[0].tau_s`, and can change a strength while it runs.
The tables name the keys of a rig file, each with its unit; another unit of the same kind may take its place (`amplitude_m: 1.5e-6` for
`amplitude_um: 1.5`). Below each table stands an entry of clear size, for the list `effects` of `flexible_rotor`, or of `geared_rotor_4dof`.

Symbols: *ic* control current, *i0* bias, *x* displacement at the actuator, *r* = x + jy, *q* modal coordinate, *w* its
frequency, *phi* its shape, *W* speed and *angle* of the rotor, *s* Laplace variable. "Clear" is a size that shows on a
laboratory rig; "x own" means times what the rig has. Pictures: rig `flexible_rotor`, clear size, which the title says; the broad pale line is the nominal rig;
responses are those of the free rotor in its magnets without a controller; "what the effect adds" is the spectrum of the difference
of two runs with the same noise; effects of teeth are drawn on `geared_rotor_4dof`.

Not covered by the linear model that `amb poles` and `amb margins` use: hysteresis, slew, rub, anisotropy, crack, and everything
that is a signal. On rigs with geared shafts the effects of rotor and surroundings, which refer to one rotor, are refused, but for
`misalignment`, which there names the wheel on whose shaft the coupling sits; those of gears need such a rig:

```yaml
effects:
  - {id: tooth_crack, gear: mesh, wheel: driven, tooth: 7, depth: 0.5}
  - {id: misalignment, gear: mesh, wheel: driving, order: 2, rotation_error_deg: 0.039}  # a universal joint at 3 degrees
```

The lag of `eddy_current` is a sum of first-order lags: 1/(1 + sqrt p) = (1/pi) integral over x > 0 of sqrt(x)/((1 + x)(x + p)) dx,
by the trapezoid rule in ln x with ten points from 1e-4 to 1e2. It follows the half-order law within 0.6 % up to 2 pi f tau = 10.

)";

constexpr std::string_view kOfCoilsAndBall =
    R"(# Of coils on a voltage and of a ball

What `amb diagnose` can find beside the effects above on a ball between two magnets with coils on a voltage
([diagnosis_method.md](diagnosis_method.md#two-magnet-levitator)). None of these is an entry of the list `effects`, and no bench hides
one in a rotor; a simulated rig has them by the keys of its coil that are named, or not at all. The tables name the numbers of a diagnosis.

)";

std::string Number(double value, const configuration::Unit& unit) {
  if (std::isnan(value)) return "own";
  if (std::isinf(value)) return "infinite";
  return fmt::format("{:.4g}", std::stod(configuration::FromSi(value, unit)));
}

std::string Parameters(const effect::Row& row) {
  std::string text = "| key | allowed | neutral | clear | meaning |\n|---|---|---|---|---|\n";
  for (const effect::Parameter& p : row.parameters) {
    const configuration::Unit& unit = FileUnit(p);
    const bool of_own = std::isnan(p.neutral);  // then a factor on what the rig has
    text += fmt::format("| `{}` | {} to {} | {} | {} | {} |\n", effect::FileKey(p),
                        Number(p.low, unit), Number(p.high, unit), Number(p.neutral, unit),
                        of_own ? fmt::format("{:.4g} x own", p.clear) : Number(p.clear, unit),
                        p.meaning);
  }
  return text;
}

/// Where an entry acts, as a rig file says it: the first place of its kind.
std::string Place(const effect::Row& row, const configuration::RigFile& rig) {
  switch (row.scope) {
    case effect::Scope::kChannels:
      return fmt::format(", channels: [{}]", rig.numbers.channels.front());
    case effect::Scope::kBearing:
      return fmt::format(", bearing: {}{}", rig.numbers.bearings.front(),
                         row.id == effect::Id::kAxisRotation ? ", of: sensor" : "");
    case effect::Scope::kMode:
      return ", mode: 1";
    case effect::Scope::kGear: {
      const bool of_a_wheel =
          row.id == effect::Id::kGearRunout || row.id == effect::Id::kToothCrack;
      return fmt::format(", gear: {}{}", rig.plant.gears.front().name,
                         of_a_wheel ? ", wheel: driven" : "");
    }
    case effect::Scope::kRig:
      break;
  }
  return "";
}

std::string Entry(const effect::Row& row, const configuration::RigFile& rig) {
  const effect::EffectConfig clear = plant::ClearOn(plant::Reduce(rig.plant), row.id);
  std::string text = fmt::format("- {{id: {}{}", row.name, Place(row, rig));
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    const effect::Parameter& p = row.parameters[i];
    text += fmt::format(", {}: {}", effect::FileKey(p), Number(clear.values[i], FileUnit(p)));
  }
  return text + "}";
}

std::string_view Where(effect::Scope scope) {
  switch (scope) {
    case effect::Scope::kChannels:
      return "per channel";
    case effect::Scope::kBearing:
      return "per bearing";
    case effect::Scope::kMode:
      return "per flexible mode";
    case effect::Scope::kGear:
      return "per gear pair";
    case effect::Scope::kRig:
      break;
  }
  return "whole rig";
}

std::string Said(const effect::Row& row) {
  return fmt::format("## `{}`\n\n{}, {}: {}.\n\n    {}\n\nSignature: {}.\n\n{}", row.name,
                     effect::Name(row.place), Where(row.scope), row.meaning, row.equation,
                     row.signature, Parameters(row));
}

}  // namespace

std::string EffectsDocument() {
  const configuration::RigFile plain =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const configuration::RigFile geared =
      configuration::LoadRig(configuration::FindConfig("geared_rotor_4dof", "rigs"));
  std::string text(kIntroduction);
  for (const effect::Row& row : effect::EntryRows()) {
    const auto& rig = row.place == effect::Place::kGear ? geared : plain;
    text += fmt::format("{}\n    {}\n\nSource: {}.\n\n![{}](pictures/effects/{}.svg)\n\n",
                        Said(row), Entry(row, rig), row.source, row.name, row.name);
  }
  text += kOfCoilsAndBall;
  for (const effect::Row& row : effect::Catalogue()) {
    if (effect::IsEntry(row)) continue;
    text += fmt::format("{}\nIn a rig file: {}.\n\nSource: {}.\n\n", Said(row),
                        effect::InPlaceOfAnEntry(row), row.source);
  }
  text.pop_back();
  return text;
}

}  // namespace levitas::signature
