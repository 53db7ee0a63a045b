// What turns with the shaft: unbalance, bow, run-out, misalignment, anisotropy.
// Every harmonic is given by its cosine and sine parts, which enter linearly.
#include <cmath>
#include <numbers>

#include "diagnosis/terms/harmonic.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

void AddUnbalance(const RigView& rig, const Tolerances& t, std::vector<Term>& terms) {
  for (const auto& mass : rig.model->config().unbalance) {
    const auto shape = rig.Shape(mass.z_m);
    for (int part = 0; part < 2; ++part) {
      terms.push_back(MakeTerm(
          {Id::kUnbalance, AtPlane(mass.z_m), PartName(part), "kg m"}, t.unbalance_kg_m, 20e-6,
          [=, modes = rig.modes](const SamplePoint& m, double theta, Contribution& add) {
            const double speed = static_cast<double>(m.speed_rad_per_s);
            if (speed == 0.0) return;
            // The sine part is a quarter turn ahead; a shaft that is turned faster leaves the mass
            // behind: theta (W^2 - j W') e^(j angle).
            const double outward = theta * speed * speed;
            const double behind = theta * static_cast<double>(m.acceleration_rad_per_s2);
            const double c = part == 0 ? m.cos_mid_angle : -m.sin_mid_angle;
            const double s = part == 0 ? m.sin_mid_angle : m.cos_mid_angle;
            const double cosine = outward * c + behind * s;
            const double sine = outward * s - behind * c;
            for (std::size_t i = 0; i < modes; ++i) {
              add.Modal(i, shape[i] * cosine);
              add.Modal(modes + i, shape[i] * sine);
            }
          }));
    }
  }
}

void AddRunout(const RigView& rig, const Tolerances& t, std::vector<Term>& terms) {
  for (int order = 1; order <= 3; ++order) {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      for (int part = 0; part < 2; ++part) {
        Term term =
            MakeTerm({Id::kSensorRunout, AtOrderOf(rig.numbers, order, a), PartName(part), "m"},
                     order == 1 ? t.sensor_runout_m : 0.0, 3e-6, nullptr);
        // It is on the shaft: the sensor's filter sees it, H = 1/(1 + j order W lag), and at rest
        // it stays as an offset.
        const double lag_s = SensorLag(rig, a);
        term.read = [=](const SamplePoint& m, double theta, Contribution& add) {
          const double late = order * lag_s * static_cast<double>(m.speed_rad_per_s);
          const double cosine = order == 1 ? m.cos_angle : std::cos(order * m.angle_rad);
          const double sine = order == 1 ? m.sin_angle : std::sin(order * m.angle_rad);
          const double seen = part == 0 ? cosine + late * sine : sine - late * cosine;
          add.reading_m[a] += theta * seen / (1.0 + late * late);
        };
        terms.push_back(std::move(term));
      }
    }
  }
}

void AddBow(const RigView& rig, std::vector<Term>& terms) {
  for (std::size_t mode = 2; mode < std::min<std::size_t>(rig.modes, 3); ++mode) {
    const double largest = rig.model->parameters()
                               .modes.shapes.col(static_cast<Eigen::Index>(mode))
                               .cwiseAbs()
                               .maxCoeff();
    const double size = std::pow(rig.omega_rad_per_s[mode], 2) / largest;
    for (int part = 0; part < 2; ++part) {
      terms.push_back(MakeTerm({Id::kShaftBow, AtMode(mode - 1), PartName(part), "m"}, 0.0, 20e-6,
                               [=, modes = rig.modes, period_s = rig.period_s](
                                   const SamplePoint& m, double theta, Contribution& add) {
                                 const double angle = MidAngle(m, period_s) + part * kQuarterTurn;
                                 add.Modal(mode, theta * size * std::cos(angle));
                                 add.Modal(modes + mode, theta * size * std::sin(angle));
                               }));
    }
  }
}

/// A force at the drive end that turns forward (positive order) or backward. It depends on the
/// shaft's angle only, so it acts at rest, too.
void AddMisalignment(const RigView& rig, std::vector<Term>& terms) {
  const auto shape = rig.Shape(0.0);
  for (const int order : {2, -2, 3, -3}) {
    for (int part = 0; part < 2; ++part) {
      terms.push_back(MakeTerm({Id::kMisalignment, AtOrder(order), PartName(part), "N"}, 0.0, 0.5,
                               [=, modes = rig.modes, period_s = rig.period_s](
                                   const SamplePoint& m, double theta, Contribution& add) {
                                 const double angle =
                                     order * MidAngle(m, period_s) + part * kQuarterTurn;
                                 const double x = theta * std::cos(angle);
                                 const double y = theta * std::sin(angle);
                                 for (std::size_t i = 0; i < modes; ++i) {
                                   add.Modal(i, shape[i] * x);
                                   add.Modal(modes + i, shape[i] * y);
                                 }
                               }));
    }
  }
}

/// Stiffness that turns with the shaft, as a share of every bending mode's.
void AddStiffness(const RigView& rig, std::vector<Term>& terms) {
  for (int part = 0; part < 2; ++part) {
    terms.push_back(MakeTerm(
        {Id::kShaftAnisotropy, Everywhere("rotor"), PartName(part), "1"}, 0.0, 0.1,
        [=, &rig, modes = rig.modes](const SamplePoint& m, double theta, Contribution& add) {
          const double angle = 2.0 * MidAngle(m, rig.period_s) + part * kQuarterTurn;
          const double c = theta * std::cos(angle);
          const double s = theta * std::sin(angle);
          for (std::size_t i = 2; i < modes; ++i) {
            const double w2 = rig.omega_rad_per_s[i] * rig.omega_rad_per_s[i];
            const double qx = static_cast<double>(m.q[i]);
            const double qy = static_cast<double>(m.q[modes + i]);
            add.Modal(i, -w2 * (c * qx + s * qy));
            add.Modal(modes + i, -w2 * (s * qx - c * qy));
          }
        }));
  }
}

}  // namespace

std::vector<Term> RotatingTerms(const RigView& rig, const Tolerances& t) {
  std::vector<Term> terms;
  if (rig.geared()) {
    AddRunout(rig, t, terms);
    return terms;
  }
  AddUnbalance(rig, t, terms);
  AddRunout(rig, t, terms);
  AddBow(rig, terms);
  AddMisalignment(rig, terms);
  AddStiffness(rig, terms);
  // Run-out, a bow, flats and a coupling's force are there at rest as well.
  for (Term& term : terms) term.rotating = term.effect == Id::kUnbalance;
  return terms;
}

}  // namespace levitas::diagnosis
