#include "cli/new_rig/start_law.hpp"

#include <cmath>
#include <limits>

#include "analysis/free_modes.hpp"
#include "analysis/poles.hpp"
#include "analysis/speed_sweep.hpp"

namespace levitas::cli {
namespace {

/// The largest |S| at rest of a loop that is stable there and at top speed; infinite of another.
double Peak(const configuration::RigFile& rig, const law::LawConfig& law) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const double speed : {0.0, rig.numbers.max_speed_rad_per_s}) {
    if (!analysis::ClosedLoopPoles(rig.plant, law, speed).stable) return kNone;
  }
  const analysis::SensitivityResult at = analysis::SensitivityPeaks(rig.plant, law, 0.0);
  return at.axes[analysis::WorstAxis(at)].peak;
}

std::vector<std::vector<double>> NotchSets(const configuration::RigFile& rig, double rate_hz) {
  constexpr double kHighest = 0.4;  // of the rate: beyond it a notch does not stand where it is put
  std::vector<std::vector<double>> sets{{}};
  const auto modes = analysis::ComputeFreeModes(rig.plant, {0.0}, 2).whirl.front().forward_hz;
  for (const double factor : {0.85, 1.0}) {
    std::vector<double> both;
    for (const double mode_hz : modes) {
      const double hz = factor * mode_hz;
      if (hz > kHighest * rate_hz) continue;
      sets.push_back({hz});
      both.push_back(hz);
    }
    if (both.size() > 1) sets.push_back(both);
  }
  return sets;
}

std::vector<StartLaw> Forms(const RigSketch& sketch, const configuration::RigFile& rig) {
  std::vector<StartLaw> forms;
  for (const auto& notch_hz : NotchSets(rig, sketch.rate_hz)) {
    for (const double stiffness : {1.5, 2.0, 2.5}) {
      for (const double damping : {0.5, 0.7, 1.0, 1.4}) {
        for (const bool lead : {false, true}) forms.push_back({stiffness, damping, lead, notch_hz});
      }
    }
  }
  return forms;
}

}  // namespace

StartLaw ChooseStartLaw(const RigSketch& sketch, const configuration::RigFile& rig) {
  StartLaw best;
  double least = std::numeric_limits<double>::infinity();
  for (const StartLaw& form : Forms(sketch, rig)) {
    const auto controller =
        configuration::ParseController(SketchController(sketch, form), "start law", rig.numbers);
    const double peak = Peak(rig, controller.law);
    if (!(peak < least)) continue;
    least = peak;
    best = form;
  }
  return best;
}

}  // namespace levitas::cli
