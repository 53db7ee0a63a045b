// Timing and amplifiers: when and how the coil current follows its command.
//
// Delay      the command that would act from the sample on acts `theta` periods later (or the next
//            one earlier): closed form of the first-order current loop.
// Bandwidth  decay exp(-W T (1 + theta)) instead of exp(-W T).
// Slew       a second coil that cannot move faster; its difference acts as a current.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/terms/terms.hpp"
#include "plant_sim/amplifier/amplifier.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

struct Loop {
  double rate_per_s;  ///< 2 pi bandwidth
  double period_s;

  [[nodiscard]] double Decay(double share = 1.0) const {
    return std::exp(-rate_per_s * period_s * share);
  }
  /// Mean over the period of exp(-rate t).
  [[nodiscard]] double Mean() const { return (1.0 - Decay()) / (rate_per_s * period_s); }
};

Loop LoopOf(const RigView& rig, std::size_t axis) {
  return {2.0 * std::numbers::pi * rig.bearing(axis).amplifier.bandwidth_hz, rig.period_s};
}

/// A command that acts `late` periods later or `early` ones before, as shares of its step.
struct Shifted {
  double late_end{}, late_mean{}, early_end{}, early_mean{};
};

Shifted Shift(const Loop& loop, double theta) {
  const double late = std::clamp(theta, 0.0, 1.0);
  const double early = std::clamp(-theta, 0.0, 1.0);
  const double wt = loop.rate_per_s * loop.period_s;
  const double rise = 1.0 - std::exp(-wt * late);
  const double rise_early = 1.0 - std::exp(-wt * early);
  Shifted s;
  // Late: for `late` periods the old command still acts. Early: the next one begins before.
  s.late_end = rise * std::exp(-wt * (1.0 - late));
  s.late_mean = late - rise / wt + rise * (1.0 - std::exp(-wt * (1.0 - late))) / wt;
  s.early_end = rise_early;
  s.early_mean = early - rise_early / wt;
  return s;
}

Term Delay(const RigView& rig, double tolerance) {
  Term term =
      MakeTerm({Id::kExtraDelay, Everywhere("all axes"), "samples", "1"}, tolerance, 0.5, nullptr);
  std::vector<Loop> loops;
  loops.reserve(rig.axes);
  for (std::size_t a = 0; a < rig.axes; ++a) loops.push_back(LoopOf(rig, a));
  term.drive = [loops, of = 0.0, shifted = std::vector<Shifted>(rig.axes)](
                   const SamplePoint& m, double theta, Contribution& add) mutable {
    if (theta != of) {
      of = theta;
      for (std::size_t a = 0; a < loops.size(); ++a) shifted[a] = Shift(loops[a], theta);
    }
    for (std::size_t a = 0; a < loops.size(); ++a) {
      const double late_a = static_cast<double>(m.command_before_a[a] - m.command_now_a[a]);
      const double early_a = static_cast<double>(m.command_next_a[a] - m.command_now_a[a]);
      add.coil_end_a[a] += late_a * shifted[a].late_end + early_a * shifted[a].early_end;
      add.coil_mean_a[a] += late_a * shifted[a].late_mean + early_a * shifted[a].early_mean;
    }
  };
  term.linear = false;
  term.moves_coil = true;
  term.step = 0.05;
  term.change = [](double theta, LinearChange& change) { change.late_periods += theta; };
  return term;
}

Term Bandwidth(const RigView& rig, std::size_t a, double tolerance) {
  Term term = MakeTerm({Id::kAmplifierBandwidth, AtAxis(rig.numbers, a), "ratio", "1"}, tolerance,
                       0.3, nullptr);
  term.linear = false;
  term.moves_coil = true;
  term.step = 0.02;
  term.drive = [loop = LoopOf(rig, a), a, of = 0.0, end = 0.0, mean = 0.0](
                   const SamplePoint& m, double theta, Contribution& add) mutable {
    if (theta != of) {
      of = theta;
      const Loop other{loop.rate_per_s * std::max(0.05, 1.0 + theta), loop.period_s};
      end = other.Decay() - loop.Decay();
      mean = other.Mean() - loop.Mean();
    }
    const double away = static_cast<double>(m.coil_start_a[a] - m.command_now_a[a]);
    add.coil_end_a[a] += away * end;
    add.coil_mean_a[a] += away * mean;
  };
  term.change = [a](double theta, LinearChange& change) {
    change.axis[a].coil_rate *= std::max(0.05, 1.0 + theta);
  };
  return term;
}

