// A transverse crack that breathes under the shaft's weight.
//
// Equation   bending moment at z is softened across the crack alone: S g/(1 + S g R) (e . k) e on
//            the curvature k, e = the crack's direction, which turns with the shaft, g = (1 + cos(
//            angle between e and gravity))/2 its open share (Gasch 1993, J. Sound Vib. 160(2) 313),
//            S and R as in effect/crack.hpp. A shallow one therefore acts at 0, 1, 2 and 3 times
//            the rotation at once: a softening without direction would have the first two only.
// Family     plane z and direction at angle zero; theta is S over what would, to first order, take
//            away the whole stiffness of the first bending mode. It is not negative: no pole.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/terms/terms.hpp"
#include "plant_sim/effect/crack.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Curvature of the modes [1/m of unit amplitude] at a plane: between the middles of the elements,
/// where the change of slope is taken.
std::vector<double> Curvature(const RigView& rig, double z_m) {
  const auto& rotor = rig.model->parameters().modes;
  const auto& nodes_m = rotor.node_z_m;
  const auto middle = [&nodes_m](std::size_t e) { return 0.5 * (nodes_m[e] + nodes_m[e + 1]); };
  std::size_t e = 0;
  while (e + 3 < nodes_m.size() && middle(e + 1) <= z_m) ++e;
  const double share = std::clamp((z_m - middle(e)) / (middle(e + 1) - middle(e)), 0.0, 1.0);
  const auto of = [&](std::size_t element, Eigen::Index mode) {
    const auto at = static_cast<Eigen::Index>(element);
    return (rotor.slopes(at + 1, mode) - rotor.slopes(at, mode)) /
           (nodes_m[element + 1] - nodes_m[element]);
  };
  std::vector<double> curvature(rig.modes);
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    const auto mode = static_cast<Eigen::Index>(i);
    curvature[i] = (1.0 - share) * of(e, mode) + share * of(e + 1, mode);
  }
  return curvature;
}

/// [N m^3] S at theta = 1.
double Reference(const RigView& rig, const std::vector<double>& curvature) {
  const double first = rig.omega_rad_per_s[2] / curvature[2];
  return first * first;
}

/// `direction_rad` beyond a whole turn, so that shapes are positive.
Term Crack(const RigView& rig, double z_m, double direction_rad) {
  const auto curvature = Curvature(rig, z_m);
  const double size = Reference(rig, curvature);
  const double residual = effect::CurvatureCompliance(curvature, rig.omega_rad_per_s);
  const double gx = rig.model->gravity_direction_x();
  const double gy = rig.model->gravity_direction_y();
  const double degrees = std::fmod(direction_rad, kTurn) * 360.0 / kTurn;
  const auto soften = [=, modes = rig.modes, period_s = rig.period_s](
                          const SamplePoint& m, double theta, Contribution& add) {
    const double angle =
        m.angle_rad + 0.5 * period_s * static_cast<double>(m.speed_rad_per_s) + direction_rad;
    const double ex = std::cos(angle);
    const double ey = std::sin(angle);
    double across = 0.0;
    for (std::size_t i = 2; i < modes; ++i) {
      across += curvature[i] *
                (ex * static_cast<double>(m.q[i]) + ey * static_cast<double>(m.q[modes + i]));
    }
    const double open = 0.5 * (1.0 + ex * gx + ey * gy);
    const double moment = effect::CrackSoftening(theta * size, open, residual) * across;
    for (std::size_t i = 2; i < modes; ++i) {
      add.Modal(i, curvature[i] * moment * ex);
      add.Modal(modes + i, curvature[i] * moment * ey);
    }
  };
  Term term =
      MakeTerm({Id::kBreathingCrack,
                AtPlane(z_m).Named(fmt::format("direction {:.1f} deg", degrees)), "softening", "1"},
               0.0, 0.05, soften);
  term.positive = true;
  term.linear = false;
  term.step = 1e-3;
  // Half the distance of the planes, and of directions that count from one whole turn on.
  term.family = {{z_m, direction_rad}, {0.1, 0.04}, [&rig](const Family::Shape& other) {
                   return Crack(rig, other[0], other[1]);
                 }};
  return term;
}

struct Shaft {
  double diameter_m{}, bending_stiffness_n_m2{};
};

Shaft ShaftAt(const rotor::RotorConfig& rotor, double z_m) {
  double end_m = 0.0;
  const auto here =
      std::find_if(rotor.sections.begin(), rotor.sections.end() - 1, [&](const auto& section) {
        end_m += section.length_m;
        return z_m <= end_m;
      });
  const double fourth_m4 =
      std::pow(here->outer_diameter_m, 4) - std::pow(here->inner_diameter_m, 4);
  return {here->outer_diameter_m, rotor.material.young_pa * std::numbers::pi / 64.0 * fourth_m4};
}

}  // namespace

double CrackDepth(const RigView& rig, double z_m, double theta) {
  const auto& rotor = rig.model->config().rotor;
  const Shaft shaft = ShaftAt(rotor, z_m);
  const double wanted = theta * Reference(rig, Curvature(rig, z_m)) /
                        (shaft.diameter_m * shaft.bending_stiffness_n_m2);
  // The compliance rises with the depth.
  double low = 0.0;
  double high = 0.5;
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (effect::CrackCompliance(middle, rotor.material.poisson) < wanted ? low : high) = middle;
  }
  return low;
}

std::vector<Term> CrackTerms(const RigView& rig) {
  constexpr int kDirections = 8;
  std::vector<Term> terms;
  if (rig.modes < 3 || rig.model->config().rotor.sections.empty()) return terms;
  const double length_m = rig.model->parameters().modes.node_z_m.back();
  for (const double share : {0.4, 0.5, 0.6}) {
    for (int k = 0; k < kDirections; ++k) {
      terms.push_back(Crack(rig, share * length_m, kTurn * (1.0 + k / double{kDirections})));
    }
  }
  return terms;
}

}  // namespace levitas::diagnosis
