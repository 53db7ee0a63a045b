// Geared shafts: teeth, wheels, and what shafts of a healthy rig may be off by.
//
// Every change of the force F on the driven wheel pushes both shafts by -shape F. d: displacement
// of the teeth, the static load's included; phi: angle of engagement.
//   stiffness   k theta d               damping      c theta delta'
//   variation   k theta cos(n phi) d    crack        -k theta w(wheel) d
//   error       -(k + c d/dt) theta e^(j n phi)      run-out   (k + c d/dt) theta e^(j wheel)
//   coupling    (k + c d/dt) R theta n cos(i wheel), and on its shaft alone  theta e^(j i wheel)
//   backlash    the law with the gap minus that without; friction  theta |F n| sign(sliding) j n
#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>

#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/terms/harmonic.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

using Complex = std::complex<double>;

Complex Delta(const TeethMoment& t) {
  return {static_cast<double>(t.delta_x_m), static_cast<double>(t.delta_y_m)};
}
Complex Rate(const TeethMoment& t) {
  return {static_cast<double>(t.rate_x_m_per_s), static_cast<double>(t.rate_y_m_per_s)};
}

/// One pair of wheels, as its terms see it.
struct Teeth {
  const MeshView* mesh;
  std::size_t at;  ///< among the meshes
  double period_s;

  [[nodiscard]] double Phi(const SamplePoint& m) const {
    return mesh->engagement() * MidAngle(m, period_s);
  }
  [[nodiscard]] Complex Unloaded(const SamplePoint& m) const { return Delta(m.teeth[at]); }
  [[nodiscard]] Complex Velocity(const SamplePoint& m) const { return Rate(m.teeth[at]); }
  /// With what the static load presses them together.
  [[nodiscard]] Complex Pressed(Complex delta, double half_gap_m) const {
    const double rest_m =
        mesh->preload_n > 0.0 ? mesh->preload_n / mesh->stiffness_n_per_m + half_gap_m : 0.0;
    return delta + rest_m * mesh->normal;
  }
  [[nodiscard]] Complex Loaded(const SamplePoint& m) const {
    return Pressed(Unloaded(m), mesh->half_backlash_m);
  }
  /// Force of teeth with a gap.
  [[nodiscard]] Complex Force(Complex delta, Complex rate, double half_gap_m) const {
    const Complex d = Pressed(delta, half_gap_m);
    const double reach_m = std::abs(d);
    if (half_gap_m > 0.0 && reach_m <= half_gap_m) return {};
    const double share = half_gap_m > 0.0 ? 1.0 - half_gap_m / reach_m : 1.0;
    const Complex force = mesh->stiffness_n_per_m * share * d + mesh->damping_n_s_per_m * rate;
    // Teeth with room to part do not pull, (G4).
    const bool pulls = half_gap_m > 0.0 && std::real(std::conj(d) * force) <= 0.0;
    return pulls ? Complex{} : force;
  }
  /// Mean over the period of a law of displacement, rate and angle of engagement that is not
  /// smooth: high harmonics of the error move the teeth by micrometres within a period.
  template <class Law>
  [[nodiscard]] Complex Mean(const SamplePoint& m, Law law) const {
    constexpr int kInstants = 16;  // teeth part, touch and let go within one period
    const double mid_rad = MidAngle(m, period_s);
    const auto speed = static_cast<double>(m.speed_rad_per_s);
    Complex imposed;
    Complex imposed_rate;
    mesh->Impose(mid_rad, speed, imposed, imposed_rate);
    const Complex moved = Unloaded(m) - imposed;
    const Complex moved_rate = Velocity(m) - imposed_rate;
    Complex sum;
    for (int k = 0; k < kInstants; ++k) {
      const double late_s = ((k + 0.5) / kInstants - 0.5) * period_s;
      const double angle = mid_rad + speed * late_s;
      mesh->Impose(angle, speed, imposed, imposed_rate);
      sum += law(moved + moved_rate * late_s + imposed, moved_rate + imposed_rate,
                 mesh->engagement() * angle);
    }
    return sum / static_cast<double>(kInstants);
  }
  void Push(Complex force, Contribution& add) const {
    const std::size_t modes = mesh->shape.size();
    for (std::size_t i = 0; i < modes; ++i) {
      add.Modal(i, -mesh->shape[i] * force.real());
      add.Modal(modes + i, -mesh->shape[i] * force.imag());
    }
  }
  /// Force of a prescribed displacement e^(j order angle) of the teeth, `by` its amplitude.
  void Displace(const SamplePoint& m, Complex by, double order, Contribution& add) const {
    const Complex line = by * std::polar(1.0, order * MidAngle(m, period_s));
    const Complex rate = Complex(0.0, order * static_cast<double>(m.speed_rad_per_s)) * line;
    Push(mesh->stiffness_n_per_m * mesh->Seen(line) + mesh->damping_n_s_per_m * mesh->Seen(rate),
         add);
  }
};

