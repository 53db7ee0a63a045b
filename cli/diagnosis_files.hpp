#pragma once
// What amb diagnose prints and writes: diagnosis.json, extended_rig.yaml, report.html.
//
// Failure  BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "config/rig_file.hpp"
#include "diagnosis/session.hpp"

namespace levitas::cli {

void PrintDiagnosis(const diagnosis::SessionAnswer& answer);
[[nodiscard]] nlohmann::ordered_json DiagnosisJson(const diagnosis::SessionAnswer& answer);
void WriteDiagnosis(const diagnosis::SessionAnswer& answer, const config::RigFile& rig,
                    const std::string& folder);

}  // namespace levitas::cli
