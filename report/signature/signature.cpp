#include "report/signature/signature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "configuration/schema/unit.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"

namespace levitas::signature {

using effect::Shows;

namespace {

/// As it is printed: the micro of files' keys is a u.
std::string Symbol(const configuration::Unit& unit) {
  const std::string symbol(unit.symbol);
  return symbol == "um" || symbol == "us" ? "µ" + symbol.substr(1) : symbol;
}

std::string InUnit(double value, const configuration::Unit& unit) {
  const double per_si = std::pow(10.0, unit.decimal_exponent) * static_cast<double>(unit.factor);
  return fmt::format("{:.4g}{}{}", value / per_si, unit.symbol.empty() ? "" : " ", Symbol(unit));
}

}  // namespace

const configuration::Unit& FileUnit(const effect::Parameter& parameter) {
  for (const configuration::Unit& unit : configuration::AllUnits()) {
    if (!unit.suffix.empty() && unit.suffix == parameter.file_suffix) return unit;
  }
  return configuration::unit::kOne;
}

std::string SizeText(const plant::PlantParameters& rig, const effect::EffectConfig& entry) {
  const plant::Values own = plant::OwnValues(rig, entry, 0);
  const auto parameters = effect::At(entry.id).parameters;
  std::string text;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const effect::Parameter& p = parameters[i];
    const configuration::Unit& unit = FileUnit(p);
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", p.stem, InUnit(entry.values[i], unit));
    if (std::isnan(p.neutral)) text += fmt::format(" (the rig has {})", InUnit(own[i], unit));
  }
  return text;
}

svg::Figure Picture(const plant::PlantParameters& rig, const effect::EffectConfig& entry) {
  Pair rigs{rig, rig};
  rigs.without.config.effects.clear();
  rigs.with.config.effects = {entry};
  svg::Figure figure;
  figure.title = fmt::format("{}: {}", effect::At(entry.id).name, SizeText(rig, entry));
  figure.lines = {std::string(effect::At(entry.id).meaning)};
  figure.columns = 3;
  switch (effect::At(entry.id).facts.shows_in) {
    case Shows::kResponse:
      figure.panels = ResponsePanels(rigs);
      break;
    case Shows::kSpectrum:
      figure.panels = SpectrumPanels(rigs);
      break;
    case Shows::kForce:
      figure.panels = ForcePanels(rigs);
      break;
    case Shows::kGearMesh:
      figure.panels = GearPanels(rigs);
      break;
  }
  return figure;
}

}  // namespace levitas::signature
