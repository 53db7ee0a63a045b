#include "design/pid/requirements.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/rotational_speed.hpp"

namespace levitas::design {
namespace {

/// More of these is better.
bool IsFloor(Limit limit) { return limit == Limit::kDamping || limit == Limit::kStiffness; }

void TakeMost(Met& met, double found, double hz, double speed) {
  if (found > met.found) met = {found, 0.0, hz, speed};
}

void TakePeaks(const LoopSurvey& survey, double speed, PidFigures& out) {
  const auto take = [&](Limit limit, const PeakAt& peak) {
    TakeMost(out[limit], peak.value, peak.hz, speed);
  };
  take(Limit::kSensitivity, survey.sensitivity);
  take(Limit::kComplementary, survey.complementary);
  take(Limit::kControl, survey.current_per_metre);
  take(Limit::kSingular, survey.singular);
}

double RatioOf(Limit limit, double found, double allowed) {
  constexpr double kWorst = 20.0;
  if (!IsFloor(limit)) return std::min(found / allowed, kWorst);
  // From the limit down to nothing a straight line, so that a search sees where to go.
  return found > allowed ? allowed / found : std::min(2.0 - found / allowed, kWorst);
}

}  // namespace

PidLimits UsualLimits(const config::RigFile& rig, double current_limit_a) {
  PidLimits out;
  out[Limit::kSensitivity] = 3.0;
  out[Limit::kCornerSensitivity] = 4.0;
  out[Limit::kComplementary] = 3.0;
  out[Limit::kSingular] = 4.0;
  out[Limit::kDamping] = 0.0015;
  const auto& numbers = rig.numbers;
  if (numbers.standing_orbit_objective_m > 0.0)
    out[Limit::kStanding] = numbers.standing_orbit_objective_m;
  if (numbers.spinning_orbit_objective_m > 0.0)
    out[Limit::kSpinning] = numbers.spinning_orbit_objective_m;
  out[Limit::kCurrent] = current_limit_a;
  out[Limit::kNoise] = 0.25 * current_limit_a;
  return out;
}

PidJudge::PidJudge(const config::RigFile& rig, const PidLimits& limits, double third_n)
    : limits_(limits), unbalance_(rig, third_n) {
  for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis)
    noise_m_.push_back(rig.plant.bearings.at(axis / 2).sensor.noise_rms_m);
}

PidFigures PidJudge::Of(const law::LawConfig& law, const std::vector<PlantToHold>& plants) const {
  constexpr double kDeviations = 3.0;
  std::vector<law::DiscreteLaw> laws;
  for (const auto& axis : law.axes) laws.push_back(law::Discretise(axis, law.period_s));
  PidFigures out;
  out[Limit::kDamping].found = 1.0;
  out[Limit::kStiffness].found = 1e12;
  double static_a = 0.0;
  double motion_m = 0.0;
  for (const auto& [plant, nominal] : plants) {
    const LoopSurvey survey = Survey(*plant, laws, noise_m_);
    const double speed = plant->speed_rad_per_s();
    out.growing += std::max(survey.growing, 0);
    if (survey.damping.value < out[Limit::kDamping].found)
      out[Limit::kDamping] = {survey.damping.value, 0.0, survey.damping.hz, speed};
    if (!nominal) {
      TakeMost(out[Limit::kCornerSensitivity], survey.sensitivity.value, survey.sensitivity.hz,
               speed);
      continue;
    }
    TakePeaks(survey, speed, out);
    for (std::size_t i = 0; i < laws.size(); ++i) {
      static_a = std::max(static_a, std::abs(plant->static_a().at(i)));
      motion_m = std::max(motion_m, survey.position_m[i]);
      TakeMost(out[Limit::kNoise], survey.current_a[i], 0.0, speed);
      const double stiffness =
          plant->current_n_per_a()[i] * law.axes[i].kp_a_per_m - plant->displacement_n_per_m()[i];
      if (stiffness < out[Limit::kStiffness].found)
        out[Limit::kStiffness] = {stiffness, 0.0, 0.0, speed};
    }
  }
  const UnbalanceFigures spinning = unbalance_.Of(laws);
  out[Limit::kStanding].found = kDeviations * motion_m;
  out[Limit::kSpinning] = {spinning.orbit_m + kDeviations * motion_m, 0.0, 0.0,
                           spinning.orbit_rad_per_s};
  out[Limit::kCurrent] = {static_a + spinning.current_a + kDeviations * out[Limit::kNoise].found,
                          0.0, 0.0, spinning.current_rad_per_s};
  for (std::size_t i = 0; i < kLimits; ++i)
    if (limits_.at[i])
      out.met[i].ratio = RatioOf(static_cast<Limit>(i), out.met[i].found, *limits_.at[i]);
  return out;
}

Limit Limiting(const PidFigures& figures) {
  const auto most = std::max_element(figures.met.begin(), figures.met.end(),
                                     [](const Met& a, const Met& b) { return a.ratio < b.ratio; });
  return static_cast<Limit>(most - figures.met.begin());
}

std::string NameOf(Limit limit) {
  constexpr std::array<const char*, kLimits> kNames{"|S| of an axis",
                                                    "|S| at the corners",
                                                    "|T| of an axis",
                                                    "|K S| of an axis",
                                                    "largest singular value of S",
                                                    "least damping of a mode",
                                                    "orbit standing",
                                                    "orbit spinning",
                                                    "current",
                                                    "current of noise, rms",
                                                    "static stiffness"};
  return kNames[static_cast<std::size_t>(limit)];
}

std::string ValueText(Limit limit, double value) {
  switch (limit) {
    case Limit::kControl:
      return fmt::format("{:.0f} A/m", value);
    case Limit::kDamping:
      if (value >= 1.0) return "over 30 %";  // no pole near the axis
      return fmt::format("{:.3f} %", 100.0 * value);
    case Limit::kStanding:
    case Limit::kSpinning:
      return fmt::format("{:.1f} um", 1e6 * value);
    case Limit::kCurrent:
    case Limit::kNoise:
      return fmt::format("{:.3f} A", value);
    case Limit::kStiffness:
      return fmt::format("{:.4g} N/m", value);
    default:
      return fmt::format("{:.2f}", value);
  }
}

std::string MetText(Limit limit, const Met& met, double allowed) {
  return fmt::format("{} {} (limit {}){}, {:.0f} rpm", NameOf(limit), ValueText(limit, met.found),
                     ValueText(limit, allowed),
                     met.hz > 0.0 ? fmt::format(" at {:.1f} Hz", met.hz) : "",
                     RadPerSToRpm(met.speed_rad_per_s));
}

}  // namespace levitas::design
