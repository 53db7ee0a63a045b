#include "cli/commands/next_step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

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

/// pid.yaml, pid_2.yaml ...: amb design replaces what is there.
std::string FreeName() {
  std::string name = "pid.yaml";
  std::error_code unknown;
  for (int i = 2; std::filesystem::exists(name, unknown); ++i) name = fmt::format("pid_{}.yaml", i);
  return name;
}

std::string OfTestSignals(const std::string& record) {
  if (record.empty()) {
    return "next: the run held test signals, and its record was not kept: --record FILE keeps it "
           "for amb identify modal and amb diagnose";
  }
  return fmt::format(
      "next: the record holds test signals: amb identify modal '{0}'; amb diagnose '{0}' --out "
      "answer",
      record);
}

}  // namespace

std::string NextStep(const verdict::Verdict& verdict, const RunAsAsked& run) {
  if (verdict.inputs.measured) return OfTestSignals(run.record);
  // A loop that cannot be computed (coils on a voltage) is none that amb design knows.
  if (verdict.outcome != verdict::Outcome::kNotAccepted || verdict.inputs.sensitivity.empty() ||
      run.other_rig) {
    return {};
  }
  const bool moves_too_far = std::ranges::any_of(
      verdict.orbits, [](const auto& at) { return !at.met || !verdict::Acceptable(at.zone); });
  if (!moves_too_far && std::ranges::none_of(verdict.inputs.sensitivity, PoorlyDamped)) return {};
  const std::string law =
      run.controller.empty() ? "" : fmt::format(" --controller '{}'", run.controller);
  return fmt::format(
      "next: amb margins --rig '{0}'{1} shows |S| and what limits it; amb design pid --rig '{0}' "
      "--out {2} makes a law that meets the limits, amb run --rig '{0}' --controller {2} runs it",
      run.rig, law, FreeName());
}

}  // namespace levitas::cli
