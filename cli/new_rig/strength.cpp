#include "cli/new_rig/strength.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

// What a rig file takes (docs/configuration.md).
constexpr double kLeastKi = 0.01;
constexpr double kMostKi = 1e5;
constexpr double kLeastConstant = 1e-9;
constexpr double kMostConstant = 1e-2;
constexpr double kLeastDiameterMm = 0.1;
constexpr double kMostDiameterMm = 5000.0;

const char* NameOf(std::size_t bearing) { return bearing == 0 ? "front" : "rear"; }

/// [N] of the weight in each axis of a bearing; its axes are at 45 degrees to the vertical.
double LoadOf(const RigSketch& sketch, const SketchNumbers& numbers, std::size_t bearing) {
  return sketch.vertical ? 0.0 : 9.81 * std::abs(numbers.carried_kg[bearing]) / std::numbers::sqrt2;
}

}  // namespace

void RefuseStrength(const RigSketch& sketch, const std::string& option) {
  const double gap_m = 1e-3 * sketch.gap_mm;
  const double per_ki = gap_m * gap_m / (4.0 * sketch.bias_a);  // the force constant, for a ki of 1
  const double least = std::max(kLeastKi, kLeastConstant / per_ki);
  const double most = std::min(kMostKi, kMostConstant / per_ki);
  if (sketch.ki_n_per_a >= least && sketch.ki_n_per_a <= most) return;
  throw BadInput(fmt::format(
      "{}: found a magnet of {:.4g} N/A, allowed {:.4g} to {:.4g} N/A with --gap-mm {:g} and "
      "--bias-a {:g}. Check the unit of each: ks = ki bias / gap",
      option, sketch.ki_n_per_a, least, most, sketch.gap_mm, sketch.bias_a));
}

void RefuseDiameter(const RigSketch& sketch, const SketchNumbers& numbers) {
  if (numbers.diameter_mm >= kLeastDiameterMm && numbers.diameter_mm <= kMostDiameterMm) return;
  throw BadInput(fmt::format(
      "--mass-kg {:g}, --length-mm {:g}: found a steel shaft of {:.4g} mm diameter, allowed {:g} "
      "to {:g} mm. Check mass and length, and what the discs (--disc) have of the mass",
      sketch.mass_kg, sketch.length_mm, numbers.diameter_mm, kLeastDiameterMm, kMostDiameterMm));
}

void RefuseOverload(const RigSketch& sketch, const SketchNumbers& numbers) {
  const double most_n = sketch.ki_n_per_a * sketch.bias_a;
  for (std::size_t b = 0; b < numbers.carried_kg.size(); ++b) {
    const double load_n = LoadOf(sketch, numbers, b);
    if (load_n < most_n) continue;
    throw BadInput(fmt::format(
        "the {} magnet cannot carry the rotor: {:.4g} N of its weight in each axis, and {:.4g} N/A "
        "times {:.4g} A of bias are {:.4g} N. Half of what a magnet has is for control: give "
        "{}, more bias, or a lighter rotor",
        NameOf(b), load_n, sketch.ki_n_per_a, sketch.bias_a, most_n,
        sketch.turns > 0.0
            ? fmt::format("more turns or a larger pole, {:.1f} times as strong a magnet or more",
                          2.0 * load_n / most_n)
            : fmt::format("--ki-n-per-a {:.0f} or more", std::ceil(2.0 * load_n / sketch.bias_a))));
  }
}

std::string LoadsText(const RigSketch& sketch, const SketchNumbers& numbers) {
  std::string text;
  for (std::size_t b = 0; b < numbers.carried_kg.size(); ++b) {
    if (sketch.vertical) {
      text += fmt::format("  {} bearing guides {:.3g} kg and carries no weight: the shaft stands\n",
                          NameOf(b), numbers.carried_kg[b]);
      continue;
    }
    const double newton = 9.81 * numbers.carried_kg[b];
    const double ampere = LoadOf(sketch, numbers, b) / sketch.ki_n_per_a;
    text +=
        fmt::format("  {} bearing carries {:.1f} N: {:.2f} A of {:.2f} A in each axis{}\n",
                    NameOf(b), newton, ampere, sketch.bias_a,
                    ampere > 0.5 * sketch.bias_a ? ", which leaves little to control with" : "");
  }
  return text;
}

}  // namespace levitas::cli
