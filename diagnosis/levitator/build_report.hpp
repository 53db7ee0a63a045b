#pragma once
// The report of a levitator's diagnosis: the same plain data as for a rotor.
//
// Place    that of the first cause's parameter (parameters.hpp). Effects of voltage-driven coils
//          are not in the catalogue of effects, which knows the places of a rotor's effects alone.
// Thread   any; pure.

#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::levitator {

[[nodiscard]] diagnosis::DiagnosisReport BuildReport(const LevitatorResult& result);

}  // namespace levitas::levitator
