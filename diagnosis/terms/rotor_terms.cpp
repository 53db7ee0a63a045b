// Rotor at any speed: frequencies, damping, shapes, mass, gyroscopic inertia, internal damping.
#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

void AddModalFrequency(const RigView& rig, const Tolerances& t, std::size_t mode,
                       std::vector<Term>& terms) {
  const double w = rig.omega_rad_per_s[mode];
  const std::size_t other = rig.modes + mode;
  terms.push_back(MakeTerm({Id::kModalFrequency, AtMode(mode - 1), "ratio", "1"}, t.modal_frequency,
                           0.05, [=](const SamplePoint& m, double theta, Contribution& add) {
                             const double gone = -w * w * ((1.0 + theta) * (1.0 + theta) - 1.0);
                             add.Modal(mode, gone * static_cast<double>(m.q[mode]));
                             add.Modal(other, gone * static_cast<double>(m.q[other]));
                           }));
  terms.back().linear = false;
  terms.back().step = 1e-3;
  terms.back().in_plant = true;
  terms.back().change = [mode](double theta, LinearChange& change) {
    change.mode[mode].frequency *= 1.0 + theta;
  };
}

void AddModalDamping(const RigView& rig, const Tolerances& t, std::size_t mode,
                     std::vector<Term>& terms) {
  const double w = rig.omega_rad_per_s[mode];
  const double z = rig.damping_ratio[mode];
  const std::size_t other = rig.modes + mode;
  terms.push_back(MakeTerm({Id::kModalDamping, AtMode(mode - 1), "ratio", "1"}, t.modal_damping,
                           3.0, [=](const SamplePoint& m, double theta, Contribution& add) {
                             const double gone = -2.0 * z * w * theta;
                             add.Modal(mode, gone * static_cast<double>(m.v[mode]));
                             add.Modal(other, gone * static_cast<double>(m.v[other]));
                           }));
  terms.back().in_plant = true;
  terms.back().change = [mode](double theta, LinearChange& change) {
    change.mode[mode].damping += theta;
  };
}

/// At the magnets and at the sensors of bearing `b`.
void AddModalShape(const RigView& rig, const Tolerances& t, std::size_t mode, std::size_t b,
                   std::vector<Term>& terms) {
  const std::size_t other = rig.modes + mode;
  const double size = rig.ShapeRms(mode);
  terms.push_back(
      MakeTerm({std::nullopt, AtSide(rig.numbers, b, false).InMode(mode - 1), "shape", "1"},
               t.modal_shape, 0.0, [=](const SamplePoint& m, double theta, Contribution& add) {
                 const double shape = theta * size;
                 add.Modal(mode, shape * static_cast<double>(m.force_n[2 * b]));
                 add.Modal(other, shape * static_cast<double>(m.force_n[2 * b + 1]));
               }));
  terms.back().change = [=](double theta, LinearChange& change) {
    for (const std::size_t a : {2 * b, 2 * b + 1}) change.axis[a].drive[mode] += theta * size;
  };
  Term sensor =
      MakeTerm({std::nullopt, AtSide(rig.numbers, b, true).InMode(mode - 1), "shape", "1"},
               t.modal_shape, 0.0, nullptr);
  const double lag_s = SensorLag(rig, 2 * b);
  sensor.read = [=](const SamplePoint& m, double theta, Contribution& add) {
    const auto seen = [&](std::size_t i) {
      return static_cast<double>(m.read_q[i]) - lag_s * static_cast<double>(m.read_v[i]);
    };
    add.reading_m[2 * b] += theta * size * seen(mode);
    add.reading_m[2 * b + 1] += theta * size * seen(other);
  };
  sensor.change = [=](double theta, LinearChange& change) {
    for (const std::size_t a : {2 * b, 2 * b + 1}) {
      change.axis[a].sensor_q[mode] += theta * size;
      change.axis[a].sensor_v[mode] -= theta * size * lag_s;
    }
  };
  terms.push_back(std::move(sensor));
}

