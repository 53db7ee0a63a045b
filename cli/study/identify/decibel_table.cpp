#include "cli/study/identify/decibel_table.hpp"

#include <fmt/core.h>

#include <array>
#include <string>

#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

void PrintRow(const std::string& of, double modal, double decibel, const char* format) {
  fmt::print("    {:<44}{:>12}{:>12}\n", of, fmt::format(fmt::runtime(format), modal),
             fmt::format(fmt::runtime(format), decibel));
}

const char* Ended(const DecibelStage& stage) {
  return stage.converged || stage.unknowns == 0 ? "" : " (not converged)";
}

void PrintSpeed(const DecibelSpeed& s) {
  fmt::print("  {:.0f} rpm\n", RadPerSToRpm(s.speed_rad_per_s));
  PrintRow("weighted, rms dB", s.modal.weighted_rms_db, s.decibel.weighted_rms_db, "{:.4f}");
  constexpr std::array<const char*, kDecibelRegions> kNames{"around peaks and valleys",
                                                            "where noise rules", "elsewhere"};
  for (std::size_t r = 0; r < kDecibelRegions; ++r) {
    PrintRow(fmt::format("{}, {:.0f} % of the entries, rms dB", kNames[r], 100.0 * s.share[r]),
             s.modal.rms_db[r], s.decibel.rms_db[r], "{:.4f}");
  }
  PrintRow("misfit, as above", s.modal_misfit, s.decibel_misfit, "{:.3f}");
}

}  // namespace

void PrintDecibelFit(const ModalResult& modal, const DecibelFit& fit) {
  fmt::print(
      "\ncost in decibels, weights {:g} within 5 Hz of peaks and valleys, {:g} where noise rules, "
      "{:g} elsewhere\n"
      "{} unknowns standing{}, then {} of the gyroscopic matrix{}\n{:>60}{:>12}\n",
      kDecibelWeights[0], kDecibelWeights[1], kDecibelWeights[2], fit.standing.unknowns,
      Ended(fit.standing), fit.gyroscopic.unknowns, Ended(fit.gyroscopic), "modal fit",
      "decibel fit");
  for (const DecibelSpeed& speed : fit.speeds) PrintSpeed(speed);
  fmt::print("  free rotor at rest\n");
  for (Eigen::Index i = 2; i < 2 + modal.start.frame.layout.bending; ++i) {
    const auto mode = static_cast<std::size_t>(i - 2);
    if (modal.support[mode].support != Support::kShown) continue;
    PrintRow(fmt::format("mode {}, Hz", i - 1), modal.rig.frequency_rad_per_s[i] / kTwoPi,
             fit.rig.frequency_rad_per_s[i] / kTwoPi, "{:.3f}");
    PrintRow(fmt::format("mode {}, damping ratio", i - 1), modal.rig.damping_ratio[i],
             fit.rig.damping_ratio[i], "{:.5f}");
  }
}

}  // namespace levitas::cli
