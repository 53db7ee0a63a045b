// Magnets with memory: eddy currents and hysteresis.
//
// Eddy       F = (ki ic + ks x)/(1 + sqrt(s tau)): ic + (ks/ki) x drives the lag, or ic alone in a
//            second form. The half-order lag as a sum of first-order ones: its jump
//            across the negative real axis gives 1/(1 + sqrt s) = int w(x) x/(s + x) dln x,
//            w = sqrt(x)/(pi (1 + x)) (spectral representation of Cole-Cole relaxation), sampled
//            at half decades.
// Hysteresis F = ki (ic - share w z), dz/dic = (1 - z sign dic)/(2 w): Dahl (1968), exponential
//            approach, w = width.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr std::size_t kSections = 15;  ///< x from 10^-3 to 10^4, half decades

/// The half-order lag of one axis, advanced period by period.
class HalfOrderLag {
 public:
  void Tune(double root_tau, double period_s) {
    if (root_tau == root_tau_) return;
    root_tau_ = root_tau;
    const double tau = root_tau * root_tau;
    double sum = 0.0;
    for (std::size_t k = 0; k < kSections; ++k) {
      const double x = std::pow(10.0, -3.0 + 0.5 * static_cast<double>(k));
      weight_[k] = std::sqrt(x) / (1.0 + x);
      sum += weight_[k];
      decay_[k] = std::exp(-x * period_s / tau);
      mean_[k] = tau / (x * period_s) * (1.0 - decay_[k]);
    }
    for (double& weight : weight_) weight /= sum;
  }

  /// Mean of lagged minus unlagged input over a period, held at its middle value `mid_a`.
  double Step(double mid_a) {
    double lagging = 0.0;
    for (std::size_t k = 0; k < kSections; ++k) {
      // Mean over the period of a section that relaxes from its state towards the input.
      lagging += weight_[k] * (mid_a + (state_[k] - mid_a) * mean_[k]);
      state_[k] = mid_a + (state_[k] - mid_a) * decay_[k];
    }
    return lagging - mid_a;
  }

 private:
  double root_tau_{-1.0};
  std::array<double, kSections> weight_{}, decay_{}, mean_{}, state_{};
};

/// [A/m] ks/ki: the control current that makes as much force as a displacement.
double CurrentPerDisplacement(const RigView& rig, std::size_t axis) {
  const magnet::Magnet& magnet = rig.magnet(axis).magnet;
  return magnet::NegativeStiffness(magnet, rig.bias_a(axis)) /
         magnet::ForcePerCurrent(magnet, rig.bias_a(axis));
}

Term Hysteresis(const RigView& rig, double width_share) {
  Term term = MakeTerm(
      {Id::kHysteresis, Everywhere(fmt::format("width {:.4g} i0", width_share)), "share", "1"}, 0.0,
      1.0, nullptr);
  term.positive = true;
  term.family = {{width_share}, {0.55}, [&rig](const Family::Shape& other) {
                   return Hysteresis(rig, other[0]);
                 }};
  term.drive = [&rig, width_share, stop = std::array<double, kMaxAxes>{},
                last = std::array<double, kMaxAxes>{}](const SamplePoint& m, double theta,
                                                       Contribution& add) mutable {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const double width_a = width_share * rig.bias_a(a);
      const double now_a = static_cast<double>(m.coil_end_a[a]);
      const double before = stop[a];
      const double change = now_a - last[a];
      const double side = change < 0.0 ? -1.0 : 1.0;
      stop[a] = side + (before - side) * std::exp(-0.5 * std::abs(change) / width_a);
      last[a] = now_a;
      add.force_n[a] -=
          theta * width_a * static_cast<double>(m.force_per_a[a]) * 0.5 * (before + stop[a]);
    }
  };
  return term;
}

/// `a_per_m`: current whose lag is that of a displacement; 0 where the current alone lags.
Term Eddy(const RigView& rig, std::size_t axis, double a_per_m) {
  Term eddy = MakeTerm({Id::kEddyCurrent, AtAxis(rig.numbers, axis), kRootTau, "s^0.5"}, 0.0, 5e-3,
                       nullptr);  // tau 25 us
  eddy.step = 3e-3;
  eddy.linear = false;
  eddy.positive = true;
  eddy.drive = [&rig, axis, a_per_m, period_s = rig.period_s, lag = HalfOrderLag()](
                   const SamplePoint& m, double theta, Contribution& add) mutable {
    if (theta <= 0.0) return;
    lag.Tune(theta, period_s);
    if (m.restarted) lag = HalfOrderLag(), lag.Tune(theta, period_s);
    const double behind_a = lag.Step(static_cast<double>(m.coil_mean_a[axis]) +
                                     a_per_m * static_cast<double>(m.actuator_m[axis]));
    add.force_n[axis] += ForceOfCurrent(rig, m, axis, behind_a);
  };
  return eddy;
}

}  // namespace

std::vector<Term> MagnetMemoryTerms(const RigView& rig) {
  std::vector<Term> terms;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    terms.push_back(Eddy(rig, a, CurrentPerDisplacement(rig, a)));
    terms.push_back(Eddy(rig, a, 0.0));
    terms.back().parameter = kRootTauOfCurrent;
    terms.back().form = "current alone";
  }
  for (const double width_share : {0.01, 0.03, 0.1}) terms.push_back(Hysteresis(rig, width_share));
  return terms;
}

}  // namespace levitas::diagnosis