Complex Part(int part) { return part == 0 ? Complex(1.0, 0.0) : Complex(0.0, 1.0); }

void AddStiffness(const Teeth& t, const Tolerances& tolerances, std::vector<Term>& terms) {
  const std::string& name = t.mesh->name;
  terms.push_back(MakeTerm({Id::kMeshStiffness, AtGear(name, t.at), "stiffness", "ratio"},
                           tolerances.mesh_stiffness, 0.2,
                           [t](const SamplePoint& m, double theta, Contribution& add) {
                             t.Push(theta * t.mesh->stiffness_n_per_m * t.Unloaded(m), add);
                           }));
  terms.back().change = [at = t.at](double theta, LinearChange& change) {
    change.mesh[at].stiffness *= 1.0 + theta;
  };
  terms.push_back(MakeTerm({Id::kMeshStiffness, AtGear(name, t.at), "damping", "ratio"},
                           tolerances.mesh_damping, 0.3,
                           [t](const SamplePoint& m, double theta, Contribution& add) {
                             t.Push(theta * t.mesh->damping_n_s_per_m * t.Velocity(m), add);
                           }));
  terms.back().change = [at = t.at](double theta, LinearChange& change) {
    change.mesh[at].damping *= 1.0 + theta;
  };
}

void AddVariation(const Teeth& t, std::vector<Term>& terms) {
  constexpr int kHighest = 3;
  for (int order = 1; order <= kHighest; ++order) {
    for (int part = 0; part < 2; ++part) {
      terms.push_back(
          MakeTerm({Id::kMeshStiffnessVariation, AtGearOrder(t.mesh->name, t.at, order),
                    PartName(part), "1"},
                   0.0, 0.1, [=](const SamplePoint& m, double theta, Contribution& add) {
                     const double phi = order * t.Phi(m);
                     const double factor = part == 0 ? std::cos(phi) : -std::sin(phi);
                     t.Push(theta * t.mesh->stiffness_n_per_m * factor * t.Loaded(m), add);
                   }));
    }
  }
}

/// The orders of the rig file and one more to either side.
void AddError(const Teeth& t, const Tolerances& tolerances, std::vector<Term>& terms) {
  int highest = 0;
  for (const gear::Harmonic& h : t.mesh->error) highest = std::max(highest, std::abs(h.order));
  for (int order = -highest - 1; order <= highest + 1; ++order) {
    for (int part = 0; part < 2; ++part) {
      terms.push_back(MakeTerm(
          {Id::kTransmissionError, AtGearOrder(t.mesh->name, t.at, order), PartName(part), "m"},
          tolerances.transmission_error_m, 5e-6,
          [=](const SamplePoint& m, double theta, Contribution& add) {
            t.Displace(m, -theta * Part(part), order * t.mesh->engagement(), add);
          }));
    }
  }
}

void AddRunout(const Teeth& t, const Tolerances& tolerances, bool driven,
               std::vector<Term>& terms) {
  const WheelView& wheel = driven ? t.mesh->driven : t.mesh->driving;
  for (int part = 0; part < 2; ++part) {
    terms.push_back(
        MakeTerm({Id::kGearRunout, AtWheel(t.mesh->name, t.at, driven), PartName(part), "m"},
                 tolerances.gear_runout_m, 10e-6,
                 [=, w = &wheel](const SamplePoint& m, double theta, Contribution& add) {
                   const Complex by = theta * Part(part);
                   t.Displace(m, driven ? -by : by, w->ratio, add);
                   const double speed = w->ratio * static_cast<double>(m.speed_rad_per_s);
                   const Complex heading = std::polar(1.0, w->ratio * MidAngle(m, t.period_s));
                   const Complex force = w->eccentric_mass_kg * speed * speed * by * heading;
                   const std::size_t modes = w->shape.size();
                   for (std::size_t i = 0; i < modes; ++i) {
                     add.Modal(i, w->shape[i] * force.real());
                     add.Modal(modes + i, w->shape[i] * force.imag());
                   }
                 }));
  }
}

