// Perturbations of the magnets: gains, asymmetry, saturation, rotation of the axes. Equations:
// docs/effects.md.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/terms/terms.hpp"
#include "plant_sim/effect/coil.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

/// Opposed coils of a healthy magnet: a few micrometres of gap, a turn more or less.
constexpr double kAlike = 0.02;

double ForceWithoutControl(const magnet::Magnet& magnet, double bias_a, const SamplePoint& m,
                           std::size_t a) {
  return magnet::Force(magnet, bias_a, 0.0, static_cast<double>(m.actuator_m[a]));
}

/// How iron saturates: i/(1 + (i/knee)^exponent)^(1/exponent).
struct Iron {
  double knee_a{}, exponent{};

  /// Coil current that makes the same flux without saturation.
  [[nodiscard]] double Saturated(double coil_a) const {
    const double ratio = std::max(0.0, coil_a) / knee_a;
    return coil_a / std::pow(1.0 + std::pow(ratio, exponent), 1.0 / exponent);
  }
};

/// Force of an axis whose iron saturates.
double SaturatedForce(const magnet::Magnet& magnet, double bias_a, double control_a, double x_m,
                      const Iron& iron) {
  const double towards = iron.Saturated(bias_a + control_a) / (magnet.gap_m - x_m);
  const double away = iron.Saturated(bias_a - control_a) / (magnet.gap_m + x_m);
  return magnet.force_constant_n_m2_per_a2 * (towards * towards - away * away);
}

/// One member of a family of knees and exponents; theta = 1 is the whole law. Where the control
/// current is small beside the bias only its slopes show, and their ratio depends on the exponent.
Term Saturation(const RigView& rig, double knee_share, double exponent) {
  Term term =
      MakeTerm({Id::kMagneticSaturation,
                Everywhere(fmt::format("knee {:.3f} i0, exponent {:.2f}", knee_share, exponent)),
                "share", "1"},
               0.0, 0.7,
               [&rig, knee_share, exponent](const SamplePoint& m, double theta, Contribution& add) {
                 for (std::size_t a = 0; a < rig.axes; ++a) {
                   const double bias = rig.bias_a(a);
                   const double force = SaturatedForce(
                       rig.magnet(a).magnet, bias, static_cast<double>(m.coil_mean_a[a]),
                       static_cast<double>(m.actuator_m[a]), {knee_share * bias, exponent});
                   add.force_n[a] += theta * (force - static_cast<double>(m.force_n[a]));
                 }
               });
  term.positive = true;
  const Family::Shape shape{knee_share, exponent};
  term.family = {shape, {0.12, 0.25}, [&rig](const Family::Shape& other) {
                   return Saturation(rig, other[0], other[1]);
                 }};
  term.slope = [&rig, knee_share, exponent](const SamplePoint& m, double theta,
                                            AddedSlopes& added) {
    constexpr double kStepA = 1e-4;
    constexpr double kStepM = 1e-8;
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const double bias = rig.bias_a(a);
      const auto force = [&](double control_a, double x_m) {
        return SaturatedForce(rig.magnet(a).magnet, bias, control_a, x_m,
                              {knee_share * bias, exponent});
      };
      const double i = static_cast<double>(m.coil_mean_a[a]);
      const double x = static_cast<double>(m.actuator_m[a]);
      const double per_a = (force(i + kStepA, x) - force(i, x)) / kStepA;
      const double per_m = (force(i, x + kStepM) - force(i, x)) / kStepM;
      const auto share = static_cast<float>(theta);
      added.force_per_a[a] += share * (static_cast<float>(per_a) - m.force_per_a[a]);
      added.force_per_m[a] += share * (static_cast<float>(per_m) - m.force_per_m[a]);
    }
  };
  return term;
}

/// Terms of one axis: its current, its displacement, and the force law of its two coils.
void AddAxisTerms(const RigView& rig, const Tolerances& tolerances, std::size_t a,
                  std::vector<Term>& terms) {
  const auto magnet = rig.magnet(a).magnet;
  const double bias_a = rig.bias_a(a);
  // The gain scales the current, not the force; with a static load current the two differ.
  Term gain = MakeTerm(
      {Id::kCurrentGain, AtAxis(rig.numbers, a), "ratio", "1"}, tolerances.current_gain, 0.15,
      [=](const SamplePoint& m, double theta, Contribution& add) {
        const double x = static_cast<double>(m.actuator_m[a]);
        const double i = static_cast<double>(m.coil_mean_a[a]);
        const effect::CoilPair acting = effect::Scaled({bias_a + i, bias_a - i}, 1.0 + theta);
        add.force_n[a] += magnet::ForceOfCoils(magnet, acting.towards, acting.away, x) -
                          magnet::Force(magnet, bias_a, i, x);
      });
  gain.linear = false;
  gain.step = 0.02;
  gain.slope = [a](const SamplePoint& m, double theta, AddedSlopes& added) {
    added.force_per_a[a] += static_cast<float>(theta) * m.force_per_a[a];
  };
  terms.push_back(std::move(gain));
  terms.push_back(MakeTerm({Id::kDisplacementStiffness, AtAxis(rig.numbers, a), "ratio", "1"},
                           tolerances.displacement_stiffness, 0.15,
                           [=](const SamplePoint& m, double theta, Contribution& add) {
                             add.force_n[a] += theta * ForceWithoutControl(magnet, bias_a, m, a);
                           }));
  terms.back().slope = [a](const SamplePoint& m, double theta, AddedSlopes& added) {
    added.force_per_m[a] += static_cast<float>(theta) * m.force_per_m[a];
  };
  // Healthy magnets are off by current_gain and displacement_stiffness, which hold this one.
  terms.push_back(MakeTerm({Id::kForceConstant, AtAxis(rig.numbers, a), "ratio", "1"}, 0.0, 0.15,
                           [a](const SamplePoint& m, double theta, Contribution& add) {
                             add.force_n[a] += theta * static_cast<double>(m.force_n[a]);
                           }));
  terms.back().slope = [a](const SamplePoint& m, double theta, AddedSlopes& added) {
    added.force_per_a[a] += static_cast<float>(theta) * m.force_per_a[a];
    added.force_per_m[a] += static_cast<float>(theta) * m.force_per_m[a];
  };
}

