// Forces from outside, the support, contact.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

enum class Kind { kDirect, kSymmetric, kAntisymmetric };

const char* ParameterOf(Id effect, Kind kind) {
  if (kind == Kind::kDirect) return "direct";
  return kind == Kind::kAntisymmetric && effect == Id::kCouplingStiffness ? "whirl" : "cross";
}

/// A spring between shaft and ground at z: f = -(x, y), -(y, x) or (-y, x), times theta.
Term Spring(const RigView& rig, Id effect, double z_m, Kind kind, double faulty_std) {
  const auto shape = rig.Shape(z_m);
  return MakeTerm(
      {effect, AtPlane(z_m), ParameterOf(effect, kind), "N/m"}, 0.0, faulty_std,
      [shape, kind, modes = rig.modes](const SamplePoint& m, double theta, Contribution& add) {
        double x = 0.0;
        double y = 0.0;
        for (std::size_t i = 0; i < modes; ++i) {
          x += shape[i] * static_cast<double>(m.q[i]);
          y += shape[i] * static_cast<double>(m.q[modes + i]);
        }
        const double fx = theta * (kind == Kind::kDirect ? -x : -y);
        const double fy = theta * (kind == Kind::kDirect ? -y : kind == Kind::kSymmetric ? -x : x);
        for (std::size_t i = 0; i < modes; ++i) {
          add.Modal(i, shape[i] * fx);
          add.Modal(modes + i, shape[i] * fy);
        }
      });
}

/// Housing of a bearing on its own spring: u'' + 2 z w u' + w^2 u = -F theta, theta = 1/mass; the
/// magnet's gap and the sensor see x - u.
/// F is taken where the sensor says that the rotor is: were it taken where the model has it, the
/// housing would swing with the observer, which does not know it, and a heavy one would not settle.
Term Support(const RigView& rig, std::size_t b, double frequency_hz, double damping_ratio) {
  struct Housing {
    std::array<double, 2> u{}, v{};
  };
  Term term =
      MakeTerm({Id::kSupportMode,
                AtBearing(rig.numbers, b)
                    .Named(fmt::format("{:.1f} Hz, damping {:.4f}", frequency_hz, damping_ratio)),
                "1/mass_kg", "1/kg"},
               0.0, 0.2, nullptr);
  term.positive = true;
  term.family = {{frequency_hz, damping_ratio}, {0.04, 0.5}, [&rig, b](const Family::Shape& other) {
                   return Support(rig, b, other[0], other[1]);
                 }};
  const double w = 2.0 * std::numbers::pi * frequency_hz;
  term.drive = [b, w, damping_ratio, period_s = rig.period_s, h = Housing{}](
                   const SamplePoint& m, double theta, Contribution& add) mutable {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t axis = 2 * b + i;
      const double away_m = static_cast<double>(m.measured_m[axis] - m.reading_m[axis]);
      const double force_n =
          static_cast<double>(m.force_n[axis]) + static_cast<double>(m.force_per_m[axis]) * away_m;
      // Levitated for long before the record: it goes to where its spring holds the weight without
      // ringing, which would last longer than the model settles.
      if (m.restarted) h.u[i] = -force_n / (w * w), h.v[i] = 0.0;
      const double damping = m.starting ? 1.0 : damping_ratio;
      const double before = h.u[i];
      h.v[i] += period_s * (-force_n - w * w * h.u[i] - 2.0 * damping * w * h.v[i]);
      h.u[i] += period_s * h.v[i];
      add.force_n[axis] -=
          theta * static_cast<double>(m.force_per_m[axis]) * 0.5 * (before + h.u[i]);
      add.reading_m[axis] -= theta * h.u[i];
    }
  };
  return term;
}

