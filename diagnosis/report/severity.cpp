#include "diagnosis/report/severity.hpp"

#include <fmt/core.h>

#include <cmath>

namespace levitas::diagnosis {
namespace {

using effect::Yardstick;

Severity Between(double value, double marked, double severe) {
  if (value < marked) return Severity::kSlight;
  return value < severe ? Severity::kMarked : Severity::kSevere;
}

Judgement OfClearance(double size_m, const ReportScale& scale) {
  if (!(scale.clearance_m > 0.0)) return {};
  const double share = std::abs(size_m) / scale.clearance_m;
  return {Between(share, effect::kZoneAB, effect::kZoneCD),
          fmt::format("it takes {:.0f} % of the touchdown clearance (zone A of ISO 14839-2 ends at "
                      "{:.0f} %, zone D begins at {:.0f} %)",
                      100.0 * share, 100.0 * effect::kZoneAB, 100.0 * effect::kZoneCD)};
}

Judgement OfBalance(double moment_kg_m, const ReportScale& scale) {
  if (!(scale.rotor_mass_kg > 0.0) || !(scale.rated_speed_rad_per_s > 0.0)) return {};
  const double grade = std::abs(moment_kg_m) * scale.rated_speed_rad_per_s / scale.rotor_mass_kg;
  return {Between(grade, effect::kGradeFine, effect::kGradeGeneral),
          fmt::format("at full speed it alone is grade G {:.2g} of ISO 21940-11 (fine machines "
                      "G {:.1f}, general ones G {:.1f})",
                      1e3 * grade, 1e3 * effect::kGradeFine, 1e3 * effect::kGradeGeneral)};
}

Judgement OfLoopGain(double factor) {
  if (!(factor > 0.0)) return {};
  const double margin = factor > 1.0 ? std::log(effect::kMostGain) : -std::log(effect::kLeastGain);
  const double used = std::abs(std::log(factor)) / margin;
  return {Between(used, 0.5, 1.0),
          fmt::format("it uses up {:.0f} % of the gain margin (in dB) that a loop at the end of "
                      "zone A of ISO 14839-3 has",
                      100.0 * used)};
}

}  // namespace

Judgement JudgeSize(Yardstick yardstick, double size, const ReportScale& scale) {
  switch (yardstick) {
    case Yardstick::kGrows:
      return {Severity::kSevere, "at any size"};
    case Yardstick::kClearance:
      return OfClearance(size, scale);
    case Yardstick::kBalance:
      return OfBalance(size, scale);
    case Yardstick::kLoopGain:
      return OfLoopGain(size);
    case Yardstick::kNone:
      break;
  }
  return {};
}

}  // namespace levitas::diagnosis
