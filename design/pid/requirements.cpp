#include "design/pid/requirements.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "numerics/dense/spectrum.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/plant_model.hpp"

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
  take(Limit::kCompliance, survey.metre_per_newton);
}

double RatioOf(Limit limit, double found, double allowed) {
  constexpr double kWorst = 20.0;
  if (!IsFloor(limit)) return std::min(found / allowed, kWorst);
  // From the limit down to nothing a straight line, so that a search sees where to go.
  return found > allowed ? allowed / found : std::min(2.0 - found / allowed, kWorst);
}

/// Ratios of what is limited, and the margin.
void TakeRatios(const PidLimits& limits, PidFigures& out) {
  for (std::size_t i = 0; i < kLimits; ++i)
    if (limits.at[i])
      out.met[i].ratio = RatioOf(static_cast<Limit>(i), out.met[i].found, *limits.at[i]);
  for (const Limit limit : {Limit::kSensitivity, Limit::kComplementary, Limit::kSingular})
    out.margin = std::max(out.margin, out[limit].ratio);
  if (limits.stiffen_to_m_per_n > 0.0)
    out.margin = std::max(out.margin, out[Limit::kCompliance].found / limits.stiffen_to_m_per_n);
}

}  // namespace

PidLimits UsualLimits(const configuration::RigFile& rig, double current_limit_a) {
  PidLimits out;
  out[Limit::kSensitivity] = 3.0;
  out[Limit::kCornerSensitivity] = 4.0;
  out[Limit::kComplementary] = 3.0;
  out[Limit::kSingular] = 4.0;
  const auto& numbers = rig.numbers;
  if (numbers.standing_orbit_objective_m > 0.0)
    out[Limit::kStanding] = numbers.standing_orbit_objective_m;
  if (numbers.spinning_orbit_objective_m > 0.0)
    out[Limit::kSpinning] = numbers.spinning_orbit_objective_m;
  out[Limit::kCurrent] = current_limit_a;
  out[Limit::kNoise] = 0.25 * current_limit_a;
  const SampledPlant standing(rig, 0.0);
  constexpr double kLeast = 0.0015;
  constexpr double kOfOwn = 0.4;  // corners of the uncertainty have half of it
  out[Limit::kDamping] = std::min(kLeast, kOfOwn * standing.own_damping());
  if (standing.growing() == 0) {
    const double without = Survey(standing, std::vector<law::DiscreteLaw>(rig.numbers.axes()),
                                  std::vector<double>(rig.numbers.axes()))
                               .metre_per_newton.value;
    out[Limit::kCompliance] = 0.2 * without;
    out.stiffen_to_m_per_n = 0.02 * without;
  }
  return out;
}

PidJudge::PidJudge(const configuration::RigFile& rig, const PidLimits& limits, double third_n,
                   const Coordinates& coordinates)
    : limits_(limits), coordinates_(coordinates), unbalance_(rig, third_n, coordinates) {
  for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis)
    noise_m_.push_back(rig.plant.bearings.at(axis / 2).sensor.noise_rms_m);
  const plant::PlantModel model(rig.plant);
  if (!rig.plant.shafts.empty() || model.bearings().front().on_voltage()) return;
  const double period_s = rig.numbers.period_s();
  const double delay_s = (model.delay_samples() + 0.5) * period_s;
  const double mass_kg = model.parameters().modes.total_mass_kg;
  constexpr double kFirstHz = 20.0;
  constexpr double kNext = 1.04;
  for (double hz = kFirstHz; hz < 0.5 / period_s; hz *= kNext) {
    const double w = kTwoPi * hz;
    Unknown at{hz, std::polar(1.0, -w * period_s), {}};
    for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis) {
      const auto& bearing = rig.plant.bearings.at(axis / 2);
      const std::complex<double> lag =
          std::polar(1.0, -w * delay_s) /
          (std::complex<double>(1.0, hz / model.amplifier_bandwidth_hz(axis)) *
           std::complex<double>(1.0, hz / bearing.sensor.bandwidth_hz));
      const double ki = plant::SlopesAtCentre(model, axis / 2).current(0, 0);
      at.chain.push_back(ki * lag / (2.0 * mass_kg * w * w));
    }
    unknown_.push_back(std::move(at));
  }
}

Met PidJudge::AnyMode(const std::vector<law::DiscreteLaw>& laws) const {
  Met out;
  for (const Unknown& at : unknown_) {
    const AxisMatrix controller = ControllerAt(laws, at.q, coordinates_);
    for (std::size_t axis = 0; axis < laws.size(); ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      TakeMost(out, -(controller(i, i) * at.chain[axis]).imag(), at.hz, 0.0);
    }
  }
  return out;
}

double PidJudge::SoftestAxis(const law::LawConfig& law, const SampledPlant& plant) const {
  const auto n = static_cast<Eigen::Index>(law.axes.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    stiffness(i, i) = law.axes[static_cast<std::size_t>(i)].kp_a_per_m;
  if (!coordinates_.empty()) stiffness = coordinates_.drive * stiffness * coordinates_.measure;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    stiffness.row(i) *= plant.current_n_per_a()[axis];
    stiffness(i, i) -= plant.displacement_n_per_m()[axis];
  }
  if (coordinates_.empty()) return stiffness.diagonal().minCoeff();
  return numerics::EigenvaluesOf(stiffness).real().minCoeff();
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
    }
    const double stiffness = SoftestAxis(law, *plant);
    if (stiffness < out[Limit::kStiffness].found)
      out[Limit::kStiffness] = {stiffness, 0.0, 0.0, speed};
  }
  const UnbalanceFigures spinning = unbalance_.Of(laws);
  out[Limit::kStanding].found = kDeviations * motion_m;
  out[Limit::kSpinning] = {spinning.orbit_m + kDeviations * motion_m, 0.0, 0.0,
                           spinning.orbit_rad_per_s};
  out[Limit::kCurrent] = {static_a + spinning.current_a + kDeviations * out[Limit::kNoise].found,
                          0.0, 0.0, spinning.current_rad_per_s};
  out[Limit::kAnyMode] = AnyMode(laws);
  TakeRatios(limits_, out);
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
                                                    "static stiffness",
                                                    "compliance at a magnet",
                                                    "damping an unknown mode needs"};
  return kNames[static_cast<std::size_t>(limit)];
}

std::string ValueText(Limit limit, double value) {
  switch (limit) {
    case Limit::kControl:
      return fmt::format("{:.0f} A/m", value);
    case Limit::kCompliance:
      return fmt::format("{:.3f} um/N", 1e6 * value);
    case Limit::kAnyMode:
      return fmt::format("{:.3f} %", 100.0 * value);
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
