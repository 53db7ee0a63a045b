#include "diagnosis/report/calibrated_rig.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <complex>

#include "diagnosis/report/extended_rig.hpp"
#include "diagnosis/report/named_values.hpp"

namespace levitas::diagnosis {
namespace {

/// Into the keys that the file has of its own.
bool IntoKeys(const PlacedEffect& at, config::RigFile& rig) {
  if (at.effect == "extra_delay") {
    rig.plant.delay_samples = std::max(0.0, rig.plant.delay_samples + at.At("samples"));
    return true;
  }
  if (at.effect != "unbalance") return false;
  for (auto& mass : rig.plant.unbalance) {
    if (fmt::format("z {:.1f} mm", mass.z_m * 1e3) != at.place) continue;
    const std::complex<double> sum = std::polar(mass.moment_kg_m, mass.phase_rad) +
                                     std::complex<double>(at.At("cosine"), at.At("sine"));
    mass.moment_kg_m = std::abs(sum);
    mass.phase_rad = std::arg(sum);
    return true;
  }
  return false;
}

bool HasKey(const PlacedEffect& at) {
  return at.effect == "extra_delay" || at.effect == "unbalance";
}

}  // namespace

std::vector<std::string> CalibratedEntries(const DiagnosisResult& answer) {
  std::vector<std::string> entries;
  for (const PlacedEffect& at : CalibrationByPlace(answer)) {
    if (at.effect.empty() || HasKey(at)) continue;
    const std::string entry = EntryText(at.effect, ValuesOf(*answer.view, at));
    if (!entry.empty()) entries.push_back(entry);
  }
  return entries;
}

std::string CalibratedRig(const DiagnosisResult& answer, const config::RigFile& rig) {
  config::RigFile judged = rig;
  std::string comments =
      "# The rig as amb diagnose judged it: its causes, then what was calibrated.\n";
  for (const PlacedEffect& at : CalibrationByPlace(answer)) {
    if (IntoKeys(at, judged) || !at.effect.empty()) continue;
    comments += fmt::format("# no key for {} of {}: {:+.5f}\n", at.theta.begin()->first, at.place,
                            at.theta.begin()->second);
  }
  std::vector<std::string> entries = EffectEntries(answer);
  for (std::string& entry : CalibratedEntries(answer)) entries.push_back(std::move(entry));
  return comments + WithEffects(judged, entries);
}

}  // namespace levitas::diagnosis