void AddMode(const RigView& rig, const Tolerances& t, std::size_t mode, std::vector<Term>& terms) {
  AddModalFrequency(rig, t, mode, terms);
  AddModalDamping(rig, t, mode, terms);
  for (std::size_t b = 0; b < rig.axes / 2; ++b) AddModalShape(rig, t, mode, b, terms);
}

/// f(z) = -damping (r' - j W r) of the bending alone.
Term InternalDamping(const RigView& rig, double z_m) {
  const auto push = [shape = rig.Shape(z_m), modes = rig.modes](const SamplePoint& m, double theta,
                                                                Contribution& add) {
    const double speed = static_cast<double>(m.speed_rad_per_s);
    double x = 0.0;
    double y = 0.0;
    double vx = 0.0;
    double vy = 0.0;
    for (std::size_t i = 2; i < modes; ++i) {
      x += shape[i] * static_cast<double>(m.q[i]);
      y += shape[i] * static_cast<double>(m.q[modes + i]);
      vx += shape[i] * static_cast<double>(m.v[i]);
      vy += shape[i] * static_cast<double>(m.v[modes + i]);
    }
    for (std::size_t i = 2; i < modes; ++i) {
      add.Modal(i, -theta * shape[i] * (vx + speed * y));
      add.Modal(modes + i, -theta * shape[i] * (vy - speed * x));
    }
  };
  Term term = MakeTerm({Id::kInternalDamping, AtPlane(z_m), "damping", "N s/m"}, 0.0, 20.0, push);
  term.positive = true;
  return term;
}

Term RotorMass(const RigView& rig, const Tolerances& t) {
  Term term = MakeTerm(
      {Id::kRotorMass, Everywhere("rotor"), "ratio", "1"}, t.rotor_mass, 0.1,
      [&rig, modes = rig.modes](const SamplePoint& m, double theta, Contribution& add) {
        const double share = -theta / (1.0 + theta);
        for (std::size_t a = 0; a < rig.axes; ++a) {
          const auto& shape = rig.magnet(a).actuator_shape;
          for (std::size_t i = 0; i < 2; ++i) {
            add.Modal((a % 2) * modes + i, share * shape[i] * static_cast<double>(m.force_n[a]));
          }
        }
      });
  term.linear = false;
  term.step = 1e-3;
  term.change = [](double theta, LinearChange& change) {
    for (std::size_t i = 0; i < 2; ++i) change.mode[i].drive /= 1.0 + theta;
  };
  return term;
}

Term GyroscopicInertia(const RigView& rig, const Tolerances& t) {
  Term term = MakeTerm(
      {Id::kGyroscopicInertia, Everywhere("rotor"), "ratio", "1"}, t.gyroscopic_inertia, 0.3,
      [&rig, modes = rig.modes](const SamplePoint& m, double theta, Contribution& add) {
        const double* g = rig.model->gyroscopic().data();
        const double speed = theta * static_cast<double>(m.speed_rad_per_s);
        if (speed == 0.0) return;
        for (std::size_t c = 0; c < modes; ++c) {
          const double vx = speed * static_cast<double>(m.v[c]);
          const double vy = speed * static_cast<double>(m.v[modes + c]);
          for (std::size_t i = 0; i < modes; ++i) {
            add.Modal(i, -g[c * modes + i] * vy);
            add.Modal(modes + i, g[c * modes + i] * vx);
          }
        }
      });
  term.rotating = true;
  term.in_plant = true;
  term.change = [](double theta, LinearChange& change) { change.gyroscopic *= 1.0 + theta; };
  return term;
}

}  // namespace

std::vector<Term> RotorTerms(const RigView& rig, const Tolerances& t) {
  std::vector<Term> terms;
  for (std::size_t mode = 2; mode < rig.modes; ++mode) AddMode(rig, t, mode, terms);
  terms.push_back(RotorMass(rig, t));
  terms.push_back(GyroscopicInertia(rig, t));
  for (const auto& disc : rig.model->config().rotor.discs) {
    terms.push_back(InternalDamping(rig, disc.z_m));
  }
  return terms;
}

}  // namespace levitas::diagnosis
