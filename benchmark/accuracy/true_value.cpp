#include "benchmark/accuracy/true_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::accuracy {
namespace {

/// Whether a place speaks of a channel or bearing by its whole name: "nde_y" is no word of "de_y".
bool Speaks(std::string_view place, std::string_view name) {
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (auto at = place.find(name); at != std::string_view::npos; at = place.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool begins = at == 0 || !(letter(place[at - 1]) || place[at - 1] == '_');
    if (begins && (end == place.size() || !letter(place[end]))) return true;
  }
  return false;
}

/// Index of the parameter with one of these stems; the number of parameters when there is none.
std::size_t IndexOf(const effect::Row& row, std::initializer_list<std::string_view> stems) {
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    if (std::find(stems.begin(), stems.end(), row.parameters[i].stem) != stems.end()) return i;
  }
  return row.parameters.size();
}

/// Entries of what a parameter of the answer speaks of: the hidden one, and what the rig is off by
/// anyway at the same place. Empty: it speaks of another place.
std::vector<const effect::EffectConfig*> Entries(const diagnosis::NamedParameter& p,
                                                 const GroundTruth& ground_truth,
                                                 const RigNumbers& rig) {
  const auto here = [&](const effect::EffectConfig& entry) {
    const effect::Row& row = effect::At(entry.id);
    if (row.name != p.effect) return false;
    if (row.scope == effect::Scope::kBearing) return Speaks(p.place, rig.bearings[entry.bearing]);
    for (std::size_t a = 0; a < rig.axes(); ++a) {
      if (entry.Acts(a) && Speaks(p.place, rig.channels[a])) return true;
    }
    return row.scope != effect::Scope::kChannels;
  };
  const auto hidden = std::find_if(ground_truth.hidden.begin(), ground_truth.hidden.end(), here);
  if (hidden == ground_truth.hidden.end()) return {};
  // What acts at several planes or orders is meant at those of the hidden one.
  const effect::Row& row = effect::At(hidden->id);
  const std::size_t z = IndexOf(row, {"z"});
  const std::size_t order = IndexOf(row, {"order"});
  const std::size_t none = row.parameters.size();
  if (order < none &&
      p.place.find(fmt::format("order {:.0f}", hidden->values[order])) == std::string::npos) {
    return {};
  }
  std::vector<const effect::EffectConfig*> found;
  for (const effect::EffectConfig& entry : ground_truth.truth.config.effects) {
    if (!here(entry)) continue;
    if (z < none && entry.values[z] != hidden->values[z]) continue;
    if (order < none && entry.values[order] != hidden->values[order]) continue;
    found.push_back(&entry);
  }
  return found;
}

}  // namespace

std::optional<double> TrueValue(const diagnosis::NamedParameter& p, const GroundTruth& ground_truth,
                                const RigNumbers& rig) {
  const auto entries = Entries(p, ground_truth, rig);
  if (entries.empty()) return std::nullopt;
  const effect::Row& row = effect::At(entries.front()->id);
  const auto is = [&p](const effect::Parameter& known) {
    return p.key == known.stem || p.key == fmt::format("{}_{}", known.stem, known.file_suffix);
  };
  const std::size_t none = row.parameters.size();
  const std::size_t phase = IndexOf(row, {"phase"});
  if (phase < none) {
    const std::size_t size = IndexOf(row, {"amplitude", "ratio", "moment", "force"});
    if (size == none || !is(row.parameters[size])) return std::nullopt;
    std::complex<double> sum;
    for (const auto* entry : entries) sum += std::polar(entry->values[size], entry->values[phase]);
    return std::abs(sum) / p.si;
  }
  for (std::size_t i = 0; i < none; ++i) {
    const auto& known = row.parameters[i];
    // What counts from the rig's own value neither adds nor multiplies.
    if (!is(known) || (std::isnan(known.neutral) && row.scope != effect::Scope::kGear)) continue;
    const bool ratio = known.neutral == 1.0;
    double truth = ratio ? 1.0 : 0.0;
    for (const auto* entry : entries) {
      truth = ratio ? truth * entry->values[i] : truth + entry->values[i];
    }
    return truth / p.si;
  }
  return std::nullopt;
}

}  // namespace levitas::accuracy
