#include "plant_sim/effect/catalogue.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace levitas::effect {
namespace {

std::string Joined(std::string_view stem, std::string_view suffix) {
  std::string name(stem);
  if (!suffix.empty()) name.append("_").append(suffix);
  return name;
}

std::vector<Row> Collect() {
  std::vector<Row> all;
  for (const auto rows : {LoopRows(), MagnetRows(), SensorRows(), RotorRows(), ExternalRows(),
                          GearRows(), CoilRows(), BallRows()}) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  std::sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return a.id < b.id; });
  return all;
}

}  // namespace

std::span<const Row> Catalogue() {
  static const std::vector<Row> kRows = Collect();
  return kRows;
}

std::span<const Row> EntryRows() {
  static const std::vector<Row> kRows = [] {
    std::vector<Row> rows;
    std::ranges::copy_if(Catalogue(), std::back_inserter(rows), IsEntry);
    return rows;
  }();
  return kRows;
}

bool IsEntry(const Row& row) noexcept {
  return row.place != Place::kCoil && row.place != Place::kBall;
}

std::string InPlaceOfAnEntry(const Row& row) {
  if (row.rig_key.empty()) return "no simulated rig has it; leave it out";
  return "coils on a voltage have it by keys of their own; write " + std::string(row.rig_key) +
         " instead, and leave it out for other coils";
}

const Row& At(Id id) { return Catalogue()[static_cast<std::size_t>(id)]; }

const Row* Find(std::string_view name) {
  const auto rows = Catalogue();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<Id> IdsOf(std::span<const std::string> names) {
  std::vector<Id> ids;
  for (const std::string& name : names) {
    if (const Row* row = Find(name)) ids.push_back(row->id);
  }
  return ids;
}

std::vector<std::string> NamesOf(std::span<const Id> ids) {
  std::vector<std::string> names;
  names.reserve(ids.size());
  for (const Id id : ids) names.emplace_back(At(id).name);
  return names;
}

std::string_view Name(Place place) noexcept {
  constexpr std::array<std::string_view, 10> kNames{"timing",  "amplifier", "magnet", "rotor",
                                                    "support", "external",  "gear",   "sensor",
                                                    "coil",    "ball"};
  return kNames.at(static_cast<std::size_t>(place));
}

std::string_view Name(Scope scope) noexcept {
  constexpr std::array<std::string_view, 5> kNames{"rig", "channels", "bearing", "mode", "gear"};
  return kNames.at(static_cast<std::size_t>(scope));
}

std::string FileKey(const Parameter& parameter) {
  return Joined(parameter.stem, parameter.file_suffix);
}

std::string SiName(const Parameter& parameter) {
  return Joined(parameter.stem, parameter.si_suffix);
}

EffectConfig ClearEntry(Id id, double own) {
  EffectConfig entry;
  entry.id = id;
  const auto parameters = At(id).parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool relative = parameters[i].neutral != parameters[i].neutral;  // kOwn
    entry.values[i] = relative ? own * parameters[i].clear : parameters[i].clear;
  }
  return entry;
}

}  // namespace levitas::effect