Location CouplingPlace(const Teeth& t, bool driven, const char* what, int order) {
  Location at = AtWheel(t.mesh->name, t.at, driven).Named(fmt::format("{}, order {}", what, order));
  at.order = order;
  return at;
}

/// A misaligned coupling of the wheel's shaft pushes at twice the shaft's turns, forward or
/// backward, (G17).
void AddCouplingForce(const Teeth& t, bool driven, std::vector<Term>& terms) {
  const WheelView& wheel = driven ? t.mesh->driven : t.mesh->driving;
  for (const int order : {2, -2}) {
    Location at = CouplingPlace(t, driven, "force", order);
    at.z_m = wheel.z_m;
    for (int part = 0; part < 2; ++part) {
      terms.push_back(MakeTerm({Id::kMisalignment, at, PartName(part), "N"}, 0.0, 2.0,
                               [=, w = &wheel, period_s = t.period_s](
                                   const SamplePoint& m, double theta, Contribution& add) {
                                 const Complex force =
                                     theta * Part(part) *
                                     std::polar(1.0, order * w->ratio * MidAngle(m, period_s));
                                 const std::size_t modes = w->shape.size();
                                 for (std::size_t i = 0; i < modes; ++i) {
                                   add.Modal(i, w->shape[i] * force.real());
                                   add.Modal(modes + i, w->shape[i] * force.imag());
                                 }
                               }));
    }
  }
}

/// A misaligned coupling turns the wheel unevenly once or twice a turn, (G18).
void AddCouplingRotation(const Teeth& t, bool driven, std::vector<Term>& terms) {
  const WheelView& wheel = driven ? t.mesh->driven : t.mesh->driving;
  if (wheel.base_radius_m == 0.0) return;
  for (const int order : {1, 2}) {
    for (int part = 0; part < 2; ++part) {
      terms.push_back(MakeTerm(
          {Id::kMisalignment, CouplingPlace(t, driven, "rotation", order), PartName(part), "rad"},
          0.0, 2e-4, [=, w = &wheel](const SamplePoint& m, double theta, Contribution& add) {
            const double turns = order * w->ratio;
            const Complex line = theta * w->base_radius_m * Part(part) *
                                 std::polar(1.0, turns * MidAngle(m, t.period_s));
            const double rate = -turns * static_cast<double>(m.speed_rad_per_s) * line.imag();
            t.Push((t.mesh->stiffness_n_per_m * line.real() + t.mesh->damping_n_s_per_m * rate) *
                       t.mesh->normal,
                   add);
          }));
    }
  }
}

void AddCoupling(const Teeth& t, bool driven, std::vector<Term>& terms) {
  AddCouplingForce(t, driven, terms);
  AddCouplingRotation(t, driven, terms);
}

/// How much of a tooth's stiffness counts: one pitch to either side of it, as neighbours share.
double Carries(double wheel_rad, int tooth, int teeth) {
  const double pitch = wheel_rad * teeth / (2.0 * std::numbers::pi) - tooth;
  const double away = std::remainder(pitch, static_cast<double>(teeth));
  return std::abs(away) < 1.0 ? std::pow(std::cos(0.5 * std::numbers::pi * away), 2) : 0.0;
}

void AddCracks(const Teeth& t, bool driven, std::vector<Term>& terms) {
  const WheelView& wheel = driven ? t.mesh->driven : t.mesh->driving;
  for (int tooth = 0; tooth < wheel.teeth; ++tooth) {
    terms.push_back(MakeTerm(
        {Id::kToothCrack, AtTooth(t.mesh->name, t.at, driven, static_cast<std::size_t>(tooth)),
         "depth", "1"},
        0.0, 0.3,
        [=, turn = std::abs(wheel.ratio), teeth = wheel.teeth](const SamplePoint& m, double theta,
                                                               Contribution& add) {
          const double carries = Carries(turn * MidAngle(m, t.period_s), tooth, teeth);
          if (carries == 0.0) return;
          t.Push(-theta * carries * t.mesh->stiffness_n_per_m * t.Loaded(m), add);
        }));
    terms.back().positive = true;
    terms.back().rotating = true;
  }
}

/// Of the sliding velocity: an odd function between two pitch points, which turns round at each
/// within this share of half an engagement.
double Sliding(double phi) {
  constexpr double kAtPitchPoint = 0.02;
  const double place = std::remainder(phi, 2.0 * std::numbers::pi) / std::numbers::pi;
  return place / std::hypot(place, kAtPitchPoint);
}

