#include "diagnosis/report/calibrated_rig.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "diagnosis/report/extended_rig.hpp"
#include "diagnosis/report/named_values.hpp"

namespace levitas::diagnosis {
namespace {

/// Into the keys that the file has of its own.
bool IntoKeys(const PlacedEffect& at, configuration::RigFile& rig) {
  if (at.effect == effect::Id::kExtraDelay) {
    rig.plant.delay_samples = std::max(0.0, rig.plant.delay_samples + at.At("samples"));
    return true;
  }
  if (at.effect != effect::Id::kUnbalance) return false;
  for (auto& mass : rig.plant.unbalance) {
    if (std::abs(mass.z_m - at.location.z_m.value()) >= kSamePlaneM) continue;
    const std::complex<double> sum = std::polar(mass.moment_kg_m, mass.phase_rad) +
                                     std::complex<double>(at.At("cosine"), at.At("sine"));
    mass.moment_kg_m = std::abs(sum);
    mass.phase_rad = std::arg(sum);
    return true;
  }
  return false;
}

bool HasKey(const PlacedEffect& at) {
  return at.effect == effect::Id::kExtraDelay || at.effect == effect::Id::kUnbalance;
}

}  // namespace

std::vector<effect::EffectConfig> CalibratedEntries(const DiagnosisResult& answer) {
  std::vector<effect::EffectConfig> entries;
  for (const PlacedEffect& at : CalibrationByPlace(answer)) {
    if (!at.effect || HasKey(at)) continue;
    if (const auto entry = EntryFor(*answer.view, at)) entries.push_back(*entry);
  }
  return entries;
}

std::string CalibratedRig(const DiagnosisResult& answer, const configuration::RigFile& rig) {
  configuration::RigFile judged = WithOwnKeys(answer, rig);
  std::string comments =
      "# The rig as amb diagnose judged it: its causes, then what was calibrated.\n";
  for (const PlacedEffect& at : CalibrationByPlace(answer)) {
    if (IntoKeys(at, judged) || at.effect) continue;
    comments += fmt::format("# no key for {} of {}: {:+.5f}\n", at.theta.begin()->first,
                            at.location.name, at.theta.begin()->second);
  }
  std::vector<effect::EffectConfig> entries = EffectEntries(answer);
  for (const effect::EffectConfig& entry : CalibratedEntries(answer)) entries.push_back(entry);
  return comments + WithEffects(judged, entries);
}

}  // namespace levitas::diagnosis
