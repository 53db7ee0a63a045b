#include "verdict/reserve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/critical_speeds.hpp"
#include "analysis/poles.hpp"
#include "analysis/reading_noise.hpp"

namespace levitas::verdict {
namespace {

constexpr double kSlowestHz = 0.1;  // slower is an integrator, not a mode
constexpr int kModeSteps = 12;      // of the speed, in which modes are followed
constexpr double kSame = 1e-3;      // frequencies of two planes that are one mode

void TakeLarger(const RigNumbers& rig, const PhaseFigures& phase, bool spinning, double limit_a,
                std::optional<CurrentReserve>& worst) {
  if (phase.cycles == 0) return;
  for (std::size_t axis = 0; axis < rig.axes(); ++axis) {
    const double peak_a = phase.bearings[axis / 2].current[axis % 2].peak_a;
    if (worst && peak_a <= worst->peak_a) continue;
    worst = CurrentReserve{rig.channels[axis], spinning, peak_a, limit_a, peak_a / limit_a};
  }
}

}  // namespace

std::vector<double> ProbeNoise(const plant::PlantConfig& plant) {
  std::vector<double> noise_m;
  for (const auto& bearing : plant.bearings) {
    // Two probes of a bearing.
    noise_m.push_back(std::numbers::sqrt2 * analysis::ReadingNoise(bearing.sensor));
  }
  return noise_m;
}

std::optional<CurrentReserve> CurrentUse(const RigNumbers& rig, const SessionFigures& session) {
  const double limit_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  std::optional<CurrentReserve> worst;
  if (!(limit_a > 0.0)) return worst;
  TakeLarger(rig, session.standing, false, limit_a, worst);
  TakeLarger(rig, session.spinning, true, limit_a, worst);
  return worst;
}

std::optional<LeastDamping> DampingOver(std::span<const analysis::SensitivityResult> speeds,
                                        const plant::PlantConfig& plant,
                                        const law::LawConfig& law) {
  std::optional<LeastDamping> least;
  for (const analysis::SensitivityResult& at : speeds) {
    const auto loop = analysis::ClosedLoopPoles(plant, law, at.speed_rad_per_s);
    for (const analysis::Pole& pole : loop.poles) {
      if (std::abs(pole.frequency_hz) < kSlowestHz) continue;
      if (least && pole.damping_ratio >= least->damping_ratio) continue;
      least = LeastDamping{pole.damping_ratio, pole.frequency_hz, at.speed_rad_per_s};
    }
  }
  return least;
}

std::vector<ModeDamping> DampingOfModes(const plant::PlantConfig& plant, const law::LawConfig& law,
                                        double top_rad_per_s) {
  // A rotor that never turned is the same at every step.
  const int steps = top_rad_per_s > 0.0 ? kModeSteps : 1;
  const auto campbell =
      analysis::CampbellOf(analysis::LevitatedModes(plant, law), top_rad_per_s, steps, {});
  std::vector<ModeDamping> modes;
  // Of each pole at the speed before: its place in `modes`.
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < campbell.speeds.size(); ++i) {
    const analysis::CampbellSpeed& at = campbell.speeds[i];
    constexpr std::size_t kNew = ~std::size_t{0};
    std::vector<std::size_t> here(at.modes.size(), kNew);
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (const auto& next = campbell.next[i - 1][k]) here[*next] = known[k];
    }
    for (std::size_t k = 0; k < here.size(); ++k) {
      const analysis::CampbellMode& pole = at.modes[k];
      const LeastDamping found{pole.damping_ratio, pole.frequency_hz, at.speed_rad_per_s};
      if (here[k] == kNew) {
        const auto same = std::ranges::find_if(modes, [&](const ModeDamping& mode) {
          return i == 0 && std::abs(mode.at_rest_hz - pole.frequency_hz) < kSame * mode.at_rest_hz;
        });
        here[k] = static_cast<std::size_t>(same - modes.begin());
        if (same == modes.end()) modes.push_back({pole.frequency_hz, found});
      }
      LeastDamping& least = modes[here[k]].least;
      if (found.damping_ratio < least.damping_ratio) least = found;
    }
    known = std::move(here);
  }
  std::ranges::sort(modes, {}, &ModeDamping::at_rest_hz);
  return modes;
}

}  // namespace levitas::verdict
