#include "benchmark/accuracy/true_value.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::accuracy {
namespace {

/// Index of the parameter with one of these stems; the number of parameters when there is none.
std::size_t IndexOf(const effect::Row& row, std::initializer_list<std::string_view> stems) {
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    if (std::find(stems.begin(), stems.end(), row.parameters[i].stem) != stems.end()) return i;
  }
  return row.parameters.size();
}

/// Hidden effect and mismatch of the rig at the place of an estimated parameter; empty where
/// nothing acts there.
std::vector<const effect::EffectConfig*> Entries(const diagnosis::NamedParameter& p,
                                                 const GroundTruth& ground_truth) {
  const auto here = [&](const effect::EffectConfig& entry) {
    const effect::Row& row = effect::At(entry.id);
    if (row.name != p.effect) return false;
    if (row.scope == effect::Scope::kBearing) return p.location.bearing == entry.bearing;
    if (p.location.axis && entry.Acts(*p.location.axis)) return true;
    return row.scope != effect::Scope::kChannels;
  };
  const auto hidden = std::find_if(ground_truth.hidden.begin(), ground_truth.hidden.end(), here);
  if (hidden == ground_truth.hidden.end()) return {};
  // What acts at several planes or orders is meant at those of the hidden one.
  const effect::Row& row = effect::At(hidden->id);
  const std::size_t z = IndexOf(row, {"z"});
  const std::size_t order = IndexOf(row, {"order"});
  const std::size_t none = row.parameters.size();
  if (order < none && p.location.order != std::lround(hidden->values[order])) return {};
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

std::optional<double> TrueValue(const diagnosis::NamedParameter& p,
                                const GroundTruth& ground_truth) {
  const auto entries = Entries(p, ground_truth);
  if (entries.empty()) return std::nullopt;
  const effect::Row& row = effect::At(entries.front()->id);
  const auto is = [&p](const effect::Parameter& known) { return p.key == effect::FileKey(known); };
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
