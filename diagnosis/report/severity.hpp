#pragma once
// How severe a cause is, by its size alone, where a standard or a margin says so (Yardstick of
// plant_sim/effect/workshop.hpp, with the limits and their sources).
//
// Clearance  below zone A/B slight, below C/D marked, from there severe.
// Balance    moment x rated speed / mass: up to G 2.5 slight, up to G 6.3 marked, above severe.
// Loop gain  a factor beyond what a loop at the end of zone A bears is severe; beyond the square
//            root of it, half the margin in dB, marked.
// Grows      severe at any size.
// Thread     any; pure.

#include <string>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

struct Judgement {
  Severity severity{Severity::kNotSaid};
  std::string sentence;  ///< by what; empty where nothing is said
};

/// `size` in SI, a factor for the gain of the loop.
[[nodiscard]] Judgement JudgeSize(effect::Yardstick yardstick, double size,
                                  const ReportScale& scale);

}  // namespace levitas::diagnosis
