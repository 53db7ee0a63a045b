#include "cli/commands/next_step.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "verdict/verdict.hpp"
#include "verdict/zones.hpp"

namespace levitas::cli {
namespace {

/// Unstable, or in zone C or D.
bool PoorlyDamped(const analysis::SensitivityResult& at) {
  return !at.stable || std::ranges::any_of(at.axes, [](const analysis::AxisSensitivity& axis) {
    return !axis.zone || !verdict::Acceptable(*axis.zone);
  });
}

}  // namespace

std::string NextStep(const verdict::Verdict& verdict, const std::string& rig_name,
                     const std::string& record) {
  if (verdict.inputs.measured && !record.empty()) {
    return fmt::format(
        "next: the record holds test signals: amb identify modal {0}; amb diagnose {0}", record);
  }
  // A loop that cannot be computed (coils on a voltage) is none that amb design knows.
  if (verdict.outcome != verdict::Outcome::kNotAccepted || verdict.inputs.sensitivity.empty()) {
    return {};
  }
  const bool moves_too_far = std::ranges::any_of(
      verdict.orbits, [](const auto& at) { return !at.met || !verdict::Acceptable(at.zone); });
  if (!moves_too_far && std::ranges::none_of(verdict.inputs.sensitivity, PoorlyDamped)) return {};
  return fmt::format(
      "next: amb margins --rig {0} shows |S| and what limits it; amb design pid --rig {0} --out "
      "pid.yaml makes a law that meets the limits, amb run --rig {0} --controller pid.yaml runs it",
      rig_name);
}

}  // namespace levitas::cli
