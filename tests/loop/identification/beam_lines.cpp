#include "tests/loop/identification/beam_lines.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::test {
namespace {

using Complex = std::complex<double>;
using identification::GearedLine;
using Kind = GearedLine::Kind;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

const Complex kJ(0.0, 1.0);
constexpr double kProportional = 6e3, kDerivative = 5.0;

rotor::Shaft BeamShaft(const char* name, double diameter_m, const rotor::Disc& disc) {
  rotor::Shaft shaft;
  shaft.name = name;
  shaft.is_beam = true;
  shaft.beam.material = {207e9, 0.3, 7850.0};
  shaft.beam.sections = {{0.5, diameter_m, 0.0}};
  shaft.beam.discs = {disc};
  shaft.beam.max_element_length_m = 0.5;  // nodes at the planes only: both sides have them
  shaft.supports = {{0.0, 2e6, 2e6, 400.0, 400.0}, {0.5, 2e6, 2e6, 400.0, 400.0}};
  return shaft;
}

/// Where a shaft's planes stand among the coordinates, x then y of both shafts.
struct Places {
  std::array<Index, 2> gear{}, magnet{}, probe{};
};

class BeamPair {
 public:
  BeamPair(const plant::PlantConfig& rig, double speed) : rig_(rig) {
    const gear::GearPair& pair = rig.gears.front();
    const double backwards = -pair.driving.teeth / static_cast<double>(pair.driven.teeth);
    Add(pair.driving, speed);
    Add(pair.driven, speed * backwards);
    Matrix teeth = Matrix::Zero(2, mass_.rows());
    for (Index axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      teeth(axis, places_[0].gear[a]) = 1.0;
      teeth(axis, places_[1].gear[a]) = -1.0;
    }
    stiffness_ += pair.stiffness_n_per_m * teeth.transpose() * teeth;
    damping_ += pair.damping_n_s_per_m * teeth.transpose() * teeth;
    teeth_ = teeth;
  }

  /// Lines at w (and at -w unless 0) from tooth displacements and forces at the gears, each forward
  /// and backward.
  std::array<GearedLine, 2> At(double w, const std::array<Complex, 2>& teeth,
                               const std::array<std::array<Complex, 2>, 2>& force) const {
    const gear::GearPair& pair = rig_.gears.front();
    const Eigen::MatrixXcd dynamic = stiffness_.cast<Complex>() +
                                     kJ * w * damping_.cast<Complex>() -
                                     w * w * mass_.cast<Complex>();
    const Complex mesh(pair.stiffness_n_per_m, w * pair.damping_n_s_per_m);
    Eigen::VectorXcd right = -mesh * teeth_.transpose().cast<Complex>() * InPlane(teeth);
    for (std::size_t s = 0; s < 2; ++s) {
      const Eigen::Vector2cd on = InPlane(force[s]);
      right[places_[s].gear[0]] += on[0];
      right[places_[s].gear[1]] += on[1];
    }
    const Eigen::VectorXcd q = dynamic.partialPivLu().solve(right);
    std::array<GearedLine, 2> lines;
    for (const std::size_t side : {0U, 1U}) {
      GearedLine& line = lines[side];
      line.frequency_rad_per_s = side == 0 ? w : -w;
      line.pinion_m = Whirl(q, places_[0].probe, side, w);
      line.gear_m = Whirl(q, places_[1].probe, side, w);
      const Complex law(kProportional, line.frequency_rad_per_s * kDerivative);
      line.pinion_a = law * line.pinion_m;
      line.gear_a = law * line.gear_m;
    }
    return lines;
  }

 private:
  static Eigen::Vector2cd InPlane(const std::array<Complex, 2>& whirl) {
    return {whirl[0] + std::conj(whirl[1]), -kJ * (whirl[0] - std::conj(whirl[1]))};
  }
  static Complex Whirl(const Eigen::VectorXcd& q, const std::array<Index, 2>& at, std::size_t side,
                       double w) {
    const Complex x = q[at[0]];
    const Complex y = q[at[1]];
    if (w == 0.0) return side == 0 ? Complex(x.real(), y.real()) : 0.0;
    return side == 0 ? 0.5 * (x + kJ * y) : 0.5 * std::conj(x - kJ * y);
  }

