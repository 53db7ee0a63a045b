#pragma once
// What a model did in one period, made by hand: the shipped flexible rotor, and moments of it that
// are zero, or drawn.

#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/term.hpp"
#include "diagnosis/terms/terms.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::diagnosis {

inline const configuration::RigFile& FlexibleRotor() {
  static const configuration::RigFile kRig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return kRig;
}

inline const RigView& TheRig() {
  static const RigView kView(FlexibleRotor().numbers, FlexibleRotor().plant);
  return kView;
}

/// At rest in the centre, no current.
inline SamplePoint Rest() { return {}; }

/// Everything of the size it has on a levitated rotor; the magnet's force and its slopes are those
/// of the currents and displacements drawn.
inline SamplePoint Drawn(Random& random, double speed_rad_per_s) {
  const auto draw = [&random](double size) {
    return static_cast<float>(size * (2.0 * random.Uniform() - 1.0));
  };
  SamplePoint m;
  m.time_s = 10.0 * random.Uniform();
  m.Turn(6.28 * random.Uniform(), speed_rad_per_s, TheRig().period_s);
  for (std::size_t i = 0; i < 2 * kMaxModes; ++i) {
    m.q[i] = m.read_q[i] = draw(20e-6);
    m.v[i] = m.read_v[i] = draw(5e-3);
  }
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    m.coil_start_a[a] = draw(0.5);
    m.coil_end_a[a] = m.coil_start_a[a] + draw(0.1);
    m.coil_mean_a[a] = 0.5F * (m.coil_start_a[a] + m.coil_end_a[a]);
    m.command_before_a[a] = draw(0.5);
    m.command_now_a[a] = draw(0.5);
    m.command_next_a[a] = draw(0.5);
    m.actuator_m[a] = draw(40e-6);
    m.reading_m[a] = m.measured_m[a] = draw(40e-6);
    const magnet::Magnet& magnet = TheRig().magnet(a).magnet;
    const double mid_a = static_cast<double>(m.coil_mean_a[a]);
    const auto force = [&](double i, double x) {
      return magnet::Force(magnet, TheRig().bias_a(a), i, x);
    };
    const double x = static_cast<double>(m.actuator_m[a]);
    m.force_n[a] = static_cast<float>(force(mid_a, x));
    m.force_per_a[a] = static_cast<float>((force(mid_a + 1e-4, x) - force(mid_a - 1e-4, x)) / 2e-4);
    m.force_per_m[a] = static_cast<float>((force(mid_a, x + 1e-8) - force(mid_a, x - 1e-8)) / 2e-8);
  }
  return m;
}

inline std::vector<Term> EveryTerm() { return AllTerms(TheRig(), Tolerances{}, 50e-6); }

/// A copy, so that memory starts anew.
inline Term Named(const std::vector<Term>& terms, const std::string& effect,
                  const std::string& place, const std::string& parameter = "") {
  for (const Term& term : terms) {
    if (term.effect_name() == effect && term.location.name == place &&
        (parameter.empty() || term.parameter == parameter)) {
      return term;
    }
  }
  throw std::runtime_error("no term " + effect + " at " + place);
}

/// What the term adds over the period and at the sample together.
inline Contribution Added(Term& term, const SamplePoint& moment, double theta) {
  Contribution add;
  if (term.drive) term.drive(moment, theta, add);
  if (term.read) term.read(moment, theta, add);
  return add;
}

}  // namespace levitas::diagnosis