/// Contact beyond a clearance, radial and with friction: normal force by penetration, or by its
/// rate.
Term Rub(const RigView& rig, std::size_t b, double clearance_m, double friction, bool by_rate) {
  const auto& shape_of_b = rig.magnet(2 * b).actuator_shape;
  Term term = MakeTerm(
      {Id::kTouchdownRub,
       AtBearing(rig.numbers, b)
           .Named(fmt::format("clearance {:.2f} um, friction {:.3f}", clearance_m * 1e6, friction)),
       by_rate ? "damping_n_s_per_m" : "stiffness_n_per_m", by_rate ? "N s/m" : "N/m"},
      0.0, by_rate ? 50.0 : 1e5,
      [=, modes = rig.modes](const SamplePoint& m, double theta, Contribution& add) {
        const double x = static_cast<double>(m.actuator_m[2 * b]);
        const double y = static_cast<double>(m.actuator_m[2 * b + 1]);
        const double r = std::hypot(x, y);
        if (r <= clearance_m) return;
        double rate = 0.0;
        for (std::size_t i = 0; by_rate && i < modes; ++i) {
          rate += shape_of_b[i] *
                  (x * static_cast<double>(m.v[i]) + y * static_cast<double>(m.v[modes + i])) / r;
        }
        const double normal = theta * (by_rate ? rate : r - clearance_m);
        const double drag = m.speed_rad_per_s > 0.0F ? friction * normal : 0.0;
        add.force_n[2 * b] += (-normal * x + drag * y) / r;
        add.force_n[2 * b + 1] += (-normal * y - drag * x) / r;
      });
  if (!by_rate) {
    // In contact the ring's spring stands beside the magnet's: derivatives must know it.
    term.slope = [=](const SamplePoint& m, double theta, AddedSlopes& added) {
      const double x = static_cast<double>(m.actuator_m[2 * b]);
      const double y = static_cast<double>(m.actuator_m[2 * b + 1]);
      const double r = std::hypot(x, y);
      if (r <= clearance_m) return;
      const double along = 1.0 - clearance_m / r;
      const double turned = clearance_m / (r * r * r);
      added.force_per_m[2 * b] -= static_cast<float>(theta * (along + turned * x * x));
      added.force_per_m[2 * b + 1] -= static_cast<float>(theta * (along + turned * y * y));
    };
  }
  const Family::Shape shape{clearance_m, friction};
  term.family = {shape, {0.15, 0.4}, [&rig, b, by_rate](const Family::Shape& other) {
                   return Rub(rig, b, other[0], other[1], by_rate);
                 }};
  return term;
}

}  // namespace

std::vector<Term> ExternalTerms(const RigView& rig, const Tolerances& t, double largest_orbit_m) {
  constexpr double kUsualDamping = 0.02;  // of a support
  constexpr double kUsualFriction = 0.1;  // of a touchdown ring
  std::vector<Term> terms;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    terms.push_back(MakeTerm(
        {Id::kStaticLoad, AtAxis(rig.numbers, a), "force_n", "N"}, t.static_load_n, 5.0,
        [a](const SamplePoint&, double theta, Contribution& add) { add.force_n[a] += theta; }));
  }
  terms.push_back(Spring(rig, Id::kCouplingStiffness, 0.0, Kind::kDirect, 5e3));
  terms.push_back(Spring(rig, Id::kCouplingStiffness, 0.0, Kind::kSymmetric, 5e3));
  terms.push_back(Spring(rig, Id::kCouplingStiffness, 0.0, Kind::kAntisymmetric, 5e3));
  for (const auto& disc : rig.model->config().rotor.discs) {
    terms.push_back(Spring(rig, Id::kCrossCoupledStiffness, disc.z_m, Kind::kAntisymmetric, 5e3));
  }
  for (std::size_t b = 0; b < rig.axes / 2; ++b) {
    // From 30 to 270 Hz, each a tenth above the one before: a support is that sharp.
    constexpr int kSteps = 22;
    for (int k = 0; k <= kSteps; ++k) {
      terms.push_back(
          Support(rig, b, 30.0 * std::pow(9.0, static_cast<double>(k) / kSteps), kUsualDamping));
    }
    for (const double share : {0.15, 0.25, 0.4, 0.6, 0.8}) {
      for (const bool by_rate : {false, true}) {
        terms.push_back(Rub(rig, b, share * largest_orbit_m, kUsualFriction, by_rate));
      }
    }
  }
  return terms;
}

}  // namespace levitas::diagnosis