/// Current of an amplifier that cannot move faster, with the bandwidth and the delay that the
/// calibration has found: a rectifier of noisy commands, whose mean they move.
class SlewingCoil {
 public:
  SlewingCoil(double bandwidth_hz, double slew_a_per_s, double period_s)
      : bandwidth_hz_(bandwidth_hz), slew_a_per_s_(slew_a_per_s), period_s_(period_s) {}

  /// Mean over the period [A].
  double Advance(const SamplePoint& m, std::size_t a) {
    const double late = std::clamp(static_cast<double>(m.late_periods), -1.0, 1.0);
    const double hz = bandwidth_hz_ * static_cast<double>(m.coil_rate[a]);
    if (late >= 0.0) {
      return Follow(hz, late, static_cast<double>(m.command_before_a[a])) +
             Follow(hz, 1.0 - late, static_cast<double>(m.command_now_a[a]));
    }
    return Follow(hz, 1.0 + late, static_cast<double>(m.command_now_a[a])) +
           Follow(hz, -late, static_cast<double>(m.command_next_a[a]));
  }

 private:
  /// Share of the mean that a share of the period makes.
  double Follow(double bandwidth_hz, double share, double command_a) {
    if (share <= 0.0) return 0.0;
    constexpr int kHalves = 4;  // Simpson's rule over two pairs
    constexpr std::array kWeights{1.0, 4.0, 2.0, 4.0, 1.0};
    const auto step = amplifier::MakeStep(bandwidth_hz, slew_a_per_s_, share * period_s_ / kHalves);
    double sum = kWeights[0] * now_a_;
    for (std::size_t k = 1; k <= kHalves; ++k) {
      now_a_ = amplifier::FollowSlewing(step, now_a_, command_a);
      sum += kWeights[k] * now_a_;
    }
    return share * sum / (3.0 * kHalves);
  }

  double bandwidth_hz_, slew_a_per_s_, period_s_;
  double now_a_{0.0};
};

Term Slew(const RigView& rig, double slew_a_per_s) {
  Term term = MakeTerm(
      {Id::kAmplifierSlew, Everywhere(fmt::format("{:.0f} A/s", slew_a_per_s)), "share", "1"}, 0.0,
      0.7, nullptr);
  term.positive = true;
  term.family = {
      {slew_a_per_s}, {0.4}, [&rig](const Family::Shape& other) { return Slew(rig, other[0]); }};
  std::vector<SlewingCoil> coils;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    coils.emplace_back(rig.bearing(a).amplifier.bandwidth_hz, slew_a_per_s, rig.period_s);
  }
  term.drive = [&rig, coils](const SamplePoint& m, double theta, Contribution& add) mutable {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const double beside_a = coils[a].Advance(m, a) - static_cast<double>(m.coil_mean_a[a]);
      add.force_n[a] += theta * ForceOfCurrent(rig, m, a, beside_a);
    }
  };
  term.timed = true;
  // The slew-limited coil replaces the linear one by the share theta: its slope falls by theta.
  term.slope = [&rig](const SamplePoint& m, double theta, AddedSlopes& added) {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      added.force_per_a[a] -= static_cast<float>(theta) * m.force_per_a[a];
    }
  };
  return term;
}

}  // namespace

std::vector<Term> TimingTerms(const RigView& rig, const Tolerances& tolerances) {
  std::vector<Term> terms{Delay(rig, tolerances.delay_samples)};
  for (std::size_t a = 0; a < rig.axes; ++a) {
    terms.push_back(Bandwidth(rig, a, tolerances.amplifier_bandwidth));
  }
  for (const double slew : {500.0, 1500.0, 4000.0}) terms.push_back(Slew(rig, slew));
  return terms;
}

}  // namespace levitas::diagnosis
