#pragma once
// What amb diagnose prints and writes of a ball between two magnets: as of every rig
// (diagnosis_files.hpp), and the fits run by run.
//
// Failure  BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "diagnosis/levitator/levitator_result.hpp"

namespace levitas::cli {

void PrintLevitator(const levitator::LevitatorResult& answer, bool complete);
[[nodiscard]] nlohmann::ordered_json LevitatorJson(const levitator::LevitatorResult& answer);
/// The paths that were written.
std::vector<std::string> WriteLevitator(const levitator::LevitatorResult& answer,
                                        const std::string& folder);

}  // namespace levitas::cli