  void Add(const gear::Wheel& wheel, double speed) {
    const rotor::Shaft& shaft = rig_.shafts[wheel.shaft];
    const plant::BearingConfig& bearing = rig_.bearings[wheel.shaft];
    const rotor::FiniteElementModel model = rotor::Assemble(
        shaft.beam, {wheel.z_m, bearing.actuator_z_m, bearing.sensor_z_m, 0.0, 0.5});
    const Index size = model.mass.rows();
    const Index x = mass_.rows();
    const Index y = x + size;
    for (Matrix* all : {&mass_, &damping_, &stiffness_}) {
      Matrix grown = Matrix::Zero(x + 2 * size, x + 2 * size);
      grown.topLeftCorner(x, x) = *all;
      *all = grown;
    }
    for (const Index axis : {x, y}) {
      mass_.block(axis, axis, size, size) = model.mass;
      stiffness_.block(axis, axis, size, size) = model.stiffness;
    }
    // M r'' - j W G r' + K r: the x equation has + W G y', the y equation - W G x'.
    damping_.block(x, y, size, size) = speed * model.gyroscopic;
    damping_.block(y, x, size, size) = -speed * model.gyroscopic;
    const auto deflection = [&model](double z_m) {
      Index node = 0;
      while (std::abs(model.node_z_m[static_cast<std::size_t>(node)] - z_m) > 1e-9) ++node;
      return 2 * node;
    };
    const magnet::Magnet magnet{bearing.magnet.force_constant_n_m2_per_a2, bearing.magnet.gap_m,
                                bearing.magnet.max_coil_current_a};
    const double ki = magnet::ForcePerCurrent(magnet, bearing.magnet.bias_current_a);
    const double ks = magnet::NegativeStiffness(magnet, bearing.magnet.bias_current_a);
    Places& places = places_[wheel.shaft];
    for (const std::size_t axis : {0U, 1U}) {
      const Index first = axis == 0 ? x : y;
      for (const rotor::Support& support : shaft.supports) {
        const Index at = first + deflection(support.z_m);
        stiffness_(at, at) += support.stiffness_x_n_per_m;
        damping_(at, at) += support.damping_x_n_s_per_m;
      }
      places.gear[axis] = first + deflection(wheel.z_m);
      const Index a = places.magnet[axis] = first + deflection(bearing.actuator_z_m);
      const Index s = places.probe[axis] = first + deflection(bearing.sensor_z_m);
      stiffness_(a, a) -= ks;
      stiffness_(a, s) += ki * kProportional;
      damping_(a, s) += ki * kDerivative;
    }
  }

  const plant::PlantConfig& rig_;
  Matrix mass_, damping_, stiffness_, teeth_;
  std::array<Places, 2> places_;
};

Complex ErrorOf(const gear::GearPair& pair, int order) {
  for (const gear::Harmonic& h : pair.transmission_error) {
    if (h.order == order) return std::polar(h.amplitude_m, h.phase_rad);
  }
  return 0.0;
}

Complex RunOutOf(const gear::Wheel& wheel) {
  return std::polar(wheel.runout_m, wheel.runout_phase_rad);
}

}  // namespace

configuration::RigFile BeamRig(const Planes& pinion, const Planes& gear) {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("geared_rotor_4dof", "rigs"));
  rig.numbers.name = "beams";
  rig.plant.shafts = {BeamShaft("pinion", 0.015, {pinion.gear_z_m, 2.0, 1.8e-3, 3.4e-3}),
                      BeamShaft("gear", 0.0155, {gear.gear_z_m, 3.5, 6.0e-3, 1.15e-2})};
  for (const std::size_t s : {0U, 1U}) {
    const Planes& planes = s == 0 ? pinion : gear;
    gear::GearPair& pair = rig.plant.gears.front();
    (s == 0 ? pair.driving : pair.driven).z_m = planes.gear_z_m;
    rig.plant.bearings[s].actuator_z_m = planes.magnet_z_m;
    rig.plant.bearings[s].sensor_z_m = planes.probe_z_m;
  }
  return rig;
}

std::vector<GearedLine> BeamLines(const configuration::RigFile& rig,
                                  const std::vector<double>& speeds_hz) {
  const gear::GearPair& pair = rig.plant.gears.front();
  const Complex p = RunOutOf(pair.driving);
  const Complex g = RunOutOf(pair.driven);
  std::vector<GearedLine> lines;
  for (const double hz : speeds_hz) {
    const double speed = 2.0 * std::numbers::pi * hz;
    const double other = speed * pair.driving.teeth / static_cast<double>(pair.driven.teeth);
    const BeamPair beams(rig.plant, speed);
    const auto keep = [&](GearedLine line, Kind kind, int harmonic) {
      line.kind = kind;
      line.harmonic = harmonic;
      line.speed_rad_per_s = speed;
      lines.push_back(line);
    };
    constexpr Kind kError = Kind::kTransmissionError;
    // At rest both halves of a real vector are the vector: all of it stands on the forward side.
    keep(beams.At(0.0, {-ErrorOf(pair, 0), 0.0}, {})[0], kError, 0);
    const Complex on_pinion = pair.driving.eccentric_mass_kg * speed * speed * p;
    keep(beams.At(speed, {p, 0.0}, {{{on_pinion, 0.0}, {}}})[0], Kind::kPinion, 0);
    const Complex on_gear = pair.driven.eccentric_mass_kg * other * other * g;
    keep(beams.At(other, {0.0, -g}, {{{}, {0.0, on_gear}}})[1], Kind::kGear, 0);
    for (int i = 1; i <= 5; ++i) {
      const auto both =
          beams.At(i * pair.driving.teeth * speed, {-ErrorOf(pair, i), -ErrorOf(pair, -i)}, {});
      keep(both[0], kError, i);
      keep(both[1], kError, -i);
    }
  }
  return lines;
}

}  // namespace levitas::test
