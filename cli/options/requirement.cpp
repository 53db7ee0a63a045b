#include "cli/options/requirement.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <vector>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "verdict/verdict.hpp"

namespace levitas::cli {
namespace {

using analysis::Zone;

/// The worst zone that a word allows; none: any.
std::optional<Zone> WorstAllowed(const std::string& word) {
  if (word == "zone-a") return Zone::kA;
  if (word == "zone-b") return Zone::kB;
  return std::nullopt;
}

[[noreturn]] void NotMet(const std::string& word, const std::string& why) {
  throw Problem(ExitStatus::kNotMet, fmt::format("--require {}: not met: {}", word, why));
}

void RequireZone(const std::string& word, const analysis::SensitivityResult& loop) {
  const double rpm = RadPerSToRpm(loop.speed_rad_per_s);
  if (!loop.point.failure.empty() || !loop.stable) {
    NotMet(word, fmt::format("the loop does not hold the rotor at {:.0f} rpm", rpm));
  }
  const std::optional<Zone> allowed = WorstAllowed(word);
  if (allowed && loop.zone && *loop.zone > *allowed) {
    NotMet(word, fmt::format("the sensitivity peak is in zone {} at {:.0f} rpm",
                             analysis::Name(*loop.zone), rpm));
  }
}

void AddOption(CLI::App& command, std::string& word, const std::vector<std::string>& words,
               const char* text) {
  command.add_option("--require", word, text)->check(CLI::IsMember(words));
}

}  // namespace

void AddLoopRequirement(CLI::App& command, std::string& word) {
  AddOption(command, word, {"stable", "zone-b", "zone-a"},
            "Exit status 5 unless the loops are stable, or in zone B or A at the speeds asked");
}

void AddRunRequirement(CLI::App& command, std::string& word) {
  AddOption(
      command, word, {"stable", "zone-b", "zone-a", "accepted"},
      "Exit status 5 unless the run was completed (a trip keeps 4), its sensitivity peaks are "
      "in zone B or A, or it is ACCEPTED");
}

void RequireLoops(const std::string& word, std::span<const analysis::SensitivityResult> loops) {
  if (word.empty()) return;
  for (const analysis::SensitivityResult& loop : loops) RequireZone(word, loop);
}

void RequireRun(const std::string& word, const verdict::Verdict& verdict) {
  if (word.empty()) return;
  const bool completed = verdict.outcome == verdict::Outcome::kAccepted ||
                         verdict.outcome == verdict::Outcome::kNotAccepted;
  if (!completed || (word == "accepted" && verdict.outcome != verdict::Outcome::kAccepted)) {
    NotMet(word, verdict.sentence);
  }
  const std::optional<Zone> allowed = WorstAllowed(word);
  if (!allowed) return;
  RequireLoops(word, verdict.inputs.sensitivity);
  if (!verdict.inputs.measured) return;
  for (const verdict::MeasuredSpeed& speed : verdict.inputs.measured->speeds) {
    for (const verdict::MeasuredAxis& axis : speed.axes) {
      if (!axis.zone || *axis.zone <= *allowed) continue;
      NotMet(word, fmt::format("the measured sensitivity peak of {} is in zone {}", axis.channel,
                               analysis::Name(*axis.zone)));
    }
  }
}

}  // namespace levitas::cli
