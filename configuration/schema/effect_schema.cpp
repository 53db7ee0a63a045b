// Table of the effects of a rig file: the catalogue of plant_sim/effect as keys.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/problem.hpp"
#include "configuration/schema/schema.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/check_config.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;
using effect::EffectConfig;
using effect::Scope;

constexpr std::size_t kMostEffects = 100;
constexpr std::array<std::string_view, 2> kSides{"magnet", "sensor"};
constexpr std::array<std::string_view, 2> kWheels{"driving", "driven"};

const Unit& UnitWith(std::string_view suffix) {
  const auto units = AllUnits();
  const auto found =
      std::ranges::find_if(units, [&](const Unit& unit) { return unit.suffix == suffix; });
  if (found == units.end()) throw std::logic_error("catalogue: no unit " + std::string(suffix));
  return *found;
}

/// A bound of the catalogue, which is SI, in the unit of the file.
double InUnit(double si, const Unit& unit) { return std::stod(FromSi(si, unit)); }

void DescribeParameter(Visitor& v, const effect::Parameter& p, double& value) {
  const Unit& unit = UnitWith(p.file_suffix);
  if (p.whole) {
    std::optional<std::int64_t> fallback;
    if (p.fallback) fallback = std::llround(*p.fallback);
    std::int64_t whole = std::isfinite(value) ? std::llround(value) : 0;
    v.Integer({p.stem, std::llround(p.low), std::llround(p.high), fallback, p.meaning}, whole);
    value = static_cast<double>(whole);
    return;
  }
  std::optional<double> fallback;
  if (p.fallback) fallback = InUnit(*p.fallback, unit);
  v.Number({p.stem, unit, InUnit(p.low, unit), InUnit(p.high, unit), fallback, p.meaning}, value);
}

void DescribeBearing(Visitor& v, const RigFile& rig, EffectConfig& entry) {
  std::vector<std::string_view> names(rig.numbers.bearings.begin(), rig.numbers.bearings.end());
  for (std::string_view& name : names) {
    if (name.empty()) name = "<bearing>";
  }
  v.Choice({"bearing", names, kRequired, "where it acts"}, entry.bearing);
}

void DescribeChannels(Visitor& v, const RigFile& rig, EffectConfig& entry) {
  std::vector<std::string_view> names(rig.numbers.channels.begin(), rig.numbers.channels.end());
  v.Words({"channels", names, "list of axes of the rig", "where it acts"}, entry.axes);
}

void DescribeMode(Visitor& v, const RigFile& rig, EffectConfig& entry) {
  v.Integer({"mode", 1, 98, kRequired, "flexible mode, 1 = first bending"}, entry.mode);
  const rotor::RotorConfig& rotor = rig.plant.rotor;
  const std::size_t kept =
      rotor.given ? rotor.given->modes.size() + 2 : rotor.modes_per_plane;  // two rigid ones
  v.RefuseIf(kept >= 2 && entry.mode + 2 > kept, "mode",
             fmt::format("found {}, but the rotor keeps {} flexible modes", entry.mode,
                         kept < 2 ? 0 : kept - 2));
}

// On a rig without gears the entry as a whole is refused, by CheckEffects.
void DescribeGear(Visitor& v, const RigFile& rig, EffectConfig& entry) {
  std::vector<std::string_view> names;
  for (const auto& pair : rig.plant.gears) {
    names.emplace_back(pair.name.empty() ? "<gear>" : std::string_view(pair.name));
  }
  if (names.empty()) names.emplace_back("<gear>");
  v.Choice({"gear", names, kRequired, "which gear pair"}, entry.gear);
  if (entry.id != effect::Id::kGearRunout && entry.id != effect::Id::kToothCrack &&
      entry.id != effect::Id::kMisalignment) {
    return;
  }
  std::size_t wheel = entry.on_driven ? 1 : 0;
  v.Choice({"wheel", kWheels, kRequired, "which of its wheels"}, wheel);
  entry.on_driven = wheel == 1;
}

