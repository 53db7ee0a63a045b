// docs/configuration.md: what holds for every file, then the tables.
#include <fmt/format.h>

#include <map>

#include "configuration/schema/schema.hpp"
#include "configuration/text/documenter.hpp"

namespace levitas::configuration {
namespace {

constexpr std::string_view kIntroduction = R"(# Configuration files

Generated from the tables in `configuration/schema/` (`ninja generate_docs`); do not edit. A test compares.

Three kinds of file, all YAML: a **rig** says what stands on the bench, a **controller** how it is
held and protected, a **scenario** what the operator does. A file is named by its path, or, if it is
shipped, by its name alone (`--rig ufu_rig`). Shipped files are looked for in `$LEVITAS_CONFIG` when
that is set, else in `config/` of the checkout or `share/levitas` of the installation.

## Rules of all files

- The first key is `kind: rig`, `kind: controller` or `kind: scenario`.
- A key carries the unit of its number: `gap_mm: 0.381`. Any other unit of the same dimension may be
  used by changing the key: `gap_um: 381`, `gap_m: 381e-6`. The units are listed at the end.
- Numbers are decimal, with a point, without quotes and without a unit behind them. A zero in front
  (`0144`) is refused: YAML 1.1 reads an octal number there, YAML 1.2 a decimal one.
- A file has at most 4 MB.
- Nothing is clamped or guessed. A key that is unknown, missing, given twice, out of range, not
  finite or of the wrong type is refused, and all problems of a file are listed at once:
  `file:line:column: key: found 7 mm, allowed 0.02 to 10 mm`.
- A session holds the complete files, every default written out; what is written reads back to the
  same bits.
- Anchors, aliases, tags and a second document are refused: they hide where a number comes from.
- "required" means that there is no default. A group may be left out when all its keys have one.

)";

std::string UnitTable() {
  std::map<std::string_view, std::string> families;
  for (const Unit& unit : AllUnits()) {
    if (unit.dimension.empty()) continue;
    std::string& family = families[unit.dimension];
    family += fmt::format("{}`_{}` ({})", family.empty() ? "" : ", ", unit.suffix, unit.symbol);
  }
  std::string text = "## Units\n\n| dimension | ends of keys |\n|---|---|\n";
  for (const auto& [dimension, units] : families) {
    text += fmt::format("| {} | {} |\n", dimension, units);
  }
  return text;
}

constexpr std::string_view kRigExample =
    R"(What differs from a shipped rig is often a few keys. A magnet, given by its coil and in other units
than the documented ones, and a probe that reads the other way round:

```yaml
    magnet:
      gap_um: 381
      turns: 138
      pole_area_mm2: 470.3
      half_pole_angle_deg: 22.5
    sensor:
      bandwidth_khz: 5
      noise_rms_um: 1
      range_um: 400
      polarity_y: -1
```

)";

constexpr std::string_view kScenarioExample =
    R"(A step that excites two axes for 10 s, uncorrelated, for an identification:

```yaml
  - do: nothing
    hold_s: 10
    excitation:
      - {channel: de_x, amplitude_a: 0.05, order: 15, divisor: 5, start: 0}
      - {channel: de_y, amplitude_a: 0.05, order: 15, divisor: 5, start: 0.25}
```

)";

/// Stands for any rig: the names in the tables of controller and scenario are the rig's.
RigNumbers AnyRig() {
  RigNumbers rig;
  rig.bearings = {"<bearing>"};
  rig.channels = {"<bearing>_x", "<bearing>_y"};
  return rig;
}

}  // namespace

std::string ConfigurationDocument() {
  std::string text(kIntroduction);
  {
    Documenter documenter;
    RigFile rig;
    Describe(documenter, rig);
    text +=
        "## Rig\n\nz runs along the shaft from the drive end; x and y are the control axes of "
        "each bearing; rotation\nis positive from x to y.\n\n" +
        documenter.Markdown();
    text += kRigExample;
  }
  {
    Documenter documenter;
    ControllerFile controller;
    Describe(documenter, controller, AnyRig());
    text +=
        "## Controller\n\nThe law of each axis is ic = -C(s) y with C(s) = [Kp + Ki/s + Kd s/(1 "
        "+ s/wd)] · lead-lags · notches,\ndiscretised by Tustin at the rig's sampling period. "
        "The keys under `laws` are names of the rig's\nbearings and axes.\n\n" +
        documenter.Markdown();
  }
  {
    Documenter documenter;
    scenario::ScenarioConfig scenario;
    Describe(documenter, scenario, AnyRig());
    text +=
        "## Scenario\n\nEach step gives its command, waits until what it names is reached, then "
        "holds. A refused command,\na wait beyond its time-out or a trip ends the scenario as "
        "failed.\n\n" +
        documenter.Markdown();
    text += kScenarioExample;
  }
  return text + UnitTable();
}

}  // namespace levitas::configuration
