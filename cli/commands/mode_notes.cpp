#include "cli/commands/mode_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace levitas::cli {
namespace {

/// "561.0, 1203.4 Hz": both planes of a round rotor have the same ones, which are said once.
template <class Condition>
std::string Frequencies(const std::vector<analysis::DampedMode>& modes, Condition condition) {
  std::vector<std::string> texts;
  for (const analysis::DampedMode& mode : modes) {
    if (!condition(mode)) continue;
    const std::string text = fmt::format("{:.1f}", mode.frequency_hz);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
  }
  return texts.empty() ? std::string{} : fmt::format("{} Hz", fmt::join(texts, ", "));
}

}  // namespace

std::vector<std::string> ModeNotes(const std::vector<analysis::DampedMode>& modes,
                                   double sampling_hz) {
  std::vector<std::string> notes;
  const auto above = [&](const auto& mode) { return mode.frequency_hz > 0.5 * sampling_hz; };
  if (const std::string hz = Frequencies(modes, above); !hz.empty()) {
    notes.push_back(
        fmt::format("Above half the sampling rate ({:.0f} Hz), where the controller sees a mode at "
                    "a lower, false frequency and cannot damp it: {}.",
                    0.5 * sampling_hz, hz));
  }
  const auto bare = [](const auto& mode) { return mode.damping_ratio < kMaterialDamping; };
  if (const std::string hz = Frequencies(modes, bare); !hz.empty()) {
    notes.push_back(fmt::format(
        "Less damped by the rig file (damping ratio below {:g}) than by a shaft's material alone; "
        "check its damping: {}.",
        kMaterialDamping, hz));
  }
  return notes;
}

}  // namespace levitas::cli