void RefusePlane(Visitor& v, const RigFile& rig, const EffectConfig& entry) {
  const auto parameters = effect::At(entry.id).parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].stem == "z") {
      RefuseBeyondShaft(v, rig.plant.rotor, entry.values[i], "z_mm");
    }
  }
  if (entry.id != effect::Id::kSensorPosition || entry.bearing >= rig.plant.bearings.size()) return;
  const double z_m = rig.plant.bearings[entry.bearing].sensor_z_m + entry.values[0];
  v.RefuseIf(z_m < 0.0, "shift_mm", "before the drive end of the shaft");
  RefuseBeyondShaft(v, rig.plant.rotor, z_m, "shift_mm");
}

void DescribeValues(Visitor& v, const RigFile& rig, EffectConfig& entry) {
  const effect::Row& row = effect::At(entry.id);
  if (row.scope == Scope::kChannels) DescribeChannels(v, rig, entry);
  if (row.scope == Scope::kBearing) DescribeBearing(v, rig, entry);
  if (row.scope == Scope::kMode) DescribeMode(v, rig, entry);
  const bool of_the_train = entry.id == effect::Id::kMisalignment && !rig.plant.shafts.empty();
  if (row.scope == Scope::kGear || of_the_train) DescribeGear(v, rig, entry);
  if (entry.id == effect::Id::kAxisRotation) {
    std::size_t side = entry.on_sensor ? 1 : 0;
    v.Choice({"of", kSides, kRequired, "what is turned"}, side);
    entry.on_sensor = side == 1;
  }
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    DescribeParameter(v, row.parameters[i], entry.values[i]);
  }
  if (entry.id == effect::Id::kMisalignment) {
    v.RefuseIf(entry.values[2] == 0.0 && entry.values[4] == 0.0, "force_n",
               "neither force_n nor rotation_error_deg says what the coupling does; give one");
  }
  if (!of_the_train) RefusePlane(v, rig, entry);
}

/// Of an effect that is no entry.
std::string InPlaceOf(std::string_view name) {
  const effect::Row* row = effect::Find(name);
  return row == nullptr ? std::string() : effect::InPlaceOfAnEntry(*row);
}

void Describe(Visitor& v, const RigFile& rig, EffectConfig& entry) {
  std::vector<std::string_view> names;
  const auto rows = effect::EntryRows();
  for (const effect::Row& row : rows) names.push_back(row.name);
  const auto own =
      std::ranges::find_if(rows, [&](const effect::Row& row) { return row.id == entry.id; });
  if (own == rows.end()) {
    const effect::Row& row = effect::At(entry.id);
    throw BadInput(std::string(row.name) + ": " + effect::InPlaceOfAnEntry(row));
  }
  auto index = static_cast<std::size_t>(own - rows.begin());
  v.Variant({"id", names, kRequired, "which effect; see docs/effects.md", "", InPlaceOf}, index,
            [&](std::size_t chosen) {
              entry.id = rows[chosen].id;
              DescribeValues(v, rig, entry);
            });
  v.Number({"strength", kOne, 0, 1, 1, "0 = the nominal plant, 1 = as given"}, entry.strength);
  v.Number({"at", kSecond, 0, 1e6, 0, "when it sets in, from the start of the rig"}, entry.at_s);
  v.Number({"ramp", kSecond, 0, 1e6, 0, "how long it then takes to grow to its strength"},
           entry.ramp_s);
}

bool Known(const EffectConfig& entry) {
  bool known = std::isfinite(entry.strength + entry.at_s + entry.ramp_s);
  for (const double value : entry.values) known = known && std::isfinite(value);
  return known;
}

}  // namespace

void DescribeEffects(Visitor& v, RigFile& rig) {
  auto& entries = rig.plant.effects;
  v.List({"effects", 0, kMostEffects, "what the rig does beyond its nominal model"}, entries,
         [&](EffectConfig& entry, std::size_t) { Describe(v, rig, entry); });
  // Fields that were refused are NaN and have been reported; what is left is how entries agree.
  if (!std::ranges::all_of(entries, Known)) return;
  std::string problem;
  try {
    plant::CheckEffects(rig.plant);
  } catch (const std::invalid_argument& refused) {
    problem = refused.what();
  }
  v.RefuseIf(!problem.empty(), "effects", problem);
}

}  // namespace levitas::configuration
