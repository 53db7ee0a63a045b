#pragma once
// What amb simulate writes: JSON of all figures, spectra as CSV and as a picture.
//
// Failure  BadInput when a file cannot be written. An empty path writes nothing.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/records/innovations.hpp"
#include "common/rig_numbers.hpp"

namespace levitas::cli {

struct InnovationContext {
  const RigNumbers& rig;
  const analysis::ObserverGain& gain;
  const analysis::InnovationRun& run;
  const analysis::InnovationReport& report;
};

[[nodiscard]] nlohmann::ordered_json InnovationJson(const InnovationContext& context);
/// frequency_hz, then one density_<channel>_m2_per_hz per channel.
void WriteSpectrumCsv(const std::string& path, const InnovationContext& context);
/// Amplitude density of every channel over logarithmic frequency, with what noise explains.
void WriteSpectrumSvg(const std::string& path, const InnovationContext& context);

}  // namespace levitas::cli