/// Terms of one axis that a healthy rig has hardly: the amplifier's zero, unequal coils.
void AddAsymmetries(const RigView& rig, std::size_t a, std::vector<Term>& terms) {
  const auto magnet = rig.magnet(a).magnet;
  const double bias_a = rig.bias_a(a);
  terms.push_back(MakeTerm({Id::kCommandOffset, AtAxis(rig.numbers, a), "offset_a", "A"}, 0.0, 0.15,
                           [&rig, a](const SamplePoint& m, double theta, Contribution& add) {
                             add.force_n[a] += ForceOfCurrent(rig, m, a, theta);
                           }));
  terms.back().linear = false;  // away from the centre: the two coils' gaps differ
  terms.back().step = 0.02;
  terms.push_back(MakeTerm({Id::kCoilAsymmetry, AtAxis(rig.numbers, a), "ratio", "1"}, kAlike, 0.1,
                           [=](const SamplePoint& m, double theta, Contribution& add) {
                             const double x = static_cast<double>(m.actuator_m[a]);
                             const double i = static_cast<double>(m.coil_mean_a[a]);
                             const double k = magnet.force_constant_n_m2_per_a2;
                             const double towards = (bias_a + i) / (magnet.gap_m - x);
                             const double away = (bias_a - i) / (magnet.gap_m + x);
                             add.force_n[a] += 0.5 * theta * k * (towards * towards + away * away);
                           }));
}

/// Terms of one bearing, whose two axes act on each other.
Term Rotation(const RigView& rig, std::size_t b) {
  return MakeTerm({Id::kAxisRotation, AtSide(rig.numbers, b, false), "angle_rad", "rad"}, 0.0, 0.05,
                  [b](const SamplePoint& m, double theta, Contribution& add) {
                    add.force_n[2 * b] -= theta * static_cast<double>(m.force_n[2 * b + 1]);
                    add.force_n[2 * b + 1] += theta * static_cast<double>(m.force_n[2 * b]);
                  });
}

Term Coupling(const RigView& rig, std::size_t b) {
  const double ki = magnet::ForcePerCurrent(rig.magnet(2 * b).magnet, rig.bias_a(2 * b));
  return MakeTerm({Id::kMagneticCoupling, AtBearing(rig.numbers, b), "ratio", "1"}, 0.0, 0.1,
                  [b, ki](const SamplePoint& m, double theta, Contribution& add) {
                    const auto share = theta * ki;
                    add.force_n[2 * b] += share * static_cast<double>(m.coil_mean_a[2 * b + 1]);
                    add.force_n[2 * b + 1] += share * static_cast<double>(m.coil_mean_a[2 * b]);
                  });
}

}  // namespace

double ForceOfCurrent(const RigView& rig, const SamplePoint& moment, std::size_t axis,
                      double beside_a) {
  const magnet::Magnet& magnet = rig.magnet(axis).magnet;
  const double bias_a = rig.bias_a(axis);
  const double coil_a = static_cast<double>(moment.coil_mean_a[axis]);
  const double x_m = static_cast<double>(moment.actuator_m[axis]);
  return magnet::Force(magnet, bias_a, coil_a + beside_a, x_m) -
         magnet::Force(magnet, bias_a, coil_a, x_m);
}

std::vector<Term> MagnetTerms(const RigView& rig, const Tolerances& tolerances) {
  std::vector<Term> terms;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    AddAxisTerms(rig, tolerances, a, terms);
    AddAsymmetries(rig, a, terms);
  }
  for (std::size_t b = 0; b < rig.axes / 2; ++b) terms.push_back(Rotation(rig, b));
  for (std::size_t b = 0; b < rig.axes / 2; ++b) terms.push_back(Coupling(rig, b));
  for (const double knee : {1.0, 1.3, 1.7, 2.2}) {
    for (const double exponent : {3.0, 4.0, 6.0}) terms.push_back(Saturation(rig, knee, exponent));
  }
  return terms;
}

}  // namespace levitas::diagnosis