Term Friction(const Teeth& t) {
  Term term =
      MakeTerm({Id::kMeshFriction, AtGear(t.mesh->name, t.at), "coefficient", "1"}, 0.0, 0.1,
               [t](const SamplePoint& m, double theta, Contribution& add) {
                 const Complex n = t.mesh->normal;
                 const double own = t.mesh->half_backlash_m;
                 t.Push(t.Mean(m,
                               [&](Complex delta, Complex rate, double phi) {
                                 const Complex force = t.Force(delta, rate, own);
                                 const double normal = std::abs(std::real(force * std::conj(n)));
                                 return theta * normal * Sliding(phi) * Complex(0.0, 1.0) * n;
                               }),
                        add);
               });
  term.positive = true;
  return term;
}

Term Backlash(const Teeth& t) {
  Term term =
      MakeTerm({Id::kBacklash, AtGear(t.mesh->name, t.at), "gap_m", "m"}, 0.0, 20e-6,
               [t](const SamplePoint& m, double theta, Contribution& add) {
                 const double own = t.mesh->half_backlash_m;
                 const double wider = own + 0.5 * std::max(0.0, theta);
                 t.Push(t.Mean(m,
                               [&](Complex delta, Complex rate, double) {
                                 return t.Force(delta, rate, wider) - t.Force(delta, rate, own);
                               }),
                        add);
               });
  term.positive = true;
  term.linear = false;
  term.step = 1e-6;
  return term;
}

/// Stiffness of the shafts as frequencies of their modes, damping of their supports.
void AddShafts(const RigView& rig, const Tolerances& tolerances, std::vector<Term>& terms) {
  const std::size_t modes = rig.modes;
  for (std::size_t i = 0; i < modes; ++i) {
    const double w2 = rig.omega_rad_per_s[i] * rig.omega_rad_per_s[i];
    terms.push_back(MakeTerm(
        {std::nullopt, Everywhere(fmt::format("shaft mode {}", i + 1)), "stiffness", "ratio"},
        tolerances.shaft_stiffness, 0.0,
        [=](const SamplePoint& m, double theta, Contribution& add) {
          add.Modal(i, -theta * w2 * static_cast<double>(m.q[i]));
          add.Modal(modes + i, -theta * w2 * static_cast<double>(m.q[modes + i]));
        }));
    terms.back().change = [i](double theta, LinearChange& change) {
      change.mode[i].frequency *= std::sqrt(1.0 + theta);
    };
  }
  for (std::size_t s = 0; s < rig.model->train().supports.size(); ++s) {
    const plant::SupportModel& support = rig.model->train().supports[s];
    terms.push_back(MakeTerm(
        {std::nullopt, Everywhere(fmt::format("shaft support {}", s + 1)), "damping", "ratio"},
        tolerances.shaft_damping, 0.0, [=](const SamplePoint& m, double theta, Contribution& add) {
          double x = 0.0;
          double y = 0.0;
          for (std::size_t i = 0; i < modes; ++i) {
            x += support.shape[i] * static_cast<double>(m.v[i]);
            y += support.shape[i] * static_cast<double>(m.v[modes + i]);
          }
          x *= theta * support.damping_x_n_s_per_m;
          y *= theta * support.damping_y_n_s_per_m;
          for (std::size_t i = 0; i < modes; ++i) {
            add.Modal(i, -support.shape[i] * x);
            add.Modal(modes + i, -support.shape[i] * y);
          }
        }));
  }
}

}  // namespace

std::vector<Term> GearTerms(const RigView& rig, const Tolerances& tolerances) {
  std::vector<Term> terms;
  if (!rig.geared()) return terms;
  AddShafts(rig, tolerances, terms);
  for (std::size_t i = 0; i < rig.meshes.size(); ++i) {
    const Teeth teeth{&rig.meshes[i], i, rig.period_s};
    AddStiffness(teeth, tolerances, terms);
    AddVariation(teeth, terms);
    AddError(teeth, tolerances, terms);
    for (const bool driven : {false, true}) {
      AddRunout(teeth, tolerances, driven, terms);
      AddCoupling(teeth, driven, terms);
      AddCracks(teeth, driven, terms);
    }
    terms.push_back(Friction(teeth));
    terms.push_back(Backlash(teeth));
  }
  return terms;
}

}  // namespace levitas::diagnosis
